//! The names that scene files and the command line give to the choices of a [`super::Scene`].

use super::{Contact, Damping, Filter, Integrator, Precision, SelfCollision, Shader, Start};

impl Shader {
    /// Every shader with its name, in the order of the report.
    pub const NAMES: &'static [(&'static str, Self)] = &[
        ("wireframe", Self::Wireframe),
        ("normal", Self::Normal),
        ("diffuse", Self::Diffuse),
        ("phong", Self::Phong),
        ("texture", Self::Texture),
        ("bump", Self::Bump),
        ("displacement", Self::Displacement),
        ("mirror", Self::Mirror),
        ("custom", Self::Custom),
    ];

    /// The name of this shader.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, shader)| *shader == self).map_or("", |(name, _)| name)
    }
}

impl Integrator {
    /// Every integrator with its name.
    pub const NAMES: &'static [(&'static str, Self)] = &[
        ("verlet", Self::Verlet),
        ("rk4", Self::Rk4),
        ("xpbd", Self::Xpbd),
        ("implicit_euler", Self::ImplicitEuler),
        ("bdf2", Self::Bdf2),
    ];

    /// The name of this integrator.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, integrator)| *integrator == self).map_or("", |(name, _)| name)
    }
}

/// `sim.precision`
pub(super) const PRECISIONS: &[(&str, Precision)] = &[("f64", Precision::F64), ("f32", Precision::F32)];

/// `sim.start`
pub(super) const STARTS: &[(&str, Start)] = &[("report", Start::Report), ("half_step", Start::HalfStep)];

/// `sim.damping`
pub(super) const DAMPINGS: &[(&str, Damping)] =
    &[("per_step", Damping::PerStep), ("per_second", Damping::PerSecond)];

/// `sim.self_collision`
pub(super) const SELF_COLLISIONS: &[(&str, SelfCollision)] = &[
    ("same_box", SelfCollision::SameBox),
    ("neighbors", SelfCollision::Neighbors),
    ("off", SelfCollision::Off),
];

/// `sim.contact`
pub(super) const CONTACTS: &[(&str, Contact)] = &[("report", Contact::Report), ("outside", Contact::Outside)];

/// `render.filter`
pub(super) const FILTERS: &[(&str, Filter)] = &[("nearest", Filter::Nearest), ("bilinear", Filter::Bilinear)];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shader_has_one_name() {
        let names: std::collections::BTreeSet<_> = Shader::NAMES.iter().map(|(_, s)| s.name()).collect();
        assert_eq!(names.len(), 9);
        assert!(!names.contains(""));
        for (name, shader) in Shader::NAMES {
            assert_eq!(shader.name(), *name);
        }
    }
}
