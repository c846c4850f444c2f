//! Pictures that Pillow writes, read as Pillow shows them.

use super::python;
use crate::scratch::Scratch;

#[test]
fn pictures_are_turned_as_pillow_turns_them() {
    let scratch = Scratch::new();
    if python(&scratch, "pictures", &[]).is_none() {
        return;
    }
    for orientation in 1..=8 {
        for (ending, budget) in [("png", "1:0"), ("jpg", "12:1536")] {
            let (a, b) = (format!("{orientation}.{ending}"), format!("{orientation}-{ending}-turned.png"));
            let run = scratch.run(&["compare", &a, &b, "--budget", budget]);
            assert_eq!(run.code, Some(0), "{a}: {} {}", String::from_utf8_lossy(&run.stdout), run.stderr);
        }
    }
    assert_eq!(scratch.run(&["compare", "1.png", "3.png"]).code, Some(1));
}
