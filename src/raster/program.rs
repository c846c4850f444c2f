//! Programs: what the stages of a draw call run, and the varyings that connect them.

use std::marker::PhantomData;

use crate::{glsl::Vec3, lanes::Lane};

/// What a vertex program puts out: `gl_Position`, and the varyings `V`.
pub type VertexOutput<V> = ([f32; 4], V);

/// A vertex program, called once a vertex with its attributes.
pub trait VertexProgram<A, V>: Fn(&A) -> VertexOutput<V> + Send + Sync {}
impl<A, V, F: Fn(&A) -> VertexOutput<V> + Send + Sync> VertexProgram<A, V> for F {}

/// A fragment program: uniforms, and the closure over them that computes a linear colour from varyings.
///
/// Lanes differ from CPU to CPU, and a closure cannot be generic over them, so the program is asked for
/// one for each kind of lanes. [`fragment_program!`](crate::fragment_program) writes all of this.
pub trait FragmentProgram<const N: usize>: Send + Sync {
    /// The varyings that it reads, `N` numbers in all.
    type Varyings<L: Lane>: Varyings<L, N>;

    /// The closure for lanes `L`. Method and closure must be `#[inline(always)]`: what is not inlined is
    /// compiled without the vectors, and is many times slower.
    fn stage<L: Lane>(&self, token: L::Token) -> impl Fn(Self::Varyings<L>) -> Vec3<L>;
}

/// A struct of `N` numbers, which the rasteriser interpolates without knowing what they mean. Made by
/// [`varyings!`](crate::varyings).
pub trait Varyings<L, const N: usize> {
    /// Number `i` is `number(i)`.
    fn from_numbers(number: impl FnMut(usize) -> L) -> Self;
    /// Writes the numbers to `out`, which has `N` elements.
    fn write(self, out: &mut [L]);
}

/// A field of [`Varyings`]: `float`, `vec2` or `vec3`.
pub trait Varying<L> {
    /// The field from the numbers `first..`.
    fn read(number: &mut impl FnMut(usize) -> L, first: usize) -> Self;
    /// Writes its numbers to `out[first..]`.
    fn write(self, out: &mut [L], first: usize);
}

/// A uniform: the same for all fragments of a draw call.
pub trait Uniform {
    /// The uniform as the closure of a [`FragmentProgram`] sees it.
    type In<L: Lane>;
    /// Puts it in every lane.
    fn in_lanes<L: Lane>(&self, token: L::Token) -> Self::In<L>;
}

/// No varyings at all.
#[derive(Clone, Copy, Debug)]
pub struct NoVaryings<L>(PhantomData<L>);

impl NoVaryings<f32> {
    /// How many numbers they are.
    pub const COUNT: usize = 0;
}

impl<L> Default for NoVaryings<L> {
    fn default() -> Self {
        Self(PhantomData)
    }
}

impl<L> Varyings<L, 0> for NoVaryings<L> {
    #[inline(always)]
    fn from_numbers(_number: impl FnMut(usize) -> L) -> Self {
        Self(PhantomData)
    }
    #[inline(always)]
    fn write(self, _out: &mut [L]) {}
}

impl<L> Varying<L> for L {
    #[inline(always)]
    fn read(number: &mut impl FnMut(usize) -> L, first: usize) -> Self {
        number(first)
    }
    #[inline(always)]
    fn write(self, out: &mut [L], first: usize) {
        out[first] = self;
    }
}

impl<L> Varying<L> for [L; 2] {
    #[inline(always)]
    fn read(number: &mut impl FnMut(usize) -> L, first: usize) -> Self {
        [number(first), number(first + 1)]
    }
    #[inline(always)]
    fn write(self, out: &mut [L], first: usize) {
        let [x, y] = self;
        (out[first], out[first + 1]) = (x, y);
    }
}

impl<L> Varying<L> for Vec3<L> {
    #[inline(always)]
    fn read(number: &mut impl FnMut(usize) -> L, first: usize) -> Self {
        Self { x: number(first), y: number(first + 1), z: number(first + 2) }
    }
    #[inline(always)]
    fn write(self, out: &mut [L], first: usize) {
        (out[first], out[first + 1], out[first + 2]) = (self.x, self.y, self.z);
    }
}

impl Uniform for f32 {
    type In<L: Lane> = L;
    #[inline(always)]
    fn in_lanes<L: Lane>(&self, token: L::Token) -> L {
        L::splat(token, *self)
    }
}

impl Uniform for [f32; 3] {
    type In<L: Lane> = Vec3<L>;
    #[inline(always)]
    fn in_lanes<L: Lane>(&self, token: L::Token) -> Vec3<L> {
        let [x, y, z] = *self;
        Vec3 { x: L::splat(token, x), y: L::splat(token, y), z: L::splat(token, z) }
    }
}

/// Defines a struct of varyings. Its fields are of type `float`, `vec2` or `vec3`, and are named as in
/// GLSL: programs that do not agree on them do not compile.
///
/// ```
/// drape::varyings! {
///     /// Of a surface with a texture.
///     pub struct Textured { v_normal: vec3, v_uv: vec2 }
/// }
/// ```
#[macro_export]
macro_rules! varyings {
    ($(#[$meta:meta])* $vis:vis struct $name:ident { $($field:ident: $kind:ident),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug)]
        $vis struct $name<L> {
            $(#[doc = concat!("`", stringify!($kind), " ", stringify!($field), "`")]
            pub $field: $crate::glsl::$kind<L>,)+
        }

        impl $name<f32> {
            /// How many numbers they are.
            pub const COUNT: usize = 0 $(+ $crate::varyings!(@count $kind))+;
        }

        impl<L: Copy> $crate::raster::Varyings<L, { 0 $(+ $crate::varyings!(@count $kind))+ }> for $name<L> {
            #[inline(always)]
            fn from_numbers(mut number: impl FnMut(usize) -> L) -> Self {
                let next = 0;
                $(let ($field, next) = (
                    $crate::raster::Varying::read(&mut number, next),
                    next + $crate::varyings!(@count $kind),
                );)+
                let _: usize = next;
                Self { $($field),+ }
            }

            #[inline(always)]
            fn write(self, out: &mut [L]) {
                let next = 0;
                $($crate::raster::Varying::write(self.$field, out, next);
                let next = next + $crate::varyings!(@count $kind);)+
                let _: usize = next;
            }
        }
    };
    (@count float) => { 1 };
    (@count vec2) => { 2 };
    (@count vec3) => { 3 };
}

/// Defines a fragment program: a struct of its uniforms, and a closure over them from varyings to a
/// linear colour.
///
/// ```
/// use drape::glsl::{Vec3, normalize};
///
/// drape::varyings! { struct Lit { v_normal: vec3 } }
/// drape::fragment_program! {
///     /// The normal under a tint.
///     struct Tinted { u_tint: [f32; 3] }
///     |Lit { v_normal }| normalize(v_normal) * u_tint
/// }
/// ```
#[macro_export]
macro_rules! fragment_program {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident $(<$life:lifetime>)? { $($uniform:ident: $kind:ty),* $(,)? }
        |$varyings:ident { $($varying:ident),* $(,)? }| $color:expr
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug)]
        $vis struct $name $(<$life>)? {
            $(#[doc = concat!("`", stringify!($uniform), "`")]
            pub $uniform: $kind,)*
        }

        impl $(<$life>)? $crate::raster::FragmentProgram<{ <$varyings<f32>>::COUNT }>
            for $name $(<$life>)?
        {
            type Varyings<L: $crate::lanes::Lane> = $varyings<L>;

            #[inline(always)]
            fn stage<L: $crate::lanes::Lane>(
                &self,
                token: L::Token,
            ) -> impl Fn($varyings<L>) -> $crate::glsl::Vec3<L> {
                $(let $uniform = $crate::raster::Uniform::in_lanes::<L>(&self.$uniform, token);)*
                let _ = token;
                #[inline(always)]
                move |varyings: $varyings<L>| {
                    let $varyings { $($varying,)* .. } = varyings;
                    $color
                }
            }
        }
    };
}
