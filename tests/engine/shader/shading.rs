//! Every shader program gives the value of its formula, and the values known without one.

use crate::support::shaders::{cube, fragment, noise, plain, random, smooth, smooth_cube, uniforms};
use drape::{
    glsl::{Exponent, Vec3, pow},
    lanes::F64,
    raster::{FragmentProgram, Varyings},
    shader::{
        Uniforms, bump, custom, diffuse, mirror, normal, phong,
        sampler::{Sampler2d, texture as lookup, texture_cube},
        texture, wireframe,
    },
};

type V = [f64; 3];

/// The formulas a second time, on plain triples of f64.
mod formulas {
    use super::*;

    pub(super) fn each(a: V, b: V, op: impl Fn(f64, f64) -> f64) -> V {
        [op(a[0], b[0]), op(a[1], b[1]), op(a[2], b[2])]
    }
    pub(super) fn add(a: V, b: V) -> V {
        each(a, b, |a, b| a + b)
    }
    pub(super) fn sub(a: V, b: V) -> V {
        each(a, b, |a, b| a - b)
    }
    pub(super) fn mul(a: V, s: f64) -> V {
        a.map(|c| c * s)
    }
    pub(super) fn dot(a: V, b: V) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }
    pub(super) fn unit(a: V) -> V {
        mul(a, 1.0 / dot(a, a).sqrt())
    }
    pub(super) fn reflected(v: V, n: V) -> V {
        sub(mul(n, 2.0 * dot(n, v)), v)
    }
    fn product(base: f64, times: u32) -> f64 {
        (0..times).fold(1.0, |product, _| product * base)
    }

    /// Direction to the light, to the camera, halfway between them, and I/r².
    fn light(u: &Uniforms, p: V) -> (V, V, V, V) {
        let to_light = sub(u.u_light_pos.map(f64::from), p);
        let (l, v) = (unit(to_light), unit(sub(u.u_cam_pos.map(f64::from), p)));
        let irradiance = u.u_light_intensity.map(|i| f64::from(i) / dot(to_light, to_light));
        (l, v, unit(add(l, v)), irradiance)
    }

    pub(super) fn lambert(u: &Uniforms, p: V, n: V) -> V {
        let (l, _, _, irradiance) = light(u, p);
        let factor = f64::from(u.u_kd) * dot(n, l).max(0.0);
        each(irradiance, u.u_color.map(f64::from), |i, c| i * c * factor)
    }

    pub(super) fn blinn_phong(u: &Uniforms, p: V, n: V) -> V {
        let (_, _, h, irradiance) = light(u, p);
        let highlight = f64::from(u.u_ks) * product(dot(n, h).max(0.0), 64);
        add([f64::from(u.u_ka); 3], add(lambert(u, p, n), mul(irradiance, highlight)))
    }

    pub(super) fn mirrored(u: &Uniforms, p: V, n: V) -> V {
        reflected(unit(sub(u.u_cam_pos.map(f64::from), p)), n)
    }

    /// n' = [t b n]·normalize(-dU, -dV, 1)
    pub(super) fn bumped(u: &Uniforms, height: impl Fn(f64, f64) -> f64, size: [f64; 2], v: &[f64; 11]) -> V {
        let (n, t) = (unit([v[3], v[4], v[5]]), unit([v[6], v[7], v[8]]));
        let b = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]];
        let k = f64::from(u.u_height_scaling * u.u_normal_scaling);
        let d_u = (height(v[9] + 1.0 / size[0], v[10]) - height(v[9], v[10])) * k;
        let d_v = (height(v[9], v[10] + 1.0 / size[1]) - height(v[9], v[10])) * k;
        unit(add(add(mul(t, -d_u), mul(b, -d_v)), n))
    }

    pub(super) fn ceramic(u: &Uniforms, p: V, n: V, a: V, environment: V) -> V {
        let q = unit(u.u_light_color.map(f64::from));
        let (l, _, h, irradiance) = light(u, p);
        let (ambient, facing) = (f64::from(u.u_ka), f64::from(u.u_kd) * dot(n, l).max(0.0));
        let highlight = f64::from(u.u_ks) * product(dot(n, h).max(0.0), 64);
        std::array::from_fn(|c| {
            a[c] * (ambient * q[c] + facing * irradiance[c])
                + q[c] * irradiance[c] * highlight
                + f64::from(u.u_km) * environment[c]
        })
    }
}
use formulas::*;

/// A program's colour of one fragment, in f64.
fn run<const N: usize>(program: &impl FragmentProgram<N>, varyings: &[f64; N]) -> V {
    plain_vector(program.stage::<F64>(())(Varyings::from_numbers(|i| F64(varyings[i]))))
}

fn plain_vector(v: Vec3<F64>) -> V {
    [v.x.0, v.y.0, v.z.0]
}

fn close(what: &str, color: V, expected: V, bound: f64) {
    let error = each(color, expected, |a, b| (a - b).abs());
    assert!(error.into_iter().all(|e| e <= bound), "{what}: {color:?} for {expected:?}");
}

#[test]
fn every_program_is_its_formula() {
    let u = uniforms();
    let (picture, heights, map) = (noise(37, 53, 1), noise(64, 32, 2), cube(|i| noise(17, 17, i as u64)));
    let (one, two, environment) = (smooth(&picture), smooth(&heights), smooth_cube(&map));
    let look = |sampler: Sampler2d<'_>, s: f64, t: f64| plain_vector(lookup(sampler, [F64(s), F64(t)]));
    let around = |direction: V| plain_vector(texture_cube(environment, direction.map(F64).into()));
    for i in 0..2000 {
        let all = fragment(i).map(f64::from);
        let [x, y, z, nx, ny, nz, _, _, _, s, t] = all;
        let (p, n) = ([x, y, z], unit([nx, ny, nz]));
        let bumped = bumped(&u, |s, t| look(two, s, t)[0], [64.0, 32.0], &all);
        let six = &[x, y, z, nx, ny, nz];
        close("wireframe", run(&wireframe::Fragment { u }, &[]), u.u_color.map(f64::from), 0.0);
        close("normal", run(&normal::Fragment {}, &[nx, ny, nz]), n.map(|c| (c + 1.0) / 2.0), 1e-13);
        close("diffuse", run(&diffuse::Fragment { u }, six), lambert(&u, p, n), 1e-12);
        close("phong", run(&phong::Fragment { u }, six), blinn_phong(&u, p, n), 1e-12);
        close("texture", run(&texture::Fragment { u_texture_1: one }, &[s, t]), look(one, s, t), 0.0);
        close(
            "mirror",
            run(&mirror::Fragment { u, u_texture_cubemap: environment }, six),
            around(mirrored(&u, p, n)),
            1e-11,
        );
        close("bump", run(&bump::Fragment { u, u_texture_2: two }, &all), blinn_phong(&u, p, bumped), 1e-11);
        let expected = ceramic(&u, p, bumped, look(one, s, t), around(mirrored(&u, p, bumped)));
        let custom =
            custom::Fragment { u, u_texture_1: one, u_texture_2: two, u_texture_cubemap: environment };
        close("custom", run(&custom, &all), expected, 1e-11);
    }
}

/// A surface that faces the light and the camera, two metres away: r² = 4 and every cosine is 1.
#[test]
fn facing_the_light_every_cosine_is_one() {
    let u = Uniforms { u_light_pos: [0.0, 0.0, 2.0], u_cam_pos: [0.0, 0.0, 5.0], ..uniforms() };
    let facing = &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let lambert = [0, 1, 2].map(|c| f64::from(u.u_kd * u.u_color[c] * u.u_light_intensity[c]) / 4.0);
    close("diffuse", run(&diffuse::Fragment { u }, facing), lambert, 1e-7);
    let highlight = u.u_light_intensity.map(|i| f64::from(u.u_ks * i) / 4.0);
    let expected = add([f64::from(u.u_ka); 3], add(lambert, highlight));
    close("phong", run(&phong::Fragment { u }, facing), expected, 1e-7);
}

/// At a right angle, and from behind, only the ambient part is left.
#[test]
fn grazing_light_and_light_from_behind_leave_the_ambient_part() {
    let u = Uniforms { u_light_pos: [0.0, 0.0, 2.0], u_cam_pos: [0.0, 0.0, 5.0], ..uniforms() };
    for normal in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]] {
        let [nx, ny, nz] = normal;
        let fragment = &[0.0, 0.0, 0.0, nx, ny, nz];
        close("diffuse", run(&diffuse::Fragment { u }, fragment), [0.0; 3], 0.0);
        close("phong", run(&phong::Fragment { u }, fragment), [f64::from(u.u_ka); 3], 0.0);
    }
}

/// At 60° to the light the diffuse part is half, and at twice the distance a quarter.
#[test]
fn light_falls_with_the_cosine_and_the_square_of_the_distance() {
    let at = |distance: f32, normal: [f64; 3]| {
        let u = Uniforms { u_light_pos: [0.0, 0.0, distance], ..uniforms() };
        let [nx, ny, nz] = normal;
        run(&diffuse::Fragment { u }, &[0.0, 0.0, 0.0, nx, ny, nz])[0]
    };
    let facing = at(1.0, [0.0, 0.0, 1.0]);
    assert!((at(1.0, [0.75_f64.sqrt(), 0.0, 0.5]) / facing - 0.5).abs() < 1e-12);
    assert!((at(2.0, [0.0, 0.0, 1.0]) / facing - 0.25).abs() < 1e-12);
}

/// Straight on, a mirror shows what is behind the camera.
#[test]
fn a_mirror_seen_straight_on_shows_the_camera() {
    let map = cube(|i| plain(4, [i as f32 / 8.0, 0.0, 0.0]));
    let axes = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1_i8]];
    for (face, axis) in axes.into_iter().enumerate() {
        let u = Uniforms { u_cam_pos: axis.map(|c| 3.0 * f32::from(c)), ..uniforms() };
        let [x, y, z] = axis.map(f64::from);
        let color = run(&mirror::Fragment { u, u_texture_cubemap: smooth_cube(&map) }, &[x, y, z, x, y, z]);
        assert_eq!(color[0], face as f64 / 8.0, "axis {axis:?}");
    }
}

#[test]
fn a_white_environment_is_white_from_everywhere() {
    let u = uniforms();
    let white = cube(|_| plain(5, [1.0; 3]));
    for i in 0..2000 {
        let [x, y, z, nx, ny, nz, ..] = fragment(i);
        let program = mirror::Fragment { u, u_texture_cubemap: smooth_cube(&white) };
        let color = program.stage::<f32>(())(Varyings::from_numbers(|i| [x, y, z, nx, ny, nz][i]));
        assert_eq!([color.x, color.y, color.z], [1.0; 3], "fragment {i}");
    }
}

/// Also where the normal is short, as it is after interpolation.
#[test]
fn the_length_of_the_normal_does_not_matter() {
    let u = uniforms();
    for i in 0..500 {
        let [x, y, z, nx, ny, nz, ..] = fragment(i).map(f64::from);
        let color = |s: f64| run(&phong::Fragment { u }, &[x, y, z, s * nx, s * ny, s * nz]);
        let short = run(&normal::Fragment {}, &[0.25 * nx, 0.25 * ny, 0.25 * nz]);
        close("normal", run(&normal::Fragment {}, &[nx, ny, nz]), short, 1e-13);
        assert!(each(color(0.125), color(7.0), |a, b| (a - b).abs()).into_iter().all(|e| e < 1e-12));
    }
}

#[test]
fn whole_exponents_are_products() {
    for i in 0..1000 {
        let base = random(i).abs();
        assert_eq!(pow(base, Exponent::of(1.0)), base);
        assert_eq!(pow(base, Exponent::of(2.0)), base * base);
        assert_eq!(pow(base, Exponent::of(4.0)), (base * base) * (base * base));
        for p in [3_u16, 10, 32, 64, 100, 255] {
            let product = (0..p).fold(1.0, |product, _| product * f64::from(base));
            let F64(power) = pow(F64(base.into()), Exponent::of(p.into()));
            assert!((power - product).abs() <= f64::from(p) * f64::EPSILON * product, "{base}^{p}");
        }
    }
    for p in 1..=126_u8 {
        assert_eq!(pow(0.5_f32, Exponent::of(p.into())), 1.0 / (0..p).fold(1.0, |two, _| two * 2.0));
        assert_eq!(pow(0.0_f32, Exponent::of(p.into())), 0.0);
    }
    assert_eq!((pow(0.0_f32, Exponent::of(0.0)), pow(0.0_f32, Exponent::of(2.5))), (1.0, 0.0));
    assert!((pow(0.5_f32, Exponent::of(2.5)) - 0.176_776_7).abs() < 1e-7);
}
