//! The file of a sweep: whatever its text, it is refused with a reason or each of its cases has a value of every key.

use drape::error::Kind;
use drape_lab::sweep::plan::Plan;

/// Reads the bytes as the text of a SPEC file.
pub(crate) fn run(bytes: &[u8]) {
    let spec = match Plan::spec("spec.json", &String::from_utf8_lossy(bytes)) {
        Ok(spec) => spec,
        Err(error) => {
            assert_eq!((error.kind, error.diagnostics.is_empty()), (Kind::Scene, false), "{error:?}");
            return;
        }
    };
    assert!(!spec.scene.is_empty() && !spec.measure.is_empty());
    let cases = spec.cases();
    assert!(cases >= 1);
    for case in [0, cases / 2, cases - 1] {
        assert_eq!((spec.places(case).len(), spec.values(case).len()), (spec.set.len(), spec.set.len()));
    }
    let lengths = spec.set.iter().map(|axis| axis.values.len());
    if cases < u64::MAX && lengths.clone().all(|length| length > 0) {
        let last: Vec<usize> = lengths.map(|length| length - 1).collect();
        assert_eq!(spec.places(cases - 1), last);
    }
    for numbers in spec.set.iter().flat_map(|axis| &axis.values).filter_map(|value| value.as_f64()) {
        assert!(numbers.is_finite());
    }
}
