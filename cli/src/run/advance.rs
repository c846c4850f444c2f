//! A simulation is advanced to a frame or until it is at rest; signals stop it and progress is shown.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::session::Session;
use crate::session::progress::Progress;
use drape::cloth::Counters;
use drape::diagnostics::rest::{Motion, QUIET, RestWatch};
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape::simulation::snapshot::Seen;

/// Where a simulation ends.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Until {
    /// The last frame.
    pub(crate) frames: u64,
    /// Whether it ends as soon as the cloth is at rest, which must be by the last frame.
    pub(crate) rest: bool,
    /// Whether it is watched for rest although it does not end there.
    pub(crate) watched: bool,
    /// What was seen of the motion before.
    pub(crate) seen: Seen,
}

/// A simulation that has ended.
pub(crate) struct Ended {
    /// The wall time.
    pub(crate) elapsed: Duration,
    /// The figures of a cloth that is at rest, if it was watched.
    pub(crate) rest: Option<Rest>,
    /// The error, of [`Kind::Difference`], of a cloth that should be at rest and is not. The command still
    /// writes its results and returns this error last.
    pub(crate) unsettled: Option<Error>,
    /// What was seen of the motion; nothing if it was not watched.
    pub(crate) seen: Seen,
}

/// The figures of a cloth at rest.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Rest {
    /// For how long it was quiet, in seconds.
    quiet: f64,
    /// The most that it did in that time.
    motion: Motion,
    /// The most that a cloth at rest does.
    limit: Motion,
}

impl Rest {
    /// A line of the summary.
    pub(crate) fn text(&self) -> String {
        let Self { quiet, motion, limit } = self;
        format!(
            "rest         for {quiet} s no point was faster than {:.3e} m/s (limit {:.3e}) and no residual force per mass \
             larger than {:.3e} m/s² (limit {:.3e})\n",
            motion.speed, limit.speed, motion.residual, limit.residual
        )
    }
}

impl Ended {
    /// The result of a command that has written its results.
    pub(crate) fn result(self) -> Result<()> {
        self.unsettled.map_or(Ok(()), Err)
    }
}

/// Advances the simulation of `scene` to its end; `each` is called at the start and after every frame, with
/// what was seen of the motion. A scene without a cloth is always at rest.
///
/// # Errors
/// Those of the simulation and of `each`, and [`Kind::Signal`] between two frames.
pub(crate) fn advance_until(
    simulation: &mut Simulation,
    scene: &Scene,
    until: Until,
    session: &Session,
    mut each: impl FnMut(&Simulation, Seen) -> Result<()>,
) -> Result<Ended> {
    let Some(cloth) = scene.cloth.as_ref().filter(|_| until.rest || until.watched) else {
        let last = if until.rest { 0 } else { until.frames };
        // What was seen before does not hold for frames that nobody watches.
        let seen = Seen::default();
        let each = |simulation: &Simulation| each(simulation, seen).map(|()| true);
        let elapsed = advance_while(simulation, last, session, each)?;
        return Ok(Ended { elapsed, rest: None, unsettled: None, seen });
    };
    let first = simulation.frame();
    let now = simulation.positions();
    let mut watch = match first {
        0 => RestWatch::new(cloth, &scene.sim, now)?,
        _ => {
            let points = [simulation.positions_at_frame_start(), now];
            RestWatch::in_motion(cloth, &scene.sim, points, until.seen.quiet)?
        }
    };
    let (mut motion, mut seen, mut limited) = (None, until.seen, simulation.counters().springs_limited);
    let elapsed = advance_while(simulation, until.frames, session, |simulation| {
        if simulation.frame() > first {
            motion = Some(watch.look(simulation.positions()));
            let all = simulation.counters().springs_limited;
            seen = Seen { quiet: watch.quiet(), springs_limited: all - limited };
            limited = all;
        }
        each(simulation, seen)?;
        Ok(!(until.rest && watch.is_rest()))
    })?;
    let limit = watch.limit();
    let rest = watch.is_rest().then(|| Rest { quiet: QUIET, motion: watch.most(), limit });
    let unsettled = (until.rest && rest.is_none()).then(|| no_rest(simulation, motion, limit));
    Ok(Ended { elapsed, rest, unsettled, seen })
}

/// Warns of steps in which an implicit integrator did not reach its tolerance.
pub(crate) fn warn_of_unsolved(simulation: &Simulation, session: &Session) {
    let Counters { steps, unsolved_steps, .. } = simulation.counters();
    if unsolved_steps > 0 {
        session.ui.caution(
            &format!("in {unsolved_steps} of {steps} steps the solver did not reach sim.tolerance"),
            "raise steps_per_frame, or raise sim.tolerance if a larger error is acceptable",
        );
    }
}

/// The error of a cloth that still moves at the end.
fn no_rest(simulation: &Simulation, motion: Option<Motion>, limit: Motion) -> Error {
    let does = motion.map_or_else(String::new, |motion| {
        format!(
            ": the fastest point moves at {:.3e} m/s (limit {:.3e}), the largest residual force per mass is {:.3e} \
             m/s² (limit {:.3e}); at rest both stay below their limits for {QUIET} s",
            motion.speed, limit.speed, motion.residual, limit.residual,
        )
    });
    let message = format!("not at rest after {} frames, {} s{does}", simulation.frame(), simulation.time());
    Error::new(Kind::Difference, message).with_help(
        "the results of this frame were written; a longer --time or more damping may help\nit does not help when \
         the step is too long, nothing damps, or self-collision and the stretch limit oppose each other: see \
         docs/restless.md",
    )
}

/// Advances `simulation` to frame `frames`, or until `each`, called at the start and after every frame,
/// returns false. Returns the wall time.
fn advance_while(
    simulation: &mut Simulation,
    frames: u64,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<bool>,
) -> Result<Duration> {
    let started = Instant::now();
    let mut progress = Progress::starting_at(&session.ui, "simulating", frames, simulation.frame());
    let mut continues = each(simulation)?;
    while continues && simulation.frame() < frames {
        session.stop.check()?;
        simulation.advance_frame()?;
        progress.set(simulation.frame());
        continues = each(simulation)?;
    }
    drop(progress);
    session.stop.check()?;
    warn_of_unsolved(simulation, session);
    let elapsed = started.elapsed();
    session.ui.remark(&format!("simulated {} frames in {:.3} s", simulation.frame(), elapsed.as_secs_f64()));
    Ok(elapsed)
}
