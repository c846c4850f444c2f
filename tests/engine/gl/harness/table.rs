//! Tallies as lines of a table, and their sum.

use std::fmt;
use std::ops::AddAssign;

use super::tally::Tally;

impl AddAssign<&Tally> for Tally {
    fn add_assign(&mut self, other: &Tally) {
        self.covered += other.covered;
        self.same += other.same;
        self.ties += other.ties;
        self.near_ties += other.near_ties;
        self.cut_edges += other.cut_edges;
        self.line_ties += other.line_ties;
        self.lines += other.lines;
        self.wrong += other.wrong;
        self.jumps += other.jumps;
        self.depth_error = self.depth_error.max(other.depth_error);
        self.levels.iter_mut().zip(other.levels).for_each(|(sum, n)| *sum += n);
        self.rounded.iter_mut().zip(other.rounded).for_each(|(sum, n)| *sum += n);
    }
}

impl Tally {
    /// What stands in the columns of a tally that is displayed.
    pub(crate) const HEADER: &'static str = "covered    same   ties  near  cut l.ties l.off wrong | levels:0        1    >1 jumps | rounded driver | depth | case";
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            covered,
            same,
            ties,
            near_ties,
            cut_edges,
            line_ties,
            lines,
            wrong,
            jumps,
            depth_error,
            ..
        } = self;
        let [zero, one, more] = self.levels;
        let [own, driver] = self.rounded;
        write!(
            f,
            "{covered:7} {same:7} {ties:6} {near_ties:5} {cut_edges:4} {line_ties:6} {lines:5} {wrong:5} | "
        )?;
        write!(f, "{zero:8} {one:8} {more:5} {jumps:5} | {own:7} {driver:6} | {depth_error:5.2} |")
    }
}
