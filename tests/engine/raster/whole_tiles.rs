//! A tile that a triangle covers alone takes a shorter way, and shows nothing of it.

use std::sync::Mutex;

use crate::support::{Canvas, Picture, Record, Vertex, cases, program};
use drape::raster::{DrawCall, Framebuffer, Primitives, draw};
use proptest::prelude::*;

/// Six whole tiles, and some that are cut by the picture's edge.
const CANVAS: Canvas = Canvas::new(200, 140);

/// A triangle around the picture, seen in perspective.
fn around() -> impl Strategy<Value = [Vertex; 3]> {
    let vertex = |[x, y]: [f32; 2]| {
        (0.5..2.0_f32, -0.999..0.999_f32, prop::array::uniform3(0.0..1.0_f32), 1.0..3.0_f32).prop_map(
            move |(w, z, varyings, far)| Vertex { clip: [x * far * w, y * far * w, z * w, w], varyings },
        )
    };
    [vertex([-3.0, -1.0]), vertex([3.0, -1.0]), vertex([0.0, 5.0])]
}

/// The same triangle in `calls` draw calls, of which only the first is seen.
fn picture(canvas: Canvas, corners: &[Vertex; 3], calls: usize) -> Picture {
    let colors = Mutex::new(Vec::new());
    let call = || {
        let triangle = Primitives::Triangles(&[[0, 1, 2]]);
        DrawCall::new(triangle, 3, |i| corners[i], program, Record(&colors))
    };
    canvas.draw(&(0..calls).map(|_| call()).collect::<Vec<_>>())
}

proptest! {
    #![proptest_config(cases(60))]

    /// With a second triangle behind it nothing can be left out.
    #[test]
    fn what_is_alone_looks_as_if_it_were_not(corners in around(), samples in prop::sample::select(vec![1, 4, 8, 16])) {
        let canvas = CANVAS.samples(samples);
        let (alone, twice) = (picture(canvas, &corners, 1), picture(canvas, &corners, 2));
        prop_assert!(alone.ids.iter().all(|&id| id == 1 << 24 | 1), "the picture is not covered");
        prop_assert!(alone.ids == twice.ids, "ids differ");
        prop_assert!(alone.rgb == twice.rgb, "colours differ");
        let bits = |picture: &Picture| picture.depth.iter().map(|depth| depth.to_bits()).collect::<Vec<_>>();
        prop_assert!(bits(&alone) == bits(&twice), "depths differ");
        let counts = |picture: &Picture| (picture.stats.fragments, picture.stats.covered);
        prop_assert_eq!(counts(&alone), counts(&twice));
    }
}

/// Nothing of a picture is left in the next one.
#[test]
fn a_framebuffer_forgets_what_covered_it() {
    let vertex = |clip: [f32; 4]| Vertex { clip, varyings: [1.0; 3] };
    let corners = [[-3.0, -1.0, 0.0, 1.0], [3.0, -1.0, 0.2, 1.0], [0.0, 5.0, 0.4, 1.0]].map(vertex);
    let colors = Mutex::new(Vec::new());
    for samples in [1, 4] {
        let mut framebuffer = Framebuffer::new(128, 128, samples);
        let triangle = Primitives::Triangles(&[[0, 1, 2]]);
        let call = DrawCall::new(triangle, 3, |i| corners[i], program, Record(&colors));
        assert_eq!(draw(&mut framebuffer, [0.0; 3], &[call], false).covered, 128 * 128);
        assert!(framebuffer.depth().iter().all(|depth| (0.5..0.7).contains(depth)));
        let rest = draw(&mut framebuffer, [0.0; 3], &[], false);
        assert_eq!((rest.covered, rest.fragments), (0, 0));
        assert!(framebuffer.depth().iter().all(|&depth| depth == 1.0));
        assert!(framebuffer.rgb().iter().all(|&byte| byte == 0));
    }
}
