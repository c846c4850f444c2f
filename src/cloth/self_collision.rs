//! Phase 3: points of one box that are closer than twice the thickness are moved apart.
//!
//! The boxes do not influence one another: a point is moved by the members of its own box only.
//! So going box by box, and in index order within each, gives what index order over the whole
//! cloth gives; and a box in which no two points are close at its turn is left as it is.

use std::ops::{Add, Range};

use super::boxes::Boxes;
use super::grid::{Grid, Pins};
use super::one_box::{OneBox, ROOM, Rule};
use super::{Counters, Points, filled, pieces};
use crate::dispatch::{Work, dispatch};
use crate::error::Result;
use crate::scene::{Cloth, Sim};

/// Most boxes of a piece of a large cloth: about a thousand points.
const BOXES: usize = 128;

/// Self-collision of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct SelfCollision {
    rule: Rule,
    /// The points by box.
    pub(crate) boxes: Boxes,
    /// Places for the positions of the members of each box, and [`ROOM`] more for each.
    positions: Points,
    /// Of each box in which a member moved, the first of its places.
    moved: Vec<Option<usize>>,
}

impl SelfCollision {
    /// Self-collision of `cloth`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(cloth: &Cloth, sim: &Sim, grid: Grid, x: &Points) -> Result<Self> {
        let bx = 3.0 * cloth.width / grid.width as f64;
        let by = 3.0 * cloth.height / grid.height as f64;
        let most_boxes = x.len() / 2;
        let places = x.len() + ROOM * most_boxes;
        Ok(Self {
            rule: Rule::new(2.0 * cloth.thickness, f64::from(sim.steps_per_frame)),
            boxes: Boxes::new([bx, by, bx.max(by)], x)?,
            positions: Points::zeros(places)?,
            moved: filled(most_boxes, None)?,
        })
    }

    /// Moves apart the close points of every box; pinned points stay.
    pub(crate) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        self.boxes.update(x);
        let Self { rule, boxes, positions, moved } = self;
        let range = 0..boxes.count();
        let most = if x.len() < pieces::MANY { range.len() } else { BOXES };
        let given = Given { rule: *rule, boxes, x, pins };
        let whole = Piece { given, range, first_place: 0, positions: positions.components_mut(), moved };
        let Tally { pairs, moves } = whole.run_in_parts(most);
        counters.boxes_searched += boxes.count() as u64;
        counters.pairs_tested += pairs;
        counters.self_collision_moves += moves;
        self.write_back(x);
    }

    /// Takes over the positions of the boxes in which a member moved.
    fn write_back(&self, x: &mut Points) {
        for (index, moved) in self.moved[..self.boxes.count()].iter().enumerate() {
            let Some(place) = *moved else { continue };
            for (at, &p) in (place..).zip(self.boxes.members(index)) {
                x.set(p, self.positions.get(at));
            }
        }
    }
}

/// How many places the boxes before `index` may take.
fn place(boxes: &Boxes, index: usize) -> usize {
    boxes.start(index) + ROOM * index
}

/// What was done in some boxes.
#[derive(Clone, Copy, Default)]
struct Tally {
    pairs: u64,
    moves: u64,
}

impl Add for Tally {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { pairs: self.pairs + other.pairs, moves: self.moves + other.moves }
    }
}

/// What the work on each box reads.
#[derive(Clone, Copy)]
struct Given<'a> {
    rule: Rule,
    boxes: &'a Boxes,
    x: &'a Points,
    pins: &'a Pins,
}

/// Consecutive boxes and what the work on them changes.
struct Piece<'a> {
    given: Given<'a>,
    range: Range<usize>,
    first_place: usize,
    positions: [&'a mut [f64]; 3],
    moved: &'a mut [Option<usize>],
}

impl Piece<'_> {
    /// Works on all boxes, in parts of at most `most`.
    fn run_in_parts(self, most: usize) -> Tally {
        if self.range.len() <= most {
            let mut tally = Tally::default();
            dispatch(EachBox { piece: self, tally: &mut tally });
            return tally;
        }
        let [a, b] = self.halves();
        let (a, b) = rayon::join(|| a.run_in_parts(most), || b.run_in_parts(most));
        a + b
    }

    /// The first half of the boxes, and the second.
    fn halves(self) -> [Self; 2] {
        let Self { given, range: Range { start, end }, first_place, positions, moved } = self;
        let middle = start.midpoint(end);
        let place = place(given.boxes, middle);
        let [x, y, z] = positions.map(|component| component.split_at_mut(place - first_place));
        let moved = moved.split_at_mut(middle - start);
        let (a, b) = ([x.0, y.0, z.0], [x.1, y.1, z.1]);
        [
            Piece { given, range: start..middle, first_place, positions: a, moved: moved.0 },
            Piece { given, range: middle..end, first_place: place, positions: b, moved: moved.1 },
        ]
    }
}

/// The phase for the boxes of a piece.
struct EachBox<'a> {
    piece: Piece<'a>,
    tally: &'a mut Tally,
}

impl Work for EachBox<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { piece: Piece { given, range, first_place, mut positions, moved }, tally } = self;
        let mut next = 0;
        for (index, moved) in range.zip(moved) {
            let members = given.boxes.members(index);
            let places = next..next + members.len() + ROOM;
            let positions = positions.each_mut().map(|component| &mut component[places.clone()]);
            let mut one = OneBox::gather(members, given.rule, given.x, positions);
            let moves = if one.any_close() { one.move_apart(&given.pins.pinned) } else { 0 };
            *moved = (moves > 0).then_some(first_place + next);
            // A box that stays as it is leaves its places, which are at hand, to the next.
            next = if moves > 0 { places.end } else { next };
            tally.moves += moves;
            tally.pairs += (members.len() * (members.len() - 1) / 2) as u64;
        }
    }
}
