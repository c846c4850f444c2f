//! The report of a sweep: results.csv, results.json and a page, in one pass over the cases.

mod page;
mod plots;
mod rows;
mod script;
mod sheet;
mod shown;
mod table;

use std::io::Write;

use super::plan::Plan;
use super::work::Event;
use crate::store::Entry;
use drape::error::{Error, Kind, Result};
use plots::Plots;
use rows::Rows;
use shown::{MOST_SHOWN, Shown};

pub use shown::Counts;

/// Writes the rows of all cases of `plan` as CSV and as JSON, and returns the page and what was counted. Damaged
/// records count as missing and are told to `watch`.
///
/// # Errors
/// [`Kind::Io`] when cases cannot be read or rows not be written; those of `watch`.
pub fn write(
    plan: &Plan,
    [csv, json]: [&mut dyn Write; 2],
    watch: &dyn Fn(Event) -> Result<()>,
) -> Result<(String, Counts)> {
    let mut counts = Counts { cases: plan.count(), ..Counts::default() };
    let (mut plots, mut shown) = (Plots::new(&plan.spec), Vec::new());
    let mut rows = Rows::new(plan, csv, json).map_err(failed)?;
    let apart = plan.count().div_ceil(MOST_SHOWN).max(1);
    for case in plan.cases()? {
        watch(Event::Frame)?;
        let case = case?;
        let record = match plan.store.record(case.address) {
            Entry::Whole(record) => Some(record),
            Entry::Damaged => {
                watch(Event::Damaged(format!("the result of case {} is damaged", case.address)))?;
                None
            }
            Entry::Missing => None,
        };
        counts.missing += u64::from(record.is_none());
        counts.failed += u64::from(record.as_ref().is_some_and(|record| record.exit_code != 0));
        rows.add(&case, record.as_ref()).map_err(failed)?;
        plots.add(&plan.spec, case.number, record.as_ref());
        if case.number.is_multiple_of(apart) {
            let picture = record.as_ref().and_then(|record| plan.store.picture(case.address, record));
            shown.push(Shown { case, record, picture });
        }
    }
    rows.finish().map_err(failed)?;
    Ok((page::page(plan, &shown, &plots, counts), counts))
}

fn failed(cause: std::io::Error) -> Error {
    Error::new(Kind::Io, format!("cannot write the report: {cause}"))
}
