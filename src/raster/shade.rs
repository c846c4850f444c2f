//! Fragment stage: the fragment program over the interpolated varyings of a list of fragments.

use super::{
    covering::Covering,
    fragments::{BLOCK_PIXELS, FragmentList},
    interpolate::Interpolator,
    plane::ShadeInput,
    program::{FragmentProgram, Varyings},
    tiling::TILE,
};
use crate::lanes::{FragmentLanes, Lane, MAX_PARTS, Part};

/// Shades a list in the lanes of a level.
#[inline(always)]
pub(super) fn shade_vectors<S: FragmentLanes, const N: usize>(
    simd: S,
    program: &impl FragmentProgram<N>,
    input: &ShadeInput<'_>,
    list: &mut FragmentList,
) {
    shade::<S::Lanes, N>(simd, program, input, list);
}

/// Shades all fragments of a list, and what fills it up; colours are clamped to 0..=1, NaN is 0.
#[inline(always)]
pub(super) fn shade<L: Lane, const N: usize>(
    token: L::Token,
    program: &impl FragmentProgram<N>,
    input: &ShadeInput<'_>,
    list: &mut FragmentList,
) {
    let stage = program.stage::<L>(token);
    let width = <L::Part as Part>::WIDTH;
    let mut interpolator = Interpolator::new(input);
    let mut varyings = [[L::Part::splat(token, 0.0); N]; MAX_PARTS];
    let mut covering = None;
    let columns = width * L::PARTS;
    for group in 0..list.len.next_multiple_of(BLOCK_PIXELS).div_ceil(columns) {
        let mut first = group * columns;
        if let Some(primitive) = list.whole {
            // As many columns as there are lanes, from the top row to the bottom row, then those beside them.
            let (left, row) = (group / TILE * columns, group % TILE);
            first = row * TILE + left;
            if row == 0 {
                covering = Some(Covering::of(token, input, primitive, left, L::PARTS));
            }
            if let Some(covering) = &covering {
                covering.in_row(token, row, &mut varyings[..L::PARTS]);
            }
        } else {
            // A loop, and not as much code for each part.
            for (i, varyings) in varyings.iter_mut().enumerate().take(L::PARTS) {
                let part = first + i * width..first + (i + 1) * width;
                *varyings = interpolator.varyings::<L::Part>(
                    token,
                    &list.pixels[part.clone()],
                    &list.primitives[part.clone()],
                    list.places(part),
                );
            }
        }
        let color = stage(Varyings::from_numbers(
            #[inline(always)]
            |k| {
                L::from_parts(
                    #[inline(always)]
                    |i| varyings[i][k],
                )
            },
        ));
        let (red, green, blue) = (clamp(color.x), clamp(color.y), clamp(color.z));
        if list.shares_pixels {
            store(red, &mut list.colors[0][first..]);
            store(green, &mut list.colors[1][first..]);
            store(blue, &mut list.colors[2][first..]);
        } else {
            pack([red, green, blue], &mut list.packed[first..]);
        }
    }
}

/// Writes one channel of the fragments' colours.
#[inline(always)]
fn store<L: Lane>(channel: L, out: &mut [f32]) {
    let width = <L::Part as Part>::WIDTH;
    channel.each_part(
        #[inline(always)]
        |i, part| part.store(&mut out[i * width..]),
    );
}

/// Writes the fragments' colours as they are stored.
#[inline(always)]
fn pack<L: Lane>(channels: [L; 3], out: &mut [u32]) {
    let width = <L::Part as Part>::WIDTH;
    let mut first = 0;
    L::map_parts(
        channels,
        #[inline(always)]
        |rgb| {
            Part::store_rgba8(rgb, &mut out[first..]);
            first += width;
            rgb
        },
    );
}

/// Clamps to 0..=1; NaN gives 0.
#[inline(always)]
fn clamp<L: Lane>(x: L) -> L {
    x.all(1.0).min(x.max(x.all(0.0)))
}
