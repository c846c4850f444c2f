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
        let mut histogram = vec![0; 256];
        if !same_size(expected, actual) {
            let [width, height] = common_size(expected, actual);
            histogram[255] = u64::from(width) * u64::from(height);
            return Self { histogram, rmse: 255.0 };
        }
        let mut squares = 0_u64;
        for (e, a) in expected.rgba.iter().zip(&actual.rgba) {
            histogram[usize::from(magnitude(e, a))] += 1;
            squares += channel_differences(e, a).map(|d| u64::from(d) * u64::from(d)).iter().sum::<u64>();
        }
        let opaque = expected.rgba.iter().chain(&actual.rgba).all(|pixel| pixel[3] == 255);
        let channels = if opaque { 3 } else { 4 };
        #[expect(clippy::cast_precision_loss, reason = "a sum over at most 2^28 pixels fits in 53 bits")]
        let mean = squares as f64 / (channels * expected.rgba.len()).max(1) as f64;
        Self { histogram, rmse: mean.sqrt() }
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
            if self.count(from..next.max(from)) > budget.count {
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The largest magnitude that counts here, 1..=255.
    pub magnitude: u8,
    /// The number of pixels allowed.
    pub count: u64,
}

impl FromStr for Budget {
    type Err = String;

    /// Reads `MAGNITUDE:COUNT`, such as `2:100`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wanted =
            || format!("`{text}` is not MAGNITUDE:COUNT such as 2:100, with a magnitude of 1 to 255");
        let (magnitude, count) = text.split_once(':').ok_or_else(wanted)?;
        let magnitude = magnitude.parse().ok().filter(|&m| m > 0).ok_or_else(wanted)?;
        Ok(Self { magnitude, count: count.parse().map_err(|_| wanted())? })
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
