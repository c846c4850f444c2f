//! Lattice noise from one integer hash, and a row of random numbers.

use drape::math::splitmix64;

/// Cells along an axis after which a pattern repeats that seems not to.
const NEVER: i64 = 1 << 30;

/// The whole part and the rest of a number.
#[expect(clippy::cast_possible_truncation, reason = "places stay far below 2^53")]
fn split(x: f64) -> (i64, f64) {
    let whole = x.floor();
    (whole as i64, x - whole)
}

/// A number in 0..1 from the upper bits of a hash.
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / 9_007_199_254_740_992.0
}

/// A pattern of noise in the plane, chosen by `seed`.
#[derive(Clone, Copy)]
pub(super) struct Noise {
    seed: u64,
    period: [i64; 2],
}

impl Noise {
    /// Noise that does not repeat.
    pub(super) const fn new(seed: u64) -> Self {
        Self::periodic(seed, NEVER, NEVER)
    }

    /// Noise that repeats after `columns` and `rows` lattice cells.
    pub(super) const fn periodic(seed: u64, columns: i64, rows: i64) -> Self {
        Self { seed, period: [columns, rows] }
    }

    /// The hash of lattice point (x, y).
    fn bits(self, x: i64, y: i64) -> u64 {
        let wrap = |place: i64, cells: i64| {
            let place = if (0..cells).contains(&place) { place } else { place.rem_euclid(cells) };
            place.unsigned_abs()
        };
        let [x, y] = [wrap(x, self.period[0]), wrap(y, self.period[1])];
        splitmix64(self.seed.wrapping_mul(0xD6E8_FEB8_6659_FD93) ^ (x << 32 | y))
    }

    /// A number in 0..1 for the lattice cell that holds (x, y).
    pub(super) fn cell(self, x: f64, y: f64) -> f64 {
        unit(self.bits(split(x).0, split(y).0))
    }

    /// Gradient noise (Perlin 2002): about -1..1, 0 at lattice points, smooth between.
    pub(super) fn at(self, x: f64, y: f64) -> f64 {
        let ((ix, fx), (iy, fy)) = (split(x), split(y));
        let slope = |dx: i64, dy: i64| {
            let bits = self.bits(ix + dx, iy + dy);
            let [gx, gy] = [unit(bits) * 2.0 - 1.0, unit(bits << 32) * 2.0 - 1.0];
            gx * (fx - dx as f64) + gy * (fy - dy as f64)
        };
        let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
        let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let (sx, sy) = (fade(fx), fade(fy));
        1.6 * lerp(lerp(slope(0, 0), slope(1, 0), sx), lerp(slope(0, 1), slope(1, 1), sx), sy)
    }

    /// The next octave: twice as fine, of another seed.
    fn finer(self) -> Self {
        let period = self.period.map(|cells| (cells * 2).min(NEVER));
        Self { seed: splitmix64(self.seed), period }
    }

    /// `octaves` patterns, each twice as fine and half as strong as the one before.
    pub(super) fn fractal(self, x: f64, y: f64, octaves: u32) -> f64 {
        let (mut noise, mut sum, mut weight, mut scale) = (self, 0.0, 1.0, 1.0);
        for _ in 0..octaves {
            sum += weight * noise.at(x * scale, y * scale);
            (noise, weight, scale) = (noise.finer(), weight * 0.5, scale * 2.0);
        }
        sum
    }
}

/// Random numbers one after the other.
pub(super) struct Random(u64);

impl Random {
    /// The row of numbers that belongs to `seed`.
    pub(super) const fn new(seed: u64) -> Self {
        Self(seed << 32)
    }

    /// The next number in `low`..`high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 += 1;
        low + (high - low) * unit(splitmix64(self.0))
    }
}
