//! A cloth that falls on a collider of your own: a ring, which no scene file has.
//!
//! After each step of the engine, every point that is inside the ring is put on its surface. Only
//! positions change, never the last positions, so a point that was held back loses speed: its velocity
//! is `(x - last) / dt`. The phases of the method move points in the same way.
//!
//! `cargo run --release --example own_collider` prints how the cloth comes to hang in the ring. A collider
//! that scene files should have goes into the engine instead: `src/collision/` has a file for each.

#![expect(clippy::print_stdout, reason = "the example shows numbers")]

use std::path::Path;

use drape::error::Result;
use drape::math::length;
use drape::scene::{Overrides, Vec3, load_stock};
use drape::simulation::Simulation;

/// A horizontal ring (a torus), in metres.
struct Ring {
    center: Vec3,
    /// Radius of the circle in the middle of the tube.
    radius: f64,
    /// Radius of the tube.
    tube: f64,
}

impl Ring {
    /// Where a point at `x` goes if it is inside.
    fn depenetrate(&self, x: Vec3) -> Option<Vec3> {
        let e = x - self.center;
        let flat = Vec3::new(e.x, 0.0, e.z);
        let nearest = self.center + flat * (self.radius / length(flat));
        let out = x - nearest;
        // On the axis of the ring there is no nearest point: the comparison with NaN is false.
        (length(out) < self.tube).then(|| nearest + out * (self.tube / length(out)))
    }
}

/// Puts the points outside that are inside `ring`; how many were.
fn collide(simulation: &mut Simulation, ring: &Ring) -> Result<usize> {
    let mut x = simulation.positions().clone();
    let mut moved = 0;
    for p in 0..x.len() {
        if let Some(outside) = ring.depenetrate(x.get(p)) {
            x.set(p, outside);
            moved += 1;
        }
    }
    if moved > 0 {
        // A new start for the check of the energy, which cannot know what a ring may do to a cloth.
        let last = simulation.last_positions().clone();
        simulation.set_state(x, last)?;
    }
    Ok(moved)
}

fn main() -> Result<()> {
    let mut scene = load_stock(Path::new("scenes/sphere.json"), &Overrides::default())?.scene;
    scene.colliders.clear();
    let ring = Ring { center: Vec3::new(0.5, 0.7, 0.5), radius: 0.3, tube: 0.05 };
    let mut simulation = Simulation::new(&scene)?;
    for frame in 1..=135 {
        let mut touching = 0;
        for _ in 0..scene.sim.steps_per_frame {
            simulation.step();
            touching = collide(&mut simulation, &ring)?;
        }
        if frame % 15 == 0 {
            let lowest = simulation.positions().y.iter().copied().fold(f64::INFINITY, f64::min);
            println!(
                "{:.2} s: {touching:3} points touch the ring, the lowest is at {lowest:.3} m",
                simulation.time()
            );
        }
    }
    Ok(())
}
