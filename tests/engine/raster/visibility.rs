//! Each pixel shows the nearest primitive, and of those at the same depth the one drawn first.

use crate::support::{Canvas, cases, flat};
use drape::raster::Primitives;
use proptest::prelude::*;

/// A triangle over the whole picture at depth (z + 1)/2.
fn cover(z: f32) -> [[f32; 4]; 3] {
    [[-1.0, -1.0, z, 1.0], [3.0, -1.0, z, 1.0], [-1.0, 3.0, z, 1.0]]
}

proptest! {
    #![proptest_config(cases(50))]

    /// More triangles than a chunk holds, over two tiles, many of them at the same depth.
    #[test]
    fn the_nearest_wins_and_of_equals_the_first(depths in prop::collection::vec(0..40_i8, 1..3000)) {
        let canvas = Canvas::new(70, 2);
        let depths: Vec<f32> = depths.into_iter().map(|depth| f32::from(depth) / 64.0).collect();
        let positions: Vec<[f32; 4]> = depths.iter().flat_map(|&z| cover(z)).collect();
        let triangles: Vec<[u32; 3]> = (0..).step_by(3).map(|i| [i, i + 1, i + 2]).take(depths.len()).collect();
        let nearest = depths.iter().copied().reduce(f32::min).unwrap();
        let first = (0..).zip(&depths).find(|&(_, &depth)| depth == nearest).unwrap().0;
        let picture = canvas.triangles(&positions, &triangles);
        prop_assert!(picture.ids.iter().all(|&id| id == (1 << 24) + first + 1));
        prop_assert!(picture.depth.iter().all(|&depth| depth == nearest * 0.5 + 0.5));
        prop_assert_eq!(picture.stats.covered, 140);
    }
}

/// Objects are numbered from 1 in the order of their calls; a triangle keeps its number, and so
/// does a line.
#[test]
fn ids_name_the_object_and_its_primitive() {
    let canvas = Canvas::new(4, 4);
    let far = [cover(0.5), cover(0.75)].concat();
    let line = [[-1.0, -0.2, 0.25, 1.0], [1.0, -0.2, 0.25, 1.0]];
    let both = Primitives::Triangles(&[[3, 4, 5], [0, 1, 2]]);
    let picture = canvas.draw(&[
        flat(both, &far, [1.0, 0.0, 0.0]),
        flat(both, &far, [0.0, 1.0, 0.0]),
        flat(Primitives::Lines(&[[0, 0], [0, 1]]), &line, [0.0, 0.0, 1.0]),
    ]);
    let (triangle, drawn_line) = (1 << 24 | 2, 3 << 24 | 2);
    let expected: Vec<u32> = (0..16).map(|i| if i / 4 == 2 { drawn_line } else { triangle }).collect();
    assert_eq!(picture.ids, expected);
    assert!(
        picture
            .rgb
            .iter()
            .zip(&expected)
            .all(|(&rgb, &id)| { rgb == if id == triangle { [255, 0, 0] } else { [0, 0, 255] } })
    );
    assert_eq!((picture.stats.covered, picture.stats.fragments), (16, 16));
}
