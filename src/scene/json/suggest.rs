//! The known name nearest to a mistyped one.

/// "did you mean `damping`?" if a known name is really near.
pub(crate) fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    nearest(name, known).map(|near| format!("did you mean `{near}`?"))
}

/// The known name with the fewest typing mistakes between, letter case aside: at most one mistake
/// for every four letters, and none in names shorter than three.
pub(crate) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    const LONGEST: usize = 64;
    let name = name.to_lowercase();
    let letters = name.chars().count();
    if letters > LONGEST {
        return None;
    }
    let allowed = |near: &str| (letters.min(near.chars().count()) + 1) / 4;
    known
        .map(|near| (strsim::damerau_levenshtein(&name, near), near))
        .filter(|&(mistakes, near)| mistakes <= allowed(near))
        .min_by_key(|&(mistakes, _)| mistakes)
        .map(|(_, near)| near)
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: [&str; 8] =
        ["ks", "kd", "damping", "pinned", "num_width_points", "color", "ka", "orientation"];

    #[test]
    fn really_near_names_are_found() {
        let near = |name| nearest(name, KEYS.into_iter());
        assert_eq!(near("dampning"), Some("damping"));
        assert_eq!(near("colour"), Some("color"));
        assert_eq!(near("KS"), Some("ks"));
        assert_eq!(near("numWidthPoints"), Some("num_width_points"));
        assert_eq!(near("oreintation"), Some("orientation"));
    }

    #[test]
    fn far_names_are_not() {
        let near = |name| nearest(name, KEYS.into_iter());
        for name in ["pin_edges", "kb", "k", "", "width", "camping trip", &"x".repeat(100)] {
            assert_eq!(near(name), None, "{name}");
        }
    }
}
