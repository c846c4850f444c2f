//! Keys that a sweep changes although nothing that it measures or draws depends on them.

use serde_json::Value;

use super::case::Case;
use super::plan::Plan;
use super::run::flags;
use drape::scene::sweep::{Spec, Until};
use drape::scene::{Overrides, SEEN, keys, lies_in, load_text};

/// With more cases than this, their scenes are not looked through: ten take about a millisecond.
const MOST_CASES: u64 = 1000;

/// A sentence for each key of `plan` that changes nothing in any case.
pub fn idle(plan: &Plan) -> Vec<String> {
    let few = if plan.count() <= MOST_CASES { plan.count() } else { 0 };
    let cases: Option<Vec<Seen>> = (0..few).map(|number| Seen::of(plan, number)).collect();
    // A case that is an error differs from the others.
    let cases = cases.unwrap_or_default();
    let axes = plan.spec.set.iter().enumerate();
    axes.filter_map(|(number, axis)| match unread(&axis.path, &plan.spec) {
        Some(why) => Some(format!("`{}` has no effect: {why}", axis.path)),
        None => warned_of(number, &axis.path, &cases),
    })
    .collect()
}

/// Why the sweep does not read the key at `path`, if so.
fn unread(path: &str, spec: &Spec) -> Option<&'static str> {
    let drawn = spec.render.is_some();
    match spec.until {
        Until::Time(_) if lies_in(path, &["render.time"]) => Some("`time` of the sweep says the moment"),
        Until::Frames(_) if lies_in(path, &["render.time"]) => Some("`frames` of the sweep say the moment"),
        _ if !drawn && lies_in(path, &SEEN) => Some("nothing is drawn without `render`"),
        _ if drawn && lies_in(path, &["render.size"]) => Some("`render` of the sweep says the size"),
        _ => None,
    }
}

/// The values of a case, and the keys that change nothing in it, each with the sentence that says why.
struct Seen {
    values: Vec<Value>,
    idle: Vec<(String, String)>,
}

impl Seen {
    /// Case `number` of `plan`; nothing if its scene is not valid.
    fn of(plan: &Plan, number: u64) -> Option<Self> {
        let case = Case::new(number, &plan.spec, "");
        let overrides = Overrides { sets: case.sets(), flags: flags(&plan.spec), ..Overrides::default() };
        let loaded = load_text(&plan.scene().name, &plan.scene().text, &overrides).ok()?;
        let warned = loaded.warnings.into_iter().filter(|warning| warning.code == "scene::without_effect");
        let idle = warned.map(|warning| (warning.key, warning.message)).collect();
        Some(Self { values: case.changes.into_iter().map(|(_, value)| value).collect(), idle })
    }
}

/// The warning of axis `number`, which is of the key at `path`, if no case is without it but those with the default,
/// which asks for nothing.
fn warned_of(number: usize, path: &str, cases: &[Seen]) -> Option<String> {
    let keys = keys();
    let default = keys.iter().filter(|key| lies_in(path, &[&key.path()])).find_map(|key| key.default());
    let mut sentence = None;
    for case in cases {
        match case.idle.iter().find(|(key, _)| is_same(key, path)) {
            Some((_, text)) => sentence = Some(text.clone()),
            None if default == case.values.get(number) => {}
            None => return None,
        }
    }
    sentence
}

/// Whether two paths are of the same key: the first of several objects may be numbered or not.
fn is_same(a: &str, b: &str) -> bool {
    a.replacen(".0.", ".", 1) == b.replacen(".0.", ".", 1)
}
