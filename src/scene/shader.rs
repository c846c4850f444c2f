//! The shaders: a row each.

use super::{json::choice::choices, needs::Needs};

/// Makes [`Shader`] of rows: description, variant, name in scene files, and what the programs read besides
/// the position (the fields of [`Needs`]).
macro_rules! shaders {
    ($($(#[doc = $doc:literal])* $shader:ident = $name:literal reads [$($read:ident),*];)*) => {
        choices! {
            /// Which program draws an object (`material.shader`).
            pub enum Shader {
                $($(#[doc = $doc])* $shader = $name,)*
            }
        }

        impl Needs {
            /// What `shader` reads.
            #[allow(clippy::needless_update, reason = "a shader may read everything")]
            pub fn of(shader: Shader) -> Self {
                match shader {
                    $(Shader::$shader => Self { $($read: true,)* ..Self::NOTHING },)*
                }
            }
        }
    };
}

shaders! {
    /// The springs of the cloth as lines; other objects flat. Reads `color`.
    Wireframe = "wireframe" reads [];
    /// The direction of the surface as a colour.
    Normal = "normal" reads [normal];
    /// Matt, in the light (Lambert's law). Reads `color` and `kd`.
    Diffuse = "diffuse" reads [normal];
    /// Matt with a highlight and some light everywhere (Blinn-Phong). Reads `color`, `ka`, `kd`, `ks` and
    /// `shininess`. As in the course, the highlight also reaches what faces away from the light, and only the side of
    /// the normal is lit: from below, the underside is as bright as the top, and the stock `selfCollision` shows its
    /// unlit side (`two_sided` lights both).
    Phong = "phong" reads [normal];
    /// The texture alone, without light. Reads `texture`.
    Texture = "texture" reads [uv, texture];
    /// As `phong`, with the relief of the height map shaded on a smooth surface. Also reads `height_map`,
    /// `normal_scaling` and `height_scaling`.
    Bump = "bump" reads [normal, tangent, uv, height_map];
    /// As `bump`, with the surface itself moved along its normal, so that the outline shows it too. Reads the
    /// same keys.
    Displacement = "displacement" reads [normal, tangent, uv, height_map];
    /// The environment, mirrored. Reads `environment`.
    Mirror = "mirror" reads [normal, environment];
    /// A glossy ceramic: displacement, texture, tinted highlight and mirror image together. Reads the keys of
    /// `displacement` except `color`, and `texture`, `environment`, `km` and `light.color`.
    Custom = "custom" reads [normal, tangent, uv, texture, height_map, environment];
}
