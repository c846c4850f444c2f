//! Sweeps: one scene with many changes, planned, worked off by any number of workers, and reported.
//!
//! Data flows `Spec -> Plan -> Case -> Record -> report`. A case depends on its changes and on the plan alone, and
//! its record is stored under a hash of both. So workers need not know of each other, and the report has the same bytes
//! whoever made the records. Planning, work and reports go over the cases one after the other: their memory does not
//! grow with the number of cases.

pub mod measures;
pub mod case;
pub mod plan;
pub mod record;
mod run;
pub mod idle;
pub mod work;
pub mod report;
