//! What is asked for: how far from the limit the points may be.

use std::str::FromStr;

use crate::accuracy::measure::Measure;

/// The distance that is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// In the unit of `measure`.
    pub value: f64,
    /// How it is measured.
    pub measure: Measure,
}

/// The units of a length, in metres.
const UNITS: [(&str, f64); 5] = [("um", 1e-6), ("µm", 1e-6), ("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)];

impl FromStr for Tolerance {
    type Err = String;

    /// A length, `1mm`, `0.1mm` or `2e-4m`, or a part of the picture, `0.5px`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no length: write a number above 0 and its unit, um, mm, cm, m or px, such as 1mm or 0.5px"
            )
        };
        let units = UNITS.map(|(unit, factor)| (unit, factor, Measure::Rms));
        let units = [("px", 1.0, Measure::Pixels)].into_iter().chain(units);
        for (unit, factor, measure) in units {
            let number = text.strip_suffix(unit).and_then(|number| number.trim_end().parse::<f64>().ok());
            if let Some(number) = number {
                let value = number * factor;
                return if value.is_normal() && value > 0.0 {
                    Ok(Self { value, measure })
                } else {
                    Err(wrong())
                };
            }
        }
        Err(wrong())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_a_number_with_a_unit() {
        let read = |text: &str| text.parse::<Tolerance>().map(|t| (t.value, t.measure));
        assert_eq!(read("1mm"), Ok((1e-3, Measure::Rms)));
        assert_eq!(read("2e-4m"), Ok((2e-4, Measure::Rms)));
        assert_eq!(read("3 um"), Ok((3e-6, Measure::Rms)));
        assert_eq!(read("0.5px"), Ok((0.5, Measure::Pixels)));
        for text in ["", "1", "mm", "-1mm", "0mm", "nanm", "infpx", "1km", "1e-400m", "1 inch"] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
