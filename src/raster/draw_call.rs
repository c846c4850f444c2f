//! Draw calls: a mesh with its two programs.

use super::{
    fragments::FragmentList,
    plane::ShadeInput,
    primitives::Primitives,
    program::{FragmentProgram, VertexProgram},
    setup::Viewport,
    shade::{shade, shade_vectors},
    vertex::VertexBuffer,
};
use crate::lanes::{Lane, level::dispatch};

type VertexStage<'a> = Box<dyn Fn(&Viewport, &mut VertexBuffer) + Send + Sync + 'a>;
type FragmentStage<'a> = Box<dyn Fn(&ShadeInput<'_>, &mut FragmentList) + Send + Sync + 'a>;

/// A mesh with its two programs.
///
/// The vertex program is a closure; what it puts out besides the position reaches the fragment program
/// interpolated, under the same name. A triangle in stripes:
///
/// ```
/// use drape::glsl::{float, vec3};
/// use drape::raster::{DrawCall, Framebuffer, Primitives, draw};
///
/// drape::varyings! { struct Striped { v_x: float } }
/// drape::fragment_program! {
///     /// Four stripes a unit.
///     struct Stripes {}
///     |Striped { v_x }| {
///         let part = v_x * 4.0 - (v_x * 4.0).floor();
///         vec3(part, part.all(0.5), float(1.0) - part)
///     }
/// }
///
/// let corners = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]];
/// let vertex_program = |&[x, y]: &[f32; 2]| ([x, y, 0.0, 1.0], Striped { v_x: x });
/// let triangle = Primitives::Triangles(&[[0, 1, 2]]);
/// let call = DrawCall::new(triangle, 3, |i| corners[i], vertex_program, Stripes {});
/// let mut framebuffer = Framebuffer::new(64, 64, 1);
/// let stats = draw(&mut framebuffer, [0.0; 3], &[call], false);
/// assert_eq!(stats.covered, 64 * 64 / 2);
/// // Right of the middle x = 1 / 64, which is 1 / 16 of a stripe.
/// assert_eq!(framebuffer.rgb()[3 * (63 * 64 + 32)..][..3], [16, 128, 239]);
/// ```
pub struct DrawCall<'a> {
    pub(super) primitives: Primitives<'a>,
    vertex_stage: VertexStage<'a>,
    fragment_stage: FragmentStage<'a>,
}

impl<'a> DrawCall<'a> {
    /// Draws `primitives` over `count` vertices, whose attributes may be anything that the vertex program
    /// takes. Fragments are shaded with the widest vectors that the CPU has, with the same bits on all.
    pub fn new<A, F: FragmentProgram<N> + 'a, const N: usize>(
        primitives: Primitives<'a>,
        count: usize,
        attributes: impl Fn(usize) -> A + Send + Sync + 'a,
        vertex_program: impl VertexProgram<A, F::Varyings<f32>> + 'a,
        fragment_program: F,
    ) -> Self {
        Self {
            primitives,
            vertex_stage: vertex_stage(count, attributes, vertex_program),
            fragment_stage: fragment_stage(fragment_program),
        }
    }

    /// Like [`DrawCall::new`], but shades one fragment at a time in numbers of type `L`: in `f32` with the
    /// same bits, or in [`F64`](crate::lanes::F64), to see what `f32` loses.
    pub fn one_by_one<L: Lane<Token = ()>, A, F: FragmentProgram<N> + 'a, const N: usize>(
        primitives: Primitives<'a>,
        count: usize,
        attributes: impl Fn(usize) -> A + Send + Sync + 'a,
        vertex_program: impl VertexProgram<A, F::Varyings<f32>> + 'a,
        fragment_program: F,
    ) -> Self {
        Self {
            primitives,
            vertex_stage: vertex_stage(count, attributes, vertex_program),
            fragment_stage: fragment_stage_one_by_one::<L, F, N>(fragment_program),
        }
    }

    /// Runs the vertex program over all vertices, and projects them into the window.
    pub(super) fn shade_vertices(&self, viewport: &Viewport, buffer: &mut VertexBuffer) {
        (self.vertex_stage)(viewport, buffer);
    }

    /// Runs the fragment program over a list.
    pub(super) fn shade(&self, input: &ShadeInput<'_>, list: &mut FragmentList) {
        (self.fragment_stage)(input, list);
    }
}

fn vertex_stage<'a, A, V: super::Varyings<f32, N>, const N: usize>(
    count: usize,
    attributes: impl Fn(usize) -> A + Send + Sync + 'a,
    program: impl VertexProgram<A, V> + 'a,
) -> VertexStage<'a> {
    Box::new(move |viewport, buffer| buffer.fill(count, viewport, &attributes, &program))
}

// The two kinds of fragment stage are functions of their own so that each program is compiled once, whatever vertex
// programs it is drawn with.

fn fragment_stage<'a, F: FragmentProgram<N> + 'a, const N: usize>(program: F) -> FragmentStage<'a> {
    Box::new(move |input, list| dispatch!(simd => shade_vectors(simd, &program, input, list)))
}

fn fragment_stage_one_by_one<'a, L: Lane<Token = ()>, F: FragmentProgram<N> + 'a, const N: usize>(
    program: F,
) -> FragmentStage<'a> {
    Box::new(move |input, list| shade::<L, N>((), &program, input, list))
}
