//! Files and texts that are no scene at all.

use drape::error::Kind;
use drape::scene::{Overrides, load, load_text};
use std::fs;
use std::path::Path;

use super::{error, summary};

#[test]
fn text_that_is_not_json_is_refused_where_it_goes_wrong() {
    let cases = [
        ("", 1, 1, "the file is empty"),
        (" \n ", 1, 1, "the file is empty"),
        ("\u{feff}", 1, 1, "the file is empty"),
        (
            "\u{feff}{\n} x",
            2,
            3,
            "nothing may follow: a scene ends with its closing brace, and a list stands in brackets",
        ),
        ("{\"sim\": {}", 1, 1, "this object is never closed"),
        ("{\"sim\": [1", 1, 9, "this list is never closed"),
        (
            "{\n} x",
            2,
            3,
            "nothing may follow: a scene ends with its closing brace, and a list stands in brackets",
        ),
        (
            "{} {}",
            1,
            4,
            "nothing may follow: a scene ends with its closing brace, and a list stands in brackets",
        ),
        ("{\"sim\": {},}", 1, 11, "trailing commas are not allowed"),
        ("{\"sim\" {}}", 1, 8, "expected `:` after the key"),
        ("{\"sim\": {} \"light\": {}}", 1, 11, "expected `,`"),
        ("{sim: {}}", 1, 2, "expected string for object property"),
        ("{'sim': {}}", 1, 2, "single-quoted strings are not allowed"),
        ("# x\n{}", 1, 1, "comments are not allowed: a scene is plain JSON, as in the course's viewer"),
        ("{\n# x\n}", 2, 1, "comments are not allowed: a scene is plain JSON, as in the course's viewer"),
        ("{} // x", 1, 4, "comments are not allowed: a scene is plain JSON, as in the course's viewer"),
        ("{\"sim\": tru}", 1, 9, "this is no JSON value"),
        ("{\"sim\": .5}", 1, 9, "leading or trailing decimal points on numbers are not allowed"),
        ("{\"sim\": 5.}", 1, 9, "leading or trailing decimal points on numbers are not allowed"),
        ("{\"sim\": +5}", 1, 9, "unary plus on numbers is not allowed"),
        ("{\"sim\": 0x5}", 1, 9, "hexadecimal numbers are not allowed"),
        ("{\"sim\": 05}", 1, 10, "expected `,`"),
        ("{\"sim\": NaN}", 1, 9, "this is no JSON value"),
        ("{\"sim\": -Infinity}", 1, 9, "infinity and NaN are not allowed"),
        ("{\"sim\": \"a\nb\"}", 1, 11, "control characters in text must be escaped"),
        ("{\"sim\": \"a\tb\"}", 1, 11, "control characters in text must be escaped"),
        ("{\"sim\":\u{b}1}", 1, 8, "this character is not allowed here"),
        ("{\"sim\":\u{a0}1}", 1, 8, "this character is not allowed here"),
    ];
    for (text, line, column, reason) in cases {
        let error = error(text, &[]);
        assert_eq!(summary(&error), [format!("scene::syntax {line}:{column} ")], "{text}");
        assert!(error.message.ends_with(reason), "{text}: {}", error.message);
    }
}

#[test]
fn what_is_too_deep_or_too_large_or_not_utf8_is_refused() {
    for levels in [66, 200, 600, 100_000] {
        let text = format!("{{\"sim\": {}{}}}", "[".repeat(levels), "]".repeat(levels));
        assert_eq!(error(&text, &[]).diagnostics[0].message, "nested too deeply", "{levels}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.json");
    let refused = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        load(&file, &Overrides::default()).unwrap_err()
    };
    assert_eq!(summary(&refused(b"{\n\"\xff\": 1}")), ["scene::syntax 2:2 "]);
    assert_eq!(summary(&refused(&vec![b' '; (16 << 20) + 1])), ["scene::too_large 1:1 "]);
    assert_eq!(summary(&refused(&vec![b' '; 16 << 20])), ["scene::syntax 1:1 "], "exactly 16 MiB are read");
}

#[test]
fn what_is_no_utf8_is_refused_and_utf16_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    let wide = |bytes: fn(u16) -> [u8; 2]| "\u{feff}{}".encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
    for (bytes, reason) in [
        (wide(u16::to_le_bytes), "the file is UTF-16: save it as UTF-8"),
        (wide(u16::to_be_bytes), "the file is UTF-16: save it as UTF-8"),
        (b"{\"cl\xF6th\": 1}".to_vec(), "not valid UTF-8"),
    ] {
        fs::write(&path, &bytes).unwrap();
        let error = load(&path, &Overrides::default()).unwrap_err();
        assert!(error.message.ends_with(reason), "{bytes:?}: {}", error.message);
    }
}

#[test]
fn a_file_that_cannot_be_read_is_an_input_error() {
    let missing = Path::new("no/such/scene.json");
    let error = load(missing, &Overrides::default()).unwrap_err();
    assert_eq!(error.kind, Kind::Io);
    assert!(error.message.starts_with("cannot read no/such/scene.json: "), "{}", error.message);
    let overrides = Overrides { patches: vec![missing.into()], ..Overrides::default() };
    assert_eq!(load_text("scene.json", "{}", &overrides).unwrap_err().kind, Kind::Io);
    assert_eq!(load(Path::new("."), &Overrides::default()).unwrap_err().kind, Kind::Io);
}

#[test]
fn a_file_of_nearly_the_name_is_offered() {
    let help = |path: &str| load(Path::new(path), &Overrides::default()).unwrap_err().help;
    assert_eq!(help("scenes/spere.json"), "did you mean `scenes/sphere.json`?");
    assert_eq!(help("Cargo.tml"), "did you mean `Cargo.toml`?");
    for path in ["scenes/blanket.json", "scene/sphere.json", "", "scenes"] {
        assert_eq!(help(path), "", "{path}");
    }
}

#[test]
fn a_set_that_is_not_path_and_value_is_a_usage_error() {
    let path = format!("{}=1", ["a"; 65].join("."));
    for argument in ["cloth.ks", "", "=5", "cloth..ks=5", ".ks=5", "cloth.=5", &path] {
        assert_eq!(error("{}", &[argument]).kind, Kind::Usage, "{argument}");
    }
}

#[test]
fn reading_stops_after_a_hundred_errors() {
    let text = format!("{{{}}}", (0..300).map(|i| format!("\"k{i}\": 0")).collect::<Vec<_>>().join(","));
    let found = error(&text, &[]);
    assert_eq!(found.diagnostics.len(), 101);
    assert_eq!(found.diagnostics[100].message, "stopped after 100 errors");
}
