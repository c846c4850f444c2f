//! Pictures that Pillow reads, turned as Pillow shows them.

use super::python;
use crate::scratch::Scratch;

#[test]
fn pictures_are_turned_as_pillow_turns_them() {
    let scratch = Scratch::new();
    let Some(names) = python(&scratch, "pictures", &[]) else { return };
    let names = names.as_array().expect("names");
    assert!(names.len() > 50, "{names:?}");
    for name in names.iter().map(|name| name.as_str().expect("a name")) {
        let budget = if name.ends_with(".jpg") { "12:1536" } else { "1:0" };
        let run = scratch.run(&["compare", name, &format!("{name}-turned.png"), "--budget", budget]);
        assert_eq!(run.code, Some(0), "{name}: {} {}", String::from_utf8_lossy(&run.stdout), run.stderr);
    }
    assert_eq!(scratch.run(&["compare", "1.png", "3.png"]).code, Some(1));
}
