//! Rounding is told from mistakes, and hides none.

use super::{HANGING, compared, positions, raw};
use crate::mistakes::Mistakes;

/// Programs that print six digits, as C++ does by default, or three decimals, or that write f32.
#[test]
fn rounding_to_few_digits_is_told_from_mistakes() {
    let right = positions(HANGING, Mistakes::default(), 10);
    let wrong = positions(HANGING, Mistakes { stiff_bending: true, ..Mistakes::default() }, 10);
    let text = |numbers: &[f64], write: &dyn Fn(f64) -> String| {
        numbers.iter().map(|&number| write(number) + " ").collect::<String>().into_bytes()
    };
    let six = |x: f64| format!("{x:.5e}");
    let three = |x: f64| format!("{x:.3}");
    let single = |x: f64| (x as f32).to_string();
    let writers: [(&dyn Fn(f64) -> String, &str); 3] =
        [(&six, "6 digits"), (&three, "3 d"), (&single, "32 bits")];
    for (write, digits) in writers {
        let verdict =
            |numbers: &[f64]| compared(HANGING, text(numbers, write), &[], 1)["verdict"].to_string();
        let found = verdict(&right);
        assert!(
            found.contains("every difference is rounding") && found.contains(digits),
            "{digits}: {found}"
        );
        let found = verdict(&wrong);
        assert!(found.contains("bending springs as stiff"), "{digits}: {found}");
    }
}

#[test]
fn a_tolerance_lets_pass_and_rounding_is_told_from_mistakes() {
    let numbers: Vec<f64> =
        positions(HANGING, Mistakes::default(), 5).iter().map(|x| x * (1.0 + 4.0 * f64::EPSILON)).collect();
    let report = compared(HANGING, raw(&numbers), &[], 1);
    assert!(report["verdict"].as_str().is_some_and(|verdict| verdict.contains("rounding")), "{report}");
    compared(HANGING, raw(&numbers), &["--tolerance", "1e-12"], 0);
    compared(HANGING, raw(&numbers), &["--tolerance", "1e-17"], 1);
}

/// A program whose grid or sums are rounded otherwise differs from the first frame on, and may still make a
/// mistake.
#[test]
fn a_mistake_is_found_behind_rounding() {
    let none = Mistakes::default();
    let rounded = |mistakes| -> Vec<f64> {
        positions(HANGING, mistakes, 10).iter().map(|x| x * (1.0 + 4.0 * f64::EPSILON)).collect()
    };
    let says = |numbers: Vec<f64>| compared(HANGING, raw(&numbers), &[], 1)["verdict"].to_string();
    assert!(says(rounded(none)).contains("rounding"));
    let both = says(rounded(Mistakes { stiff_bending: true, ..none }));
    assert!(both.contains("behaves like the mistake: bending springs as stiff"), "{both}");
}
