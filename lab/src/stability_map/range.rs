//! Values along an axis as text: `1e2..1e9:log8`, `5..50:lin10`, `30` or `500,5000`.

use std::collections::BTreeSet;

use drape::math::{exp, ln};

/// The most values of one axis.
pub const MAX_VALUES: usize = 200;

/// Positive numbers along an axis, ascending, each once.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(pub Vec<f64>);

impl Values {
    /// Reads numbers separated by commas, or `FIRST..LAST:logN` and `FIRST..LAST:linN` for N of
    /// them with equal ratios or differences. The ends are kept exactly.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        let values = match text.split_once("..") {
            Some((first, rest)) => spread(number(first)?, rest)?,
            None => text.split(',').map(number).collect::<Result<_, _>>()?,
        };
        Ok(Self(values).sorted())
    }

    /// The values rounded to whole numbers of at least 1, each once.
    pub fn whole(&self) -> Vec<u32> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the type")]
        let whole: BTreeSet<u32> = self.0.iter().map(|v| v.round().clamp(1.0, 1e9) as u32).collect();
        whole.into_iter().collect()
    }

    fn sorted(mut self) -> Self {
        self.0.sort_by(f64::total_cmp);
        self.0.dedup();
        self
    }
}

/// The values from `first` on that `rest` = `LAST:logN` or `LAST:linN` describes.
fn spread(first: f64, rest: &str) -> Result<Vec<f64>, String> {
    let form = || "write FIRST..LAST:logN or FIRST..LAST:linN for N values, such as 1e2..1e9:log8".to_owned();
    let Some((last, manner)) = rest.split_once(':') else {
        number(rest)?;
        return Err(
            "say how many values: add `:log7` for seven with equal ratios, `:lin7` with equal differences"
                .to_owned(),
        );
    };
    let last = number(last)?;
    let (is_log, count) = match (manner.strip_prefix("log"), manner.strip_prefix("lin")) {
        (Some(count), _) => (true, count),
        (_, Some(count)) => (false, count),
        _ => return Err(form()),
    };
    let count: usize = count.parse().map_err(|_| form())?;
    if !(2..=MAX_VALUES).contains(&count) {
        return Err(format!("an axis has 2 to {MAX_VALUES} values, not {count}"));
    }
    let inner = (1..count - 1).map(|i| {
        let part = i as f64 / (count - 1) as f64;
        if is_log { first * exp(part * ln(last / first)) } else { first + part * (last - first) }
    });
    Ok(std::iter::once(first).chain(inner).chain([last]).collect())
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|value| (1e-15..=1e15).contains(value));
    number.ok_or_else(|| format!("`{}` is not a number from 1e-15 to 1e15", text.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_exact_and_steps_are_even() {
        let Values(log) = Values::parse("1e2..1e9:log8").unwrap();
        assert_eq!((log.len(), log[0], log[7]), (8, 1e2, 1e9));
        for (value, exact) in log.iter().zip([1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9]) {
            assert!((value / exact - 1.0).abs() < 1e-14, "{value} instead of {exact}");
        }
        assert_eq!(Values::parse("5..50:lin10").unwrap().0[3], 20.0);
        assert_eq!(Values::parse("50,5, 50").unwrap().0, [5.0, 50.0]);
        assert_eq!(Values::parse("1..3:log9").unwrap().whole(), [1, 2, 3]);
    }

    #[test]
    fn what_is_no_range_is_refused() {
        assert!(Values::parse("1000..1e6").unwrap_err().contains("add `:log7`"));
        for text in
            ["", "0", "-1", "nan", "1..2", "1..2:log", "1..2:log1", "1..2:lin201", "1..2:cubic3", "1..x:log3"]
        {
            assert!(Values::parse(text).is_err(), "{text}");
        }
    }
}
