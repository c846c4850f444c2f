//! The comparator of pictures: exact unless a budget of differences is allowed.
//!
//! The magnitude of a pixel's difference is the largest difference of its four channels, alpha
//! included. No neighbourhood is searched: a picture moved by one pixel differs.

use std::str::FromStr;

use super::png::Pixels;

/// How two pictures differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Number of pixels per magnitude 0..=255.
    histogram: Vec<u64>,
    /// Root of the mean squared channel difference, 0..=255. Alpha is among the channels only
    /// when either picture has a pixel that is not opaque.
    pub rmse: f64,
}

impl Difference {
    /// Compares two pictures; the result does not depend on their order. When the sizes differ,
    /// every pixel of the smallest rectangle that holds both counts as different by 255.
    pub fn between(expected: &Pixels, actual: &Pixels) -> Self {
        Self::between_where(expected, actual, |_| true)
    }

    /// As [`Difference::between`], over the pixels for whose index `counts` is true: the others are left out
    /// of everything. It is not asked when the sizes differ.
    pub fn between_where(expected: &Pixels, actual: &Pixels, counts: impl Fn(usize) -> bool) -> Self {
        let mut histogram = vec![0; 256];
        if !same_size(expected, actual) {
            let [width, height] = common_size(expected, actual);
            histogram[255] = u64::from(width) * u64::from(height);
            return Self { histogram, rmse: 255.0 };
        }
        let (mut squares, mut pixels, mut opaque) = (0_u64, 0_u64, true);
        let pairs = expected.rgba.iter().zip(&actual.rgba).enumerate().filter(|(i, _)| counts(*i));
        for (_, (e, a)) in pairs {
            histogram[usize::from(magnitude(e, a))] += 1;
            squares += channel_differences(e, a).map(|d| u64::from(d) * u64::from(d)).iter().sum::<u64>();
            opaque &= e[3] == 255 && a[3] == 255;
            pixels += 1;
        }
        let channels = if opaque { 3 } else { 4 };
        #[expect(clippy::cast_precision_loss, reason = "a sum over at most 2^28 pixels fits in 53 bits")]
        let mean = squares as f64 / (channels * pixels).max(1) as f64;
        Self { histogram, rmse: mean.sqrt() }
    }

    /// The difference of several pairs of pictures as one: counts add up, and the mean is over all pixels.
    pub fn joined(differences: &[Self]) -> Self {
        let mut histogram = vec![0; 256];
        let (mut squares, mut pixels) = (0.0, 0.0);
        for difference in differences {
            histogram.iter_mut().zip(&difference.histogram).for_each(|(sum, count)| *sum += count);
            #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 pixels")]
            let count = difference.pixels() as f64;
            squares += difference.rmse * difference.rmse * count;
            pixels += count;
        }
        Self { histogram, rmse: if pixels > 0.0 { (squares / pixels).sqrt() } else { 0.0 } }
    }

    /// Number of pixels compared.
    pub fn pixels(&self) -> u64 {
        self.histogram.iter().sum()
    }

    /// Number of pixels that differ.
    pub fn differing(&self) -> u64 {
        self.histogram.iter().skip(1).sum()
    }

    /// The largest magnitude; 0 for equal pictures.
    pub fn max(&self) -> usize {
        self.histogram.iter().rposition(|&count| count > 0).unwrap_or(0)
    }

    /// The magnitudes above 0 that occur, each with its number of pixels.
    pub fn histogram(&self) -> impl Iterator<Item = (usize, u64)> {
        self.histogram.iter().copied().enumerate().skip(1).filter(|&(_, count)| count > 0)
    }

    /// Whether the budgets cover the difference. Budgets `5:1000` and `40:1` allow at most 1000
    /// pixels off by 1 to 5, at most one off by 6 to 40, and none worse. No budget: equal only.
    pub fn is_within(&self, budgets: &[Budget]) -> bool {
        let mut sorted = budgets.to_vec();
        sorted.sort_by_key(|budget| budget.magnitude);
        let mut from = 1;
        for budget in sorted {
            let next = usize::from(budget.magnitude) + 1;
            if self.count(from..next.max(from)) > budget.count.of(self.pixels()) {
                return false;
            }
            from = next;
        }
        self.count(from..256) == 0
    }

    fn count(&self, magnitudes: std::ops::Range<usize>) -> u64 {
        self.histogram.get(magnitudes).map_or(0, |counts| counts.iter().sum())
    }
}

/// How many pixels may differ by at most a magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// The largest magnitude that counts here, 1..=255.
    pub magnitude: u8,
    /// The pixels allowed.
    pub count: Allowed,
}

/// A number of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// So many.
    Pixels(u64),
    /// So many of a hundred that are compared, rounded down; 0..=100.
    Percent(f64),
}

impl Allowed {
    /// How many of `pixels` these are.
    fn of(self, pixels: u64) -> u64 {
        match self {
            Self::Pixels(count) => count,
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "from 0 to the number of pixels"
            )]
            Self::Percent(percent) => (pixels as f64 * percent / 100.0) as u64,
        }
    }
}

impl FromStr for Budget {
    type Err = String;

    /// Reads `MAGNITUDE:COUNT` such as `2:100` or `2:0.5%`, or a percentage alone for any magnitude.
    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || {
            format!(
                "`{text}` is neither MAGNITUDE:COUNT such as 2:100 or 2:0.5%, with a magnitude of 1 to 255, nor a \
                 percentage such as 0.1%"
            )
        };
        let (magnitude, count) = text.split_once(':').unwrap_or(("255", text));
        let magnitude = magnitude.parse().ok().filter(|&m| m > 0).ok_or_else(wanted)?;
        let count = match count.strip_suffix('%') {
            Some(percent) => {
                let percent = percent.parse().ok().filter(|percent| (0.0..=100.0).contains(percent));
                Allowed::Percent(percent.ok_or_else(wanted)?)
            }
            None if text.contains(':') => Allowed::Pixels(count.parse().map_err(|_| wanted())?),
            None => return Err(wanted()),
        };
        Ok(Self { magnitude, count })
    }
}

/// The difference as a picture: black where the pictures agree, else grey from 64 (off by one)
/// to 255; all white when the sizes differ.
pub fn difference_picture(expected: &Pixels, actual: &Pixels) -> Pixels {
    let [width, height] = common_size(expected, actual);
    if !same_size(expected, actual) {
        let count = width as usize * height as usize;
        return Pixels { width, height, rgba: vec![[255; 4]; count] };
    }
    let rgba = expected.rgba.iter().zip(&actual.rgba).map(|(e, a)| shade(magnitude(e, a))).collect();
    Pixels { width, height, rgba }
}

/// Expected, difference and actual side by side, with grey gaps.
pub fn triptych(expected: &Pixels, actual: &Pixels) -> Pixels {
    const GAP: u32 = 4;
    const GREY: [u8; 4] = [128, 128, 128, 255];
    let middle = difference_picture(expected, actual);
    let width = expected.width + GAP + middle.width + GAP + actual.width;
    let mut sheet =
        Pixels { width, height: middle.height, rgba: vec![GREY; width as usize * middle.height as usize] };
    place(&mut sheet, expected, 0);
    place(&mut sheet, &middle, expected.width + GAP);
    place(&mut sheet, actual, expected.width + GAP + middle.width + GAP);
    sheet
}

/// Copies `picture` into `sheet` with its top left corner at column `left` of the top row.
fn place(sheet: &mut Pixels, picture: &Pixels, left: u32) {
    let rows = sheet.rgba.chunks_exact_mut(sheet.width as usize);
    for (to, from) in rows.zip(picture.rgba.chunks_exact(picture.width as usize)) {
        to[left as usize..][..from.len()].copy_from_slice(from);
    }
}

fn same_size(a: &Pixels, b: &Pixels) -> bool {
    (a.width, a.height) == (b.width, b.height)
}

fn common_size(a: &Pixels, b: &Pixels) -> [u32; 2] {
    [a.width.max(b.width), a.height.max(b.height)]
}

fn channel_differences(a: &[u8; 4], b: &[u8; 4]) -> [u8; 4] {
    std::array::from_fn(|channel| a[channel].abs_diff(b[channel]))
}

fn magnitude(a: &[u8; 4], b: &[u8; 4]) -> u8 {
    channel_differences(a, b).into_iter().max().unwrap_or(0)
}

fn shade(magnitude: u8) -> [u8; 4] {
    let grey = match magnitude {
        0 => 0,
        // 64 + 191 (m - 1) / 254, which is 255 at most.
        m => 64 + u8::try_from((u32::from(m) - 1) * 191 / 254).unwrap_or(191),
    };
    [grey, grey, grey, 255]
}
