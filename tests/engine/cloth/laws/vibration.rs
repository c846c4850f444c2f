//! The fastest vibration, and the step that follows from it.

use drape::cloth::Points;
use drape::diagnostics::stability::Stability;
use drape::math::sin;
use drape::scene::{Cloth, Scene, Vec3};
use drape::simulation::Simulation;
use proptest::prelude::*;

use super::{cloth, distance, noise, run, springs_only, stirred};
use crate::scenes;

#[test]
fn a_cloth_at_rest_is_stable_exactly_from_the_predicted_steps_on() {
    for (points, ks, percent) in [(12, 2e5, 0.0), (8, 1e6, 0.0), (8, 1e6, 60.0)] {
        let mut scene = springs_only(points, points);
        (cloth(&mut scene).ks, cloth(&mut scene).damping) = (ks, percent);
        let stability = Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
        let fewest = stability.fewest_steps_rest();
        let growth = |steps: f64| {
            scene.sim.steps_per_frame = steps as u32;
            let mut simulation = stirred(&scene, 1e-7);
            let start = simulation.energy().total();
            run(&mut simulation, 3000);
            simulation.energy().total() / start
        };
        let [stable, unstable] = [fewest, fewest - 1.0].map(growth);
        assert!(stable < 1e3, "{points} points, {fewest} steps: energy grew {stable} times");
        assert!(
            unstable > 1e6 || unstable.is_nan(),
            "{points} points, one step fewer: energy grew {unstable} times"
        );
    }
}

#[test]
fn the_stock_cloth_has_its_known_stability() {
    for (points, rest, safe) in [(50, 5.0, 6.0), (200, 19.0, 23.0), (400, 37.0, 45.0)] {
        let mut scene = scenes::pinned2();
        let cloth = cloth(&mut scene);
        (cloth.num_width_points, cloth.num_height_points) = (points, points);
        cloth.pinned = vec![[0, 0], [points - 1, 0]];
        let stability = Stability::new(&cloth.clone(), &scene.sim).unwrap();
        assert_eq!(stability.fewest_steps_rest(), rest, "{points} points at rest");
        assert_eq!(stability.fewest_steps_worst(), safe, "{points} points at worst");
        assert_eq!(stability.is_unstable_at_rest(), rest > 30.0, "{points} points at 30 steps a frame");
        assert_eq!(stability.is_always_stable(), safe <= 30.0, "{points} points at 30 steps a frame");
        let lattice = (8.0 * 5000.0 / stability.mass).sqrt();
        let part = stability.omega_rest / lattice;
        assert!((0.999..1.0).contains(&part), "{points} points vibrate at {part} of the endless lattice");
        assert!((stability.omega_safe / lattice - 1.5_f64.sqrt()).abs() < 1e-12, "12 against 8 ks/m");
    }
}

/// The largest eigenvalue at rest that is found for `scene`, in N/m.
fn found_at_rest(scene: &Scene) -> f64 {
    let stability = Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
    stability.omega_rest * stability.omega_rest * stability.mass
}

/// The largest eigenvalue of the endless lattice of `cloth`, over waves of every length: a spring
/// over (dx, dy) with phase difference f between its ends resists by `4 k sin²(f / 2) n nᵀ`.
fn lattice(cloth: &Cloth) -> f64 {
    let spacing = [
        cloth.width / (cloth.num_width_points - 1) as f64,
        cloth.height / (cloth.num_height_points - 1) as f64,
    ];
    let springs = [
        (cloth.enable_structural, 1.0, [[1.0, 0.0], [0.0, 1.0]]),
        (cloth.enable_shearing, 1.0, [[1.0, 1.0], [-1.0, 1.0]]),
        (cloth.enable_bending, 0.2, [[2.0, 0.0], [0.0, 2.0]]),
    ];
    let largest = |p: f64, q: f64| {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (_, factor, offsets) in springs.into_iter().filter(|(enabled, ..)| *enabled) {
            for [dx, dy] in offsets {
                let half = sin((dx * p + dy * q) / 2.0);
                let k = 4.0 * factor * cloth.ks * half * half;
                let (x, y) = (dx * spacing[0], dy * spacing[1]);
                let square = x * x + y * y;
                (xx, xy, yy) = (xx + k * x * x / square, xy + k * x * y / square, yy + k * y * y / square);
            }
        }
        (xx + yy) / 2.0 + ((xx - yy) * (xx - yy) / 4.0 + xy * xy).sqrt()
    };
    let waves = || (0..=64).map(|wave| f64::from(wave) * std::f64::consts::PI / 64.0);
    waves().flat_map(|p| waves().map(move |q| (p, q))).map(|(p, q)| largest(p, q)).fold(0.0, f64::max)
}

/// A large cloth of any springs vibrates as fast as its endless lattice, but for 0.5 % of the
/// eigenvalue.
#[test]
fn a_large_cloth_vibrates_as_its_endless_lattice() {
    for kinds in 1..8 {
        for height in [1.0, 1.7, 0.2] {
            let mut scene = springs_only(90, 80);
            let cloth = cloth(&mut scene);
            cloth.height = height;
            (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) =
                (kinds & 1 > 0, kinds & 2 > 0, kinds & 4 > 0);
            let endless = lattice(cloth);
            let part = found_at_rest(&scene) / endless;
            assert!(
                (0.995..1.0).contains(&part),
                "kinds {kinds:03b}, height {height}: {part} of {endless} N/m"
            );
        }
    }
}

/// Wherever the pins are, the fastest vibration is that of the points which are free.
#[test]
fn pins_anywhere_on_a_large_cloth_are_seen() {
    let pinned = |held: &dyn Fn(usize, usize) -> bool| {
        let mut scene = springs_only(200, 150);
        let points = (0..150).flat_map(|j| (0..200).map(move |i| [i, j]));
        cloth(&mut scene).height = 149.0 / 199.0;
        cloth(&mut scene).pinned = points.filter(|&[i, j]| held(i, j)).collect();
        found_at_rest(&scene) / 5000.0
    };
    let close = |found: f64, exact: f64, part: f64, what: &str| {
        assert!(found <= exact * (1.0 + 1e-12) && found >= part * exact, "{what}: {found} of {exact} ks");
    };
    close(pinned(&|i, j| i < 64 && j < 64), 8.0, 0.999, "the first corner pinned");
    close(pinned(&|i, j| i < 130 || j < 80), 8.0, 0.999, "all but the last corner pinned");
    close(pinned(&|_, _| true), 0.0, 1.0, "all pinned");
    // One point alone: structural springs 2 ks, shearing 2 ks, bending 0.4 ks along each axis.
    close(pinned(&|i, j| [i, j] != [170, 140]), 4.4, 1.0 - 1e-9, "one point free");
    close(pinned(&|i, j| i % 3 > 0 || j % 3 > 0), 4.4, 1.0 - 1e-9, "no two free points joined");
    close(pinned(&|i, j| i % 50 == 0 || j % 50 == 0), 8.0, 0.99, "squares of 49 x 49 free");

    // Nine by seven free points in the middle of nowhere, against the matrix of these alone.
    let block = |i, j, [x, y]: [usize; 2]| !((x..x + 9).contains(&i) && (y..y + 7).contains(&j));
    let mut small = springs_only(13, 11);
    cloth(&mut small).height = 10.0 / 12.0;
    let points = (0..11).flat_map(|j| (0..13).map(move |i| [i, j]));
    cloth(&mut small).pinned = points.filter(|&[i, j]| block(i, j, [2, 2])).collect();
    let rest = Simulation::new(&small).unwrap().positions().clone();
    let exact = eigenvalues(&small, &rest, &rest).last().unwrap() / 5000.0;
    close(pinned(&|i, j| block(i, j, [101, 77])), exact, 0.999, "a block free");
}

/// The eigenvalues of the stiffness of `scene`'s springs with the points at `x`, straight from
/// the definition, pinned points held, smallest first, in N/m.
fn eigenvalues(scene: &Scene, x: &Points, rest: &Points) -> Vec<f64> {
    let cloth = scene.cloth.as_ref().unwrap();
    let (w, h) = (cloth.num_width_points as isize, cloth.num_height_points as isize);
    let mut matrix = nalgebra::DMatrix::<f64>::zeros(3 * x.len(), 3 * x.len());
    let stencils = [
        (cloth.enable_structural, [(1, 0), (0, 1)], 1.0),
        (cloth.enable_shearing, [(1, 1), (-1, 1)], 1.0),
        (cloth.enable_bending, [(2, 0), (0, 2)], 0.2),
    ];
    for (_, offsets, factor) in stencils.into_iter().filter(|(enabled, ..)| *enabled) {
        for ((dx, dy), p) in offsets.into_iter().flat_map(|offset| (0..w * h).map(move |p| (offset, p))) {
            let (i, j) = (p % w - dx, p / w - dy);
            if !(0..w).contains(&i) || j < 0 {
                continue;
            }
            let (a, b) = (p as usize, (j * w + i) as usize);
            let e = x.get(b) - x.get(a);
            let along = e * e.transpose() / e.norm_squared();
            let slack = 1.0 - (rest.get(b) - rest.get(a)).norm() / e.norm();
            let across = (nalgebra::Matrix3::identity() - along) * slack;
            let stiffness = (along + across) * (factor * cloth.ks);
            for (row, column, sign) in [(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)] {
                let mut block = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * column);
                block += stiffness * sign;
            }
        }
    }
    for &[i, j] in &cloth.pinned {
        for c in 0..3 {
            let index = 3 * (j * cloth.num_width_points + i) + c;
            matrix.row_mut(index).fill(0.0);
            matrix.column_mut(index).fill(0.0);
        }
    }
    let mut values: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Pinned points stay where they are, bit for bit, whatever touches them.
    #[test]
    fn pinned_points_never_move(
        pins in prop::collection::vec((0_usize..6, 0_usize..6), 1..8), radius in 0.1_f64..1.0,
    ) {
        let mut scene = scenes::sphere();
        scenes::ball_mut(&mut scene).origin = Vec3::new(0.5, 1.0, 0.5);
        scenes::ball_mut(&mut scene).radius = radius;
        scenes::add_plane(&mut scene, scenes::floor());
        let cloth = cloth(&mut scene);
        (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (6, 6, 0.15);
        cloth.pinned = pins.iter().map(|&(i, j)| [i, j]).collect();
        let mut simulation = Simulation::new(&scene).unwrap();
        let start = simulation.positions().clone();
        run(&mut simulation, 100);
        for (i, j) in pins {
            prop_assert_eq!(simulation.positions().get(j * 6 + i), start.get(j * 6 + i));
        }
        prop_assert!(distance(simulation.positions(), &start) > 0.0, "the others move");
    }

    /// The frequency at rest is that of the matrix, from below; the safe one bounds those of any
    /// configuration.
    #[test]
    fn stability_is_that_of_the_stiffness_matrix(
        points in (2_usize..7, 2_usize..7),
        size in (0.5_f64..2.0, 0.5_f64..2.0),
        kinds in any::<(bool, bool, bool)>(),
        pins in prop::collection::vec((0_usize..6, 0_usize..6), 0..4),
        crumple in 0.0_f64..2.0,
    ) {
        let mut scene = springs_only(points.0, points.1);
        let cloth = cloth(&mut scene);
        (cloth.width, cloth.height) = size;
        (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) = kinds;
        cloth.pinned = pins.iter().map(|&(i, j)| [i % points.0, j % points.1]).collect();
        let rest = Simulation::new(&scene).unwrap().positions().clone();
        let stability = Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
        let [found, safe] = [stability.omega_rest, stability.omega_safe].map(|omega| omega * omega * stability.mass);

        let exact = *eigenvalues(&scene, &rest, &rest).last().unwrap();
        prop_assert!(found <= exact + 1e-6, "at rest {found} N/m, above {exact} N/m");
        prop_assert!(found >= 0.98 * exact - 1e-6, "at rest {found} N/m, well below {exact} N/m");

        let mut x = rest.clone();
        for p in 0..x.len() {
            x.set(p, x.get(p) + Vec3::new(noise(3 * p), noise(3 * p + 1), noise(3 * p + 2)) * crumple);
        }
        let crumpled = *eigenvalues(&scene, &x, &rest).last().unwrap();
        prop_assert!(crumpled <= safe * (1.0 + 1e-9) + 1e-6, "crumpled {crumpled} N/m, above the bound {safe} N/m");
    }
}
