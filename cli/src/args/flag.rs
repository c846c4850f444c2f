//! Flags that set a key of the scene: the key's rule decides what they allow.

use drape::scene::{Flag, check_value, keys};

/// The change that the flag `name` makes to the key at `path`.
pub(crate) fn flag(name: &'static str, path: &str, value: &str) -> Flag {
    Flag { name, set: format!("{path}={value}") }
}

/// The help of a flag that sets the key at `path`: `what` it is, or else the key's meaning, and what is allowed.
pub(crate) fn help(what: &str, path: &str) -> String {
    let keys = keys();
    let Some(key) = keys.iter().find(|key| key.path() == path) else { return what.to_owned() };
    let what = if what.is_empty() { key.meaning.trim_end_matches('.') } else { what };
    format!("{what} ({path}: {})", key.rule())
}

/// Parses whole numbers that the key at `path` allows, as JSON.
pub(crate) fn whole(path: &'static str) -> impl Fn(&str) -> Result<String, String> + Clone {
    move |text| {
        let digits = text.parse::<u32>().map_or_else(|_| format!("{text:?}"), |number| number.to_string());
        check_value(path, &digits).map(|()| digits)
    }
}

/// Parses a width and a height, as a list in JSON.
pub(crate) fn size(text: &str) -> Result<String, String> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse::<u32>().ok()?, h.parse().ok()?]));
    let [width, height] = sides.ok_or("expected WxH, such as 1024x800")?;
    let list = format!("[{width},{height}]");
    check_value("render.size", &list).map(|()| list)
}

/// Parses a time in seconds, with the bounds of `render.time`.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "expected a number of seconds")?;
    let json = if seconds.is_finite() { seconds.to_string() } else { text.to_owned() };
    check_value("render.time", &json).map(|()| seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flag_allows_what_its_key_allows() {
        assert_eq!(size("1024x800"), Ok("[1024,800]".into()));
        assert_eq!(size("1x16384"), Ok("[1,16384]".into()));
        for text in ["", "x", "0x1", "1x0", "16385x1", "1024", "-1x1", "1x1x1", "1 x 1", "99999999999x1"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["0", "2", "3", "32", "-4", "4.0", "", "\""] {
            assert!(whole("render.samples")(text).is_err(), "{text}");
        }
        assert_eq!(whole("render.samples")("16"), Ok("16".into()));
        assert!(whole("sphere.resolution.0")("2").is_ok() && whole("sphere.resolution.1")("2").is_err());
        assert_eq!(seconds(".5"), Ok(0.5));
        for text in ["-1", "1e7", "nan", "inf", "1e999", "1s"] {
            assert!(seconds(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_help_says_what_the_key_means_and_allows() {
        let samples = "Samples per pixel: more than 1 smooths edges (render.samples: 1, 4, 8 or 16)";
        assert_eq!(help("", "render.samples"), samples);
        let latitudes = "Latitudes (sphere.resolution: a list of 2 whole numbers: 2 to 1000, 3 to 1000)";
        assert_eq!(help("Latitudes", "sphere.resolution"), latitudes);
    }
}
