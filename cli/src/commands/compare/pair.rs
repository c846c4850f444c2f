//! How one pair of pictures, or of animations, differs.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use super::mask::Mask;
use super::verdict::shown;
use crate::animation::reel::{Reel, Shown};
use drape::error::{Error, Kind, Result};
use drape::output::compare::{Budget, Difference};
use drape::output::png::Pixels;

/// What may differ, and where it is looked for.
pub(super) struct Rules<'a> {
    pub(super) budgets: &'a [Budget],
    pub(super) mask: Option<&'a Mask>,
}

/// How one pair differs. Of animations the counts are over all pictures that both have.
#[derive(Serialize)]
pub(super) struct Comparison {
    pub(super) a: String,
    pub(super) b: String,
    pub(super) size_a: [u32; 2],
    pub(super) size_b: [u32; 2],
    pub(super) pixels: u64,
    pub(super) differing: u64,
    pub(super) max: usize,
    pub(super) rmse: f64,
    /// Pixels per magnitude, for the magnitudes above 0 that occur.
    pub(super) histogram: BTreeMap<usize, u64>,
    pub(super) within_budget: bool,
    /// Of animations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) animation: Option<Animation>,
}

/// What a still picture has not.
#[derive(Serialize)]
pub(super) struct Animation {
    pub(super) pictures_a: usize,
    pub(super) pictures_b: usize,
    /// Pictures that differ, of those that both have.
    pub(super) differing_pictures: usize,
    /// The first of them, counted from 0.
    pub(super) first: Option<usize>,
    /// Pictures that are not shown equally long.
    pub(super) delays: usize,
    /// Whether they are shown a different number of times.
    pub(super) plays: bool,
}

impl Animation {
    /// Whether anything but pixels differs.
    fn differs(&self) -> bool {
        self.pictures_a != self.pictures_b || self.delays > 0 || self.plays
    }

    fn line(&self) -> String {
        let Self { pictures_a, pictures_b, differing_pictures, first, delays, plays } = self;
        let mut text = if pictures_a == pictures_b {
            format!("{pictures_a} pictures")
        } else {
            format!("{pictures_a} against {pictures_b} pictures")
        };
        if let Some(first) = first {
            text += &format!(", {differing_pictures} differ, the first is number {first} (from 0)");
        }
        if *delays > 0 {
            text += &format!(", {delays} are shown for another time");
        }
        if *plays {
            text += ", repeated a different number of times";
        }
        text
    }
}

/// Compares two files, picture by picture; also returns the first pair that differs, or else the first of all.
pub(super) fn compare(a: &Path, b: &Path, rules: &Rules<'_>) -> Result<(Comparison, [Pixels; 2])> {
    let [mut reel_a, mut reel_b] = [Reel::open(a)?, Reel::open(b)?];
    let moves = reel_a.moves() || reel_b.moves();
    let plays = reel_a.moves() && reel_b.moves() && reel_a.plays != reel_b.plays;
    let mut found = Found::default();
    let mut counts = [0, 0];
    loop {
        let pair = [reel_a.next()?, reel_b.next()?];
        for (count, shown) in counts.iter_mut().zip(&pair) {
            *count += usize::from(shown.is_some());
        }
        match pair {
            [Some(a), Some(b)] => found.add(a, b, rules)?,
            [None, None] => break,
            _ => {}
        }
    }
    if let Some((path, _)) = [a, b].iter().zip(counts).find(|(_, count)| *count == 0) {
        return Err(Error::new(Kind::Io, format!("cannot read `{}`: it has no picture", path.display())));
    }
    let differing_pictures = found.differences.iter().filter(|difference| difference.differing() > 0).count();
    let first = found.differences.iter().position(|difference| difference.differing() > 0);
    // How long a single picture is shown has no meaning.
    let delays = if counts == [1, 1] { 0 } else { found.delays };
    let [pictures_a, pictures_b] = counts;
    let animation = Animation { pictures_a, pictures_b, differing_pictures, first, delays, plays };
    let within = found.differences.iter().all(|difference| difference.is_within(rules.budgets));
    let all = Difference::joined(&found.differences);
    let empty = || Pixels { width: 0, height: 0, rgba: Vec::new() };
    let pictures = found.kept.unwrap_or_else(|| [empty(), empty()]);
    let [size_a, size_b] = [0, 1].map(|i: usize| [pictures[i].width, pictures[i].height]);
    let comparison = Comparison {
        a: shown(a),
        b: shown(b),
        size_a,
        size_b,
        pixels: all.pixels(),
        differing: all.differing(),
        max: all.max(),
        rmse: all.rmse,
        histogram: all.histogram().collect(),
        within_budget: within && !animation.differs(),
        animation: moves.then_some(animation),
    };
    Ok((comparison, pictures))
}

/// What was found in the pictures so far.
#[derive(Default)]
struct Found {
    differences: Vec<Difference>,
    delays: usize,
    kept: Option<[Pixels; 2]>,
}

impl Found {
    fn add(&mut self, a: Shown, b: Shown, rules: &Rules<'_>) -> Result<()> {
        self.delays += usize::from(a.delay != b.delay);
        let pictures = [a.pixels, b.pixels];
        let difference = match rules.mask {
            None => Difference::between(&pictures[0], &pictures[1]),
            Some(mask) => mask.difference(&pictures)?,
        };
        let is_first = difference.differing() > 0 && self.differences.iter().all(|d| d.differing() == 0);
        if self.kept.is_none() || is_first {
            self.kept = Some(pictures);
        }
        self.differences.push(difference);
        Ok(())
    }
}

impl Comparison {
    /// The comparison in one line.
    pub(super) fn line(&self) -> String {
        let moving =
            self.animation.as_ref().map_or(String::new(), |animation| format!("{}: ", animation.line()));
        if self.size_a != self.size_b {
            let ([aw, ah], [bw, bh]) = (self.size_a, self.size_b);
            return format!("{moving}{aw} x {ah} against {bw} x {bh} pixels");
        }
        let within = if self.differing > 0 && self.within_budget { ", within the budget" } else { "" };
        let Self { differing, pixels, max, rmse, .. } = self;
        format!("{moving}{differing} of {pixels} pixels, max {max}, rmse {rmse:.6}{within}")
    }

    /// The comparison as lines.
    pub(super) fn block(&self) -> String {
        let ([aw, ah], [bw, bh]) = (self.size_a, self.size_b);
        let size = if self.size_a == self.size_b {
            format!("{aw} x {ah}")
        } else {
            format!("{aw} x {ah} against {bw} x {bh}")
        };
        let counts: Vec<_> =
            self.histogram.iter().map(|(magnitude, count)| format!("{magnitude}:{count}")).collect();
        let moving = self
            .animation
            .as_ref()
            .map_or(String::new(), |animation| format!("animation  {}\n", animation.line()));
        format!(
            "size       {size}\n{moving}differing  {} of {} pixels\nmax        {}\nrmse       {}\nhistogram  {}\n",
            self.differing,
            self.pixels,
            self.max,
            self.rmse,
            if counts.is_empty() { "-".to_owned() } else { counts.join(" ") },
        )
    }
}
