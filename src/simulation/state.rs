//! The state of a cloth, and the phases of a step that change it.

use super::phase::Phase;
use crate::cloth::forces::Forces;
use crate::cloth::grid::{self, Grid, Pins};
use crate::cloth::springs::Springs;
use crate::cloth::stretch_limit::StretchLimit;
use crate::cloth::{Counters, Model, Params, Points};
use crate::collision::Colliders;
use crate::collision::coulomb::{self, Coulomb};
use crate::collision::self_collision::SelfCollision;
use crate::diagnostics::energy::Energy;
use crate::diagnostics::energy_bound::{Allowance, EnergyBound};
use crate::error::{Error, Kind, Result};
use crate::integrator::{self, Integrator};
use crate::scene::{ColliderKind, Contact, Scene, Start, Vec3};

/// The state of a cloth and what its step needs; phases that the scene does without are absent.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) params: Params,
    pub(super) grid: Grid,
    pub(super) pins: Pins,
    pub(super) springs: Springs,
    pub(super) x: Points,
    pub(super) last: Points,
    pub(super) integrator: Box<dyn Integrator>,
    pub(super) self_collision: Option<SelfCollision>,
    pub(super) colliders: Colliders,
    stretch_limit: Option<StretchLimit>,
    /// Contact under `sim.contact` = `coulomb`.
    pub(super) coulomb: Option<Coulomb>,
    /// What the phases of this step did so far.
    pub(super) work: Counters,
    pub(super) allowance: Allowance,
    pub(super) energy_bound: EnergyBound,
    /// Positions, last positions and what the integrator remembers, where the frame began.
    pub(super) frame_start: Vec<Points>,
}

impl State {
    /// The cloth of `scene`, if there is one, at its start or at `start`.
    pub(super) fn new(scene: &Scene, start: Option<&Points>) -> Result<Option<Self>> {
        let Some(cloth) = &scene.cloth else { return Ok(None) };
        let sim = &scene.sim;
        let grid = Grid::new(cloth)?;
        let mut x = grid::start(cloth, grid)?;
        if let Some(start) = start {
            check_size(start, x.len())?;
            x.copy_from(start);
        }
        let params = Params::new(cloth, sim);
        let pins = Pins::new(cloth, grid)?;
        let colliders = Colliders::new(scene, &x)?;
        let mut last = Points::zeros(grid.len())?;
        put_before(&mut last, &x, &pins, cloth.velocity * params.dt);
        let coulomb = (sim.contact == Contact::Coulomb).then(|| Coulomb::new(grid.len())).transpose()?;
        if coulomb.is_some() {
            coulomb::start_outside(&mut x, &mut last, &pins, &colliders);
        }
        let springs = Springs::new(cloth, grid, &x)?;
        let limit = |limit| StretchLimit::new(limit, sim.stretch_passes, &springs);
        let integrator = integrator::create(cloth, sim, &springs)?;
        let mut state = Self {
            params,
            grid,
            pins,
            last,
            self_collision: SelfCollision::new(scene.needed_self_collision(), cloth, sim, grid, &x)?,
            coulomb,
            stretch_limit: scene.needed_stretch_limit().map(limit).transpose()?,
            work: Counters::default(),
            energy_bound: EnergyBound::default(),
            frame_start: vec![Points::zeros(grid.len())?; 2 + integrator.memory().len()],
            allowance: Allowance::new(scene, cloth, &springs, &params),
            colliders,
            integrator,
            springs,
            x,
        };
        if sim.start == Start::HalfStep {
            state.start_half_step()?;
        }
        state.set_energy_bound();
        Ok(Some(state))
    }

    /// Puts the last positions where the points would have been one step ago under the forces at the start:
    /// `last = x - v dt + f dt² / (2 m)`.
    fn start_half_step(&mut self) -> Result<()> {
        let Self { params, pins, springs, x, last, .. } = self;
        let mut forces = Forces::new(springs)?;
        forces.compute(x, springs, params.weight.into(), &mut Counters::default());
        let half = 0.5 * params.dt * params.dt / params.mass;
        for p in pins.free.iter().cloned().flatten() {
            last.set(p, last.get(p) + forces.sum().get(p) * half);
        }
        Ok(())
    }

    /// Takes the state as the start that the energy is held against.
    pub(super) fn set_energy_bound(&mut self) {
        self.energy_bound = self.allowance.energy_bound(&self.x, self.energy(), &self.params);
    }

    /// The energies.
    pub(super) fn energy(&self) -> Energy {
        Energy::new(&self.x, &self.last, &self.springs, &self.params)
    }

    /// Whether a step has the phase.
    pub(super) fn has(&self, phase: Phase) -> bool {
        match phase {
            Phase::Forces => self.integrator.has_force_phase(),
            Phase::Integration => true,
            Phase::SelfCollision => self.self_collision.is_some(),
            Phase::Collision(_) => self.colliders.resolve_hits(),
            Phase::StretchLimit => self.stretch_limit.is_some(),
            Phase::Depenetration(_) => self.colliders.keep_outside(),
            Phase::Contact => self.coulomb.is_some(),
        }
    }

    pub(super) fn compute_forces(&mut self) {
        let Self { springs, pins, params, x, integrator, work, .. } = self;
        integrator.compute_forces(x, Model { springs, pins, params }, work);
    }

    pub(super) fn compute_forces_and_integrate(&mut self) {
        let Self { springs, pins, params, x, last, integrator, work, .. } = self;
        integrator.step(x, last, Model { springs, pins, params }, work);
    }

    pub(super) fn integrate(&mut self) {
        let Self { springs, pins, params, x, last, integrator, work, .. } = self;
        integrator.advance(x, last, Model { springs, pins, params }, work);
    }

    pub(super) fn collide_with_itself(&mut self) {
        if let Some(self_collision) = &mut self.self_collision {
            self_collision.apply(&mut self.x, &mut self.last, &self.pins, &mut self.work);
        }
    }

    pub(super) fn collide(&mut self, kind: ColliderKind) {
        let Self { colliders, x, last, pins, work, .. } = self;
        colliders.resolve(kind, x, last, pins, work);
    }

    pub(super) fn limit_stretch(&mut self) {
        if let Some(limit) = &mut self.stretch_limit {
            limit.apply(&mut self.x, &self.springs, &self.pins, &mut self.work);
        }
    }

    pub(super) fn depenetrate(&mut self, kind: ColliderKind) {
        self.colliders.depenetrate(kind, &mut self.x, &self.pins, &mut self.work);
    }

    /// Under `coulomb`: contact of the cloth with itself and with the objects.
    pub(super) fn touch(&mut self) {
        let Self { coulomb, params, pins, x, last, integrator, self_collision, colliders, work, .. } = self;
        let Some(contact) = coulomb else { return };
        contact.begin();
        let velocity = |p, x, last| integrator.displacement(p, x, last, params.dt);
        if let Some(pairs) = self_collision.as_ref().and_then(SelfCollision::pairs) {
            pairs.end_approach(contact, x, last, pins, velocity);
        }
        contact.meet(colliders, x, last, pins, velocity, work);
        for p in (0..x.len()).filter(|&p| contact.touched[p]) {
            last.set(p, x.get(p) - contact.velocity.get(p));
            integrator.forget(p);
        }
    }
}

/// Puts `last` where points at `x` were that move by `moved` in a step, unless they are pinned.
fn put_before(last: &mut Points, x: &Points, pins: &Pins, moved: Vec3) {
    last.copy_from(x);
    for p in pins.free.iter().cloned().flatten() {
        last.set(p, x.get(p) - moved);
    }
}

/// Checks that `x` has `points` positions.
pub(super) fn check_size(x: &Points, points: usize) -> Result<()> {
    if [&x.x, &x.y, &x.z].iter().all(|component| component.len() == points) {
        return Ok(());
    }
    Err(Error::new(Kind::Scene, format!("the state is not one of {points} points")))
}
