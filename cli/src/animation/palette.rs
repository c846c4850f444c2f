//! The colours of a picture that has room for 256 of them.
//!
//! Boxes of colours are cut where that lowers the sum of squared errors most (as Wu 1991 does, at the mean), and
//! their means are then moved to where they fit best (Lloyd 1982). All sums are whole numbers.

use std::collections::BTreeMap;

/// Most colours of a picture.
const MOST: usize = 256;

/// How often the colours are moved.
const ROUNDS: usize = 6;

/// A colour, and how many pixels have it.
type Counted = ([u8; 3], u64);

/// At most 256 colours.
pub(crate) struct Palette(Vec<[u8; 3]>);

/// Some of the colours of a picture.
struct Part<'a> {
    colors: &'a mut [Counted],
    /// The axis along which they differ most, and by how much: the sum of the squares.
    axis: usize,
    spread: f64,
}

impl Palette {
    /// The palette of pixels of three bytes each, and the number of each pixel's colour in it.
    pub(crate) fn of(pixels: &[u8]) -> (Self, Vec<u8>) {
        let mut counts = BTreeMap::new();
        for &pixel in pixels.as_chunks::<3>().0 {
            *counts.entry(pixel).or_insert(0_u64) += 1;
        }
        let colors: Vec<Counted> = counts.into_iter().collect();
        let palette = if colors.len() <= MOST {
            Self(colors.iter().map(|(color, _)| *color).collect())
        } else {
            Self(chosen(&colors))
        };
        let numbers: BTreeMap<[u8; 3], u8> =
            colors.iter().map(|(color, _)| (*color, nearest(&palette.0, *color))).collect();
        let indices = pixels.as_chunks::<3>().0.iter().map(|pixel| numbers[pixel]).collect();
        (palette, indices)
    }

    /// Red, green and blue of each colour.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.0.into_flattened()
    }
}

/// The colours that stand for all.
fn chosen(colors: &[Counted]) -> Vec<[u8; 3]> {
    let mut sorted = colors.to_vec();
    let mut parts = vec![Part::of(&mut sorted)];
    while parts.len() < MOST {
        let widest =
            (0..parts.len()).max_by(|&a, &b| parts[a].spread.total_cmp(&parts[b].spread).then(b.cmp(&a)));
        let Some(widest) = widest.filter(|&widest| parts[widest].colors.len() > 1) else { break };
        let [low, high] = parts.swap_remove(widest).cut();
        parts.extend([low, high]);
    }
    let mut palette: Vec<[u8; 3]> = parts.iter().map(|part| mean(part.colors.iter().copied())).collect();
    for _ in 0..ROUNDS {
        let mut groups = vec![Vec::new(); palette.len()];
        for &(color, count) in colors {
            groups[usize::from(nearest(&palette, color))].push((color, count));
        }
        let moved = palette.iter().zip(&groups);
        let moved: Vec<[u8; 3]> = moved
            .map(|(old, group)| if group.is_empty() { *old } else { mean(group.iter().copied()) })
            .collect();
        if moved == palette {
            break;
        }
        palette = moved;
    }
    palette
}

impl<'a> Part<'a> {
    fn of(colors: &'a mut [Counted]) -> Self {
        let spreads = [0, 1, 2].map(|axis| spread(colors, axis));
        let axis = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b]).then(b.cmp(&a))).unwrap_or(0);
        Self { colors, axis, spread: spreads[axis] }
    }

    /// The colours below the mean and the others.
    fn cut(self) -> [Self; 2] {
        let Self { colors, axis, .. } = self;
        colors.sort_unstable_by_key(|(color, _)| (color[axis], *color));
        let (sum, count) = sums(colors, axis);
        // The last is above the mean, since they differ.
        let below = colors.partition_point(|(color, _)| u64::from(color[axis]) * count <= sum);
        let (low, high) = colors.split_at_mut(below.clamp(1, colors.len() - 1));
        [Self::of(low), Self::of(high)]
    }
}

fn sums(colors: &[Counted], axis: usize) -> (u64, u64) {
    colors
        .iter()
        .fold((0, 0), |(sum, all), (color, count)| (sum + u64::from(color[axis]) * count, all + count))
}

/// The sum of the squared distances from the mean along one axis.
#[expect(clippy::cast_precision_loss, reason = "sums of at most 2^28 pixels")]
fn spread(colors: &[Counted], axis: usize) -> f64 {
    let (sum, count) = sums(colors, axis);
    let squares: u64 =
        colors.iter().map(|(color, count)| u64::from(color[axis]) * u64::from(color[axis]) * count).sum();
    squares as f64 - sum as f64 * (sum as f64 / count as f64)
}

fn mean(colors: impl Iterator<Item = Counted>) -> [u8; 3] {
    let (mut sums, mut all) = ([0; 3], 0);
    for (color, count) in colors {
        (0..3).for_each(|axis| sums[axis] += u64::from(color[axis]) * count);
        all += count;
    }
    sums.map(|sum| u8::try_from((2 * sum + all) / (2 * all).max(1)).unwrap_or(u8::MAX))
}

/// The number of the nearest colour, the first of several.
fn nearest(palette: &[[u8; 3]], color: [u8; 3]) -> u8 {
    let distance = |other: &[u8; 3]| -> u32 {
        (0..3).map(|axis| u32::from(other[axis].abs_diff(color[axis])).pow(2)).sum()
    };
    let best = (0..palette.len()).min_by_key(|&i| distance(&palette[i])).unwrap_or(0);
    u8::try_from(best).unwrap_or(u8::MAX)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::cast_possible_truncation, reason = "colours are small")]

    use super::*;

    /// The mean difference of a channel.
    fn error(pixels: &[u8]) -> f64 {
        let (palette, indices) = Palette::of(pixels);
        let shown = indices.iter().flat_map(|&i| palette.0[usize::from(i)]);
        let sum: u64 = shown.zip(pixels).map(|(a, &b)| u64::from(a.abs_diff(b))).sum();
        sum as f64 / pixels.len() as f64
    }

    #[test]
    fn few_colours_are_exact_and_many_are_near() {
        let few: Vec<u8> = (0..1000_u32).flat_map(|i| [(i % 256) as u8, 7, 9]).collect();
        assert_eq!(error(&few), 0.0);
        // A smooth surface with a highlight, in one colour: 4096 pixels.
        let shade = |i: i32| {
            let (x, y) = (i % 64 - 32, i / 64 - 32);
            let r = f64::from(x * x + y * y);
            let light = 1.0 / (1.0 + r / 600.0);
            [0.9 * light + 0.1, 0.6 * light + 0.05, 0.3 * light + 0.3 * light * light]
                .map(|c| (c * 255.0).min(255.0) as u8)
        };
        let smooth: Vec<u8> = (0..4096).flat_map(shade).collect();
        assert!(error(&smooth) < 0.001, "{}", error(&smooth));
        let noise: Vec<u8> = (0..12_000_u64).map(|i| drape::math::splitmix64(i) as u8).collect();
        assert!(error(&noise) < 9.0, "{}", error(&noise));
    }
}
