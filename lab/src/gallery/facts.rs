//! The text under a picture: its parameters, the stability of its step, its energy.

use super::shot::{Shot, State};
use drape::diagnostics::stability::Stability;
use drape::scene::{Cloth, Material, Scene, Shader};

/// The parameters of a picture.
pub(super) fn parameters(shot: &Shot, state: &State) -> String {
    let scene = &shot.scene;
    let mut parts = Vec::new();
    if let Some(cloth) = &scene.cloth {
        parts.push(cloth_parameters(cloth));
        parts.push(format!("{} frames/s, {} steps each", scene.sim.fps, scene.sim.steps_per_frame));
        parts.push(format!("frame {}, {:.3} s", state.frame, state.time));
    } else {
        parts.push("no cloth".to_owned());
    }
    parts.extend(drawing(scene));
    parts.push(format!("camera at polar {}°, azimuth {}°", scene.camera.polar, scene.camera.azimuth));
    parts.join(" · ")
}

fn cloth_parameters(cloth: &Cloth) -> String {
    let Cloth { density, ks, damping, .. } = cloth;
    let pins = cloth.pinned.iter().map(|[i, j]| format!(" ({i}, {j})")).collect::<String>();
    let pins = if pins.is_empty() { pins } else { format!(" · pinned{pins}") };
    let kinds = [
        ("structural", cloth.enable_structural),
        ("shearing", cloth.enable_shearing),
        ("bending", cloth.enable_bending),
    ];
    let kinds: Vec<_> = kinds.iter().filter(|(_, on)| *on).map(|(name, _)| *name).collect();
    format!(
        "density {density} kg/m² ({} in the viewer) · ks {ks} N/m · damping {damping} % a step · \
         springs {}{pins}",
        density / 10.0,
        kinds.join(", "),
    )
}

/// The parameters of how the objects are drawn.
fn drawing(scene: &Scene) -> Vec<String> {
    let Some(material) = scene.materials().next() else { return Vec::new() };
    let Material { shader, ka, kd, ks, normal_scaling, height_scaling, .. } = material;
    let mut parts = vec![format!("shader {}", shader.name())];
    if *shader == Shader::Phong {
        parts.push(format!("ka {ka}, kd {kd}, ks {ks}"));
    }
    if matches!(shader, Shader::Bump | Shader::Displacement | Shader::Custom) {
        parts.push(format!("normal {normal_scaling}, height {height_scaling}"));
    }
    if *shader == Shader::Custom {
        let color = scene.light.color;
        parts.push(format!("light ({}, {}, {})", color.x, color.y, color.z));
    }
    let balls = scene.spheres().map(|sphere| sphere.resolution);
    parts.extend(balls.map(|[latitudes, longitudes]| format!("ball of {latitudes} × {longitudes} cells")));
    parts
}

/// The step compared with the bounds of stability.
pub(super) fn margin(state: &State) -> String {
    let Some(stability) = state.stability else {
        return "Nothing moves, so there is no step.".to_owned();
    };
    let Stability { dt, limit, limit_worst, omega_rest, omega_safe, .. } = stability;
    let (rest, worst) = (dt * omega_rest, dt * omega_safe);
    let undamped =
        if limit_worst < limit { format!(" at rest, {limit_worst:.3} at worst") } else { String::new() };
    let verdict = if stability.is_always_stable() {
        "stable at worst"
    } else if !stability.is_unstable_at_rest() {
        "stable at rest, not at worst"
    } else {
        "unstable"
    };
    format!("dt·ω = {rest:.3} at rest, {worst:.3} at worst; the limit is {limit:.3}{undamped}: {verdict}.")
}

/// The energy that each phase put in or took out so far, and the kinetic energy now.
pub(super) fn ledger(state: &State) -> String {
    let Some(ledger) = state.ledger.filter(|_| state.frame > 0) else {
        return "Nothing has moved yet.".to_owned();
    };
    let entries = ledger.entries().filter(|(_, joule)| *joule != 0.0);
    let entries: Vec<_> =
        entries.map(|(name, joule)| format!("{} {}", name.replace('_', " "), joules(joule))).collect();
    format!(
        "{}; in all {}. Kinetic energy now {}.",
        entries.join(", "),
        joules(ledger.sum()),
        joules(state.energy.kinetic).trim_start_matches('+'),
    )
}

/// An energy with its sign and about four digits.
fn joules(energy: f64) -> String {
    let text = match energy.abs() {
        size if size >= 1e5 || (size < 1e-3 && size > 0.0) => format!("{energy:+.2e} J"),
        size if size >= 100.0 => format!("{energy:+.0} J"),
        size if size >= 1.0 => format!("{energy:+.2} J"),
        _ => format!("{energy:+.4} J"),
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energies_keep_their_first_digits() {
        let cases = [
            (123_456.0, "+1.23e5 J"),
            (-1234.5, "−1234 J"),
            (-12.345, "−12.35 J"),
            (0.012_34, "+0.0123 J"),
            (1.234e-9, "+1.23e−9 J"),
            (0.0, "+0.0000 J"),
        ];
        for (energy, text) in cases {
            assert_eq!(joules(energy), text);
        }
    }
}
