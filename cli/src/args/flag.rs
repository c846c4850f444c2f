//! Flags that set a key of the scene: the key's rule decides what they allow.

use drape::scene::{Flag, check_value, keys};

/// The change that the flag `name` makes to the key at `path`.
pub(crate) fn flag(name: &'static str, path: &str, value: &str) -> Flag {
    Flag { name, set: format!("{path}={value}") }
}

/// The help of a flag that sets the key at `path`: its meaning and what is allowed.
pub(crate) fn help(path: &str) -> String {
    let key = keys().into_iter().find(|key| key.path() == path);
    key.map_or_else(String::new, |key| format!("{} Sets `{path}`: {}", key.meaning, key.rule()))
}

/// Reads whole numbers that the key at `path` allows, as JSON.
pub(crate) fn whole(path: &'static str) -> impl Fn(&str) -> Result<String, String> + Clone {
    move |text| {
        let digits = text.parse::<u32>().map_or_else(|_| format!("{text:?}"), |number| number.to_string());
        check_value(path, &digits).map(|()| digits)
    }
}

/// Reads a width and a height, as a list in JSON.
pub(crate) fn size(text: &str) -> Result<String, String> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse::<u32>().ok()?, h.parse().ok()?]));
    let [width, height] = sides.ok_or("a size is WIDTHxHEIGHT, such as 1024x800")?;
    let list = format!("[{width},{height}]");
    check_value("render.size", &list).map(|()| list)
}

/// Reads a time with the bounds of `render.time`, in seconds.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "a time is a number of seconds")?;
    check_value("render.time", &seconds.to_string()).map(|()| seconds)
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
        assert_eq!(
            help("render.samples"),
            "Samples per pixel: more than 1 smooths edges. Sets `render.samples`: 1, 4, 8 or 16"
        );
    }
}
