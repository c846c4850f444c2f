//! The springs of a row of the grid, some columns at once, and the sums over them.
//!
//! While the CPU divides for the springs of one family, it has time for a sum, so each loop over the columns does
//! both. All its slices are equally long, which leaves it without bounds checks.

use fearless_simd::f64x4;
use fearless_simd::prelude::*;

use super::filled;
use crate::error::Result;

/// Columns that are computed at once.
pub(super) const LANES: usize = 4;

/// The numbers of such columns.
pub(super) type Chunk = [f64; LANES];

/// Entries of a buffer before and after the columns of a row.
pub(super) const PAD: usize = LANES;

/// Buffers of some rows of columns, with [`PAD`] more entries on either side of each.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    stride: usize,
    entries: Vec<f64>,
}

impl Rows {
    /// Zeros for `count` rows of `width` columns.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(super) fn new(count: usize, width: usize) -> Result<Self> {
        let stride = width.next_multiple_of(LANES) + 2 * PAD;
        Ok(Self { stride, entries: filled(count * stride, 0.0)? })
    }

    /// The chunks of row `index`, from so many columns to the right of column 0 on.
    #[inline(always)]
    pub(super) fn chunks(&self, index: usize, right: isize) -> &[Chunk] {
        let start = (index * self.stride + PAD).wrapping_add_signed(right);
        self.entries[start..][..self.stride - 2 * PAD].as_chunks().0
    }

    /// The columns of row `index`.
    #[inline(always)]
    pub(super) fn columns(&self, index: usize, width: usize) -> &[f64] {
        &self.entries[index * self.stride + PAD..][..width]
    }

    /// The chunks of row `index`, to be changed.
    #[inline(always)]
    pub(super) fn chunks_mut(&mut self, index: usize) -> &mut [Chunk] {
        self.entries[index * self.stride..][PAD..self.stride - PAD].as_chunks_mut().0
    }

    /// The chunks of row `index` and the two after it, to be changed.
    #[inline(always)]
    pub(super) fn three_mut(&mut self, index: usize) -> [&mut [Chunk]; 3] {
        let Self { stride, entries } = self;
        let (x, rest) = entries[index * *stride..].split_at_mut(*stride);
        let (y, z) = rest.split_at_mut(*stride);
        let columns = PAD..*stride - PAD;
        [
            x[columns.clone()].as_chunks_mut().0,
            y[columns.clone()].as_chunks_mut().0,
            z[columns].as_chunks_mut().0,
        ]
    }

    /// Takes `values` as the columns of row `index`, and its first and last one beside them.
    #[inline(always)]
    pub(super) fn set(&mut self, index: usize, values: &[f64]) {
        let (before, row) = self.entries[index * self.stride..][..self.stride].split_at_mut(PAD);
        let (row, after) = row.split_at_mut(values.len());
        before.fill(values[0]);
        row.copy_from_slice(values);
        after.fill(values[values.len() - 1]);
    }
}

/// The springs of one family that a row owns.
pub(super) struct Owned<'a> {
    /// Stiffness, in N/m.
    pub(super) k: f64,
    /// Rest lengths, in metres.
    pub(super) rest: &'a [Chunk],
    /// Up to which length they do not pull, in metres.
    pub(super) slack: &'a [Chunk],
    /// The owners, by component, in metres.
    pub(super) a: [&'a [Chunk]; 3],
    /// The other ends, by component, in metres.
    pub(super) b: [&'a [Chunk]; 3],
    /// What they pull their owners with, by component, in N.
    pub(super) out: [&'a mut [Chunk]; 3],
}

impl Owned<'_> {
    /// Computes `e · (k · (l - l0) / l)`, and does `sum` with each of the `n` chunks.
    #[inline(always)]
    pub(super) fn pull_and<S: Simd>(self, simd: S, n: usize, mut sum: impl FnMut(usize)) {
        let Self { k, rest, slack, a: [ax, ay, az], b: [bx, by, bz], out: [x, y, z] } = self;
        let (rest, slack) = (&rest[..n], &slack[..n]);
        let (ax, ay, az) = (&ax[..n], &ay[..n], &az[..n]);
        let (bx, by, bz) = (&bx[..n], &by[..n], &bz[..n]);
        let (x, y, z) = (&mut x[..n], &mut y[..n], &mut z[..n]);
        let (k, zero) = (f64x4::splat(simd, k), f64x4::splat(simd, 0.0));
        for i in 0..n {
            let (ex, ey, ez) = (
                load(simd, bx, i) - load(simd, ax, i),
                load(simd, by, i) - load(simd, ay, i),
                load(simd, bz, i) - load(simd, az, i),
            );
            let l = (ex * ex + ey * ey + ez * ez).sqrt();
            let scale = k * (l - load(simd, rest, i)) / l;
            let scale = l.simd_le(load(simd, slack, i)).select(zero, scale);
            (x[i], y[i], z[i]) = ((ex * scale).into(), (ey * scale).into(), (ez * scale).into());
            sum(i);
        }
    }
}

/// Starts one component of the sums on a row with `constant` and all the pulls of springs that the row owns, which
/// are in rows `c`, `c + 3`, … of `pulls`, by family.
#[inline(always)]
pub(super) fn own_sum<S: Simd>(
    simd: S,
    n: usize,
    pulls: &Rows,
    c: usize,
    constant: f64,
    sum: &mut [Chunk],
) -> impl FnMut(usize) {
    let of = |slot: usize, right: isize| &pulls.chunks(c + 3 * slot, right)[..n];
    let (left, above, upper_left, upper_right) = (of(0, 0), of(1, 0), of(2, 0), of(3, 0));
    let (left2, above2, right, right2) = (of(4, 0), of(5, 0), of(0, 1), of(4, 2));
    let sum = &mut sum[..n];
    let constant = f64x4::splat(simd, constant);
    #[inline(always)]
    move |i| {
        let own = constant + load(simd, left, i) + load(simd, above, i) + load(simd, upper_left, i);
        let own = own + load(simd, upper_right, i) + load(simd, left2, i) + load(simd, above2, i);
        sum[i] = (own - load(simd, right, i) - load(simd, right2, i)).into();
    }
}

/// Continues the sums on the row above the one that owns the springs of `pulls`, and ends those on the second row above.
#[inline(always)]
pub(super) fn sums_above<S: Simd>(
    simd: S,
    n: usize,
    pulls: &Rows,
    c: usize,
    above: &mut [Chunk],
    above2: &mut [Chunk],
) -> impl FnMut(usize) {
    let of = |slot: usize, right: isize| &pulls.chunks(c + 3 * slot, right)[..n];
    let (left, middle, right, middle2) = (of(3, -1), of(1, 0), of(2, 1), of(5, 0));
    let (above, above2) = (&mut above[..n], &mut above2[..n]);
    #[inline(always)]
    move |i| {
        let sum = load(simd, above, i) - load(simd, left, i) - load(simd, middle, i);
        above[i] = (sum - load(simd, right, i)).into();
        above2[i] = (load(simd, above2, i) - load(simd, middle2, i)).into();
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, row: &[Chunk], i: usize) -> f64x4<S> {
    f64x4::simd_from(simd, row[i])
}
