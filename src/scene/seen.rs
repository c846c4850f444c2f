//! Keys that a picture shows and a motion does not depend on.

/// Such keys, and keys that hold nothing else.
pub const SEEN: [&str; 13] = [
    "camera",
    "light",
    "material",
    "cloth.material",
    "sphere.material",
    "box.material",
    "plane.material",
    "sphere.resolution",
    "render.size",
    "render.samples",
    "render.background",
    "render.filter",
    "render.seamless",
];

/// Whether the dotted path of a change, such as `sphere.0.material.ks`, is one of `keys` or lies in one.
pub fn lies_in(path: &str, keys: &[&str]) -> bool {
    let named: Vec<&str> = path.split('.').filter(|step| step.parse::<usize>().is_err()).collect();
    let named = named.join(".");
    let inside =
        |key: &&str| named.strip_prefix(*key).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    keys.iter().any(inside)
}

#[cfg(test)]
mod tests {
    use super::super::keys::keys;
    use super::*;

    #[test]
    fn numbers_do_not_matter_and_names_are_whole() {
        for path in ["camera", "camera.polar", "sphere.material.ks", "sphere.0.material.ks", "light.color.1"]
        {
            assert!(lies_in(path, &SEEN), "{path}");
        }
        for path in ["render.time", "sphere.radius", "sphere.0.origin.0", "cameras", "cloth.ks", "render"] {
            assert!(!lies_in(path, &SEEN), "{path}");
        }
    }

    #[test]
    fn every_key_of_the_list_is_one() {
        for key in SEEN {
            assert!(keys().iter().any(|known| lies_in(&known.path(), &[key])), "{key}");
        }
    }
}
