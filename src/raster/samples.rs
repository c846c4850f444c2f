//! Where the samples of a pixel lie: the standard positions of Direct3D 11 and Vulkan.

/// Offsets of the samples from the pixel's top left corner, in 1/16 pixel, x right and y down.
pub(super) fn positions(samples: usize) -> &'static [[i32; 2]] {
    match samples {
        4 => &[[6, 2], [14, 6], [2, 10], [10, 14]],
        8 => &[[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]],
        16 => &[
            [9, 9],
            [7, 5],
            [5, 10],
            [12, 7],
            [3, 6],
            [10, 13],
            [13, 11],
            [11, 3], //
            [6, 14],
            [8, 1],
            [4, 2],
            [2, 12],
            [0, 8],
            [15, 4],
            [14, 15],
            [1, 0],
        ],
        _ => &[[8, 8]],
    }
}
