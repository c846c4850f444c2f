//! The simulation up to a frame, with progress and a way to stop it.

use std::time::{Duration, Instant};

use crate::session::Session;
use crate::session::progress::Progress;
use drape::cloth::Counters;
use drape::diagnostics::rest::{Motion, RestWatch};
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;

/// Until when a cloth is moved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Until {
    /// The last frame.
    pub(crate) frames: u64,
    /// Whether the frame at which the cloth is at rest is the last one, and must come in time.
    pub(crate) rest: bool,
}

/// What came of moving a cloth.
pub(crate) struct Moved {
    /// The wall time that it took.
    pub(crate) elapsed: Duration,
    /// The error, of [`Kind::Difference`], of a cloth that should be at rest and is not: it was checked,
    /// though nothing failed, so it ends a command whose results are there.
    pub(crate) restless: Option<Error>,
}

impl Moved {
    /// The end of a command whose results are written.
    pub(crate) fn result(self) -> Result<()> {
        self.restless.map_or(Ok(()), Err)
    }
}

/// Moves the cloth of `scene` on to the last frame; `each` sees the start and every frame. A scene
/// without a cloth is always at rest.
///
/// # Errors
/// Those of the simulation and of `each`, and [`Kind::Signal`] between two frames.
pub(crate) fn advance_until(
    simulation: &mut Simulation,
    scene: &Scene,
    until: Until,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<()>,
) -> Result<Moved> {
    let Some(cloth) = scene.cloth.as_ref().filter(|_| until.rest) else {
        let last = if until.rest { 0 } else { until.frames };
        let elapsed = advance_while(simulation, last, session, |simulation| each(simulation).map(|()| true))?;
        return Ok(Moved { elapsed, restless: None });
    };
    let mut watch = RestWatch::new(cloth, &scene.sim, simulation.positions())?;
    let mut motion = None;
    let elapsed = advance_while(simulation, until.frames, session, |simulation| {
        each(simulation)?;
        if simulation.frame() > 0 {
            motion = Some(watch.look(simulation.positions()));
        }
        Ok(!motion.is_some_and(|motion| watch.is_rest(motion)))
    })?;
    let restless = match motion {
        Some(motion) if watch.is_rest(motion) => None,
        _ => Some(no_rest(simulation, motion, watch.limit())),
    };
    Ok(Moved { elapsed, restless })
}

/// Warns of steps that an implicit integrator did not solve.
pub(crate) fn warn_of_unsolved(simulation: &Simulation, session: &Session) {
    let Counters { steps, unsolved_steps, .. } = simulation.counters();
    if unsolved_steps > 0 {
        session.ui.note(&format!(
            "warning: {unsolved_steps} of {steps} steps left more than sim.tolerance of the forces unbalanced\n  \
             = help: raise steps_per_frame, or sim.tolerance if so much is good enough"
        ));
    }
}

/// The error of a cloth that still moves at the end.
fn no_rest(simulation: &Simulation, motion: Option<Motion>, limit: Motion) -> Error {
    let does = motion.map_or_else(String::new, |motion| {
        format!(
            ": a point moves at {:.3e} m/s (at rest at most {:.3e}), the residual force is {:.3e} m/s² of its \
             mass (at most {:.3e})",
            motion.speed, limit.speed, motion.residual, limit.residual,
        )
    });
    let message = format!("not at rest after {} frames, {} s{does}", simulation.frame(), simulation.time());
    Error::new(Kind::Difference, message).with_help(
        "the results are those of this frame; more time (--time) or damping may help, but not where the step is \
         too long, nothing damps, or self-collision works against the stretch limit: see docs/restless.md",
    )
}

/// Moves `simulation` on to frame `frames` while `each`, which sees the start and every frame, says
/// so. Returns the wall time that took.
fn advance_while(
    simulation: &mut Simulation,
    frames: u64,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<bool>,
) -> Result<Duration> {
    let started = Instant::now();
    let mut progress = Progress::new(&session.ui, "simulating", frames);
    let mut goes_on = each(simulation)?;
    while goes_on && simulation.frame() < frames {
        session.signals.check()?;
        simulation.advance_frame()?;
        progress.set(simulation.frame());
        goes_on = each(simulation)?;
    }
    drop(progress);
    session.signals.check()?;
    warn_of_unsolved(simulation, session);
    let elapsed = started.elapsed();
    session.ui.remark(&format!("simulated {} frames in {:.3} s", simulation.frame(), elapsed.as_secs_f64()));
    Ok(elapsed)
}
