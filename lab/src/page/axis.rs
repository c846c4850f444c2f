//! Axes of plots: how numbers are laid out along them, and their ticks.

use drape::math::ln;

/// How numbers are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps for equal differences.
    Linear,
    /// Equal steps for equal ratios; numbers above 0 only.
    Log,
}

/// One axis: what it shows and from where to where.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(super) label: String,
    range: [f64; 2],
    scale: Scale,
    /// The only tick, where there is but one value to be shown.
    only: Option<(f64, String)>,
}

impl Axis {
    /// An axis from `low` to `high`, called `label`, which names its unit.
    pub fn new(label: &str, scale: Scale, low: f64, high: f64) -> Self {
        Self { label: label.to_owned(), range: [low, high], scale, only: None }
    }

    /// A logarithmic axis with `value` (> 0) in its middle, whose only tick says `text`: for a cell from
    /// half to twice the value, which takes up a third of it.
    pub fn around(label: &str, value: f64, text: &str) -> Self {
        let only = Some((value, text.to_owned()));
        Self { only, ..Self::new(label, Scale::Log, value / 8.0, value * 8.0) }
    }

    /// A logarithmic axis of whole decades that holds all of `values` that are above 0 and finite;
    /// 1 to 10 if there are none.
    pub fn decades(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
        for value in values.into_iter().filter(|value| *value > 0.0 && value.is_finite()) {
            (low, high) = (low.min(value), high.max(value));
        }
        let [low, high] = if high > 0.0 { [log10(low), log10(high)] } else { [0.0, 1.0] };
        let [low, high] = [low.floor(), high.ceil().max(low.floor() + 1.0)];
        Self::new(label, Scale::Log, power_of_ten(low), power_of_ten(high))
    }

    /// The ends of the axis.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Where `value` lies: 0 at the low end, 1 at the high end.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log => ln(value / low) / ln(high / low),
        }
    }

    /// The numbers at ticks with their text, at least two or the only one. On a logarithmic axis
    /// powers of ten, every nth one if there are many, or 1, 2 and 5 times them if there are few; on a
    /// linear one, or where these are few too, 1, 2 or 5 times a power of ten apart.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        if let Some(only) = &self.only {
            return vec![only.clone()];
        }
        let logarithmic = [Self::powers, Self::parts].into_iter().map(|ticks| ticks(self));
        let mut enough = logarithmic.filter(|ticks| self.scale == Scale::Log && ticks.len() > 1);
        enough.next().unwrap_or_else(|| self.even())
    }

    /// Powers of ten, at most seven.
    fn powers(&self) -> Vec<(f64, String)> {
        let [first, last] = self.exponents();
        let apart = ((last - first) / 6.0).ceil().max(1.0);
        steps(first, last, apart).map(|e| (power_of_ten(e), format!("1e{e}"))).collect()
    }

    /// 1, 2 and 5 times powers of ten.
    fn parts(&self) -> Vec<(f64, String)> {
        let [first, last] = self.exponents();
        let parts = steps(first - 1.0, last, 1.0).flat_map(|e| [1.0, 2.0, 5.0].map(|n| n * power_of_ten(e)));
        let [low, high] = self.range;
        parts.filter(|at| (low..=high).contains(at)).map(|at| (at, at.to_string())).collect()
    }

    /// The powers of ten that are on the axis: the first and the last one's exponent.
    fn exponents(&self) -> [f64; 2] {
        let [low, high] = self.range;
        [(log10(low) - 1e-9).ceil(), (log10(high) + 1e-9).floor()]
    }

    /// Numbers 1, 2 or 5 times a power of ten apart.
    fn even(&self) -> Vec<(f64, String)> {
        let [low, high] = self.range;
        let rough = power_of_ten(log10((high - low) / 6.0).floor());
        let apart = [1.0, 2.0, 5.0, 10.0].map(|n| n * rough).into_iter().find(|n| (high - low) / n <= 6.0);
        let apart = apart.unwrap_or(10.0 * rough);
        let text = |n: f64| (n * apart, format!("{}", (n * apart * 1e6 / rough).round() * rough / 1e6));
        steps((low / apart).ceil(), (high / apart).floor(), 1.0).map(text).collect()
    }
}

/// `first`, `first + apart`, ... up to `last`, at most 100 of them.
fn steps(first: f64, last: f64, apart: f64) -> impl Iterator<Item = f64> {
    (0..100).map(move |i| first + f64::from(i) * apart).take_while(move |&at| at <= last)
}

/// The common logarithm of `value` (> 0), exact at the powers of ten that [`power_of_ten`] gives.
fn log10(value: f64) -> f64 {
    let guess = ln(value) / std::f64::consts::LN_10;
    if power_of_ten(guess.round()) == value { guess.round() } else { guess }
}

/// Ten to a whole power.
fn power_of_ten(exponent: f64) -> f64 {
    // The text of the number is read exactly, as a product of tens would not be.
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn decades_hold_every_positive_number() {
        let axis = Axis::decades("", [3e-7, 0.0, -1.0, f64::NAN, 0.02, f64::INFINITY]);
        assert_eq!(axis.range(), [1e-7, 0.1]);
        assert_eq!(texts(&axis), ["1e-7", "1e-6", "1e-5", "1e-4", "1e-3", "1e-2", "1e-1"]);
        assert_eq!(Axis::decades("", [1e-3]).range(), [1e-3, 1e-2], "never empty");
        assert_eq!(Axis::decades("", []).range(), [1.0, 10.0]);
        let wide = Axis::decades("", [1e-20, 1.0]);
        assert!(texts(&wide).len() <= 7, "{:?}", texts(&wide));
    }

    #[test]
    fn places_follow_differences_or_ratios() {
        let linear = Axis::new("", Scale::Linear, -2.0, 6.0);
        assert_eq!([-2.0, 0.0, 6.0].map(|x| linear.place(x)), [0.0, 0.25, 1.0]);
        let log = Axis::new("", Scale::Log, 0.01, 100.0);
        for (x, place) in [(0.01, 0.0), (0.1, 0.25), (1.0, 0.5), (100.0, 1.0)] {
            assert!((log.place(x) - place).abs() < 1e-15, "{x}: {}", log.place(x));
        }
    }

    #[test]
    fn short_logarithmic_axes_have_ticks_too() {
        let ticks = |low, high| texts(&Axis::new("", Scale::Log, low, high));
        assert_eq!(ticks(0.6, 500.0), ["1e0", "1e1", "1e2"]);
        assert_eq!(ticks(5.3, 24.0), ["10", "20"]);
        assert_eq!(ticks(30.0, 85.0), ["30", "40", "50", "60", "70", "80"], "by even steps");
        assert_eq!(ticks(2.6, 4.4), ["3", "3.5", "4"]);
        let one = Axis::around("", 30.0, "thirty");
        assert_eq!((texts(&one), one.place(30.0)), (vec!["thirty".to_owned()], 0.5));
    }

    #[test]
    fn linear_ticks_are_round_and_few() {
        assert_eq!(texts(&Axis::new("", Scale::Linear, 0.0, 1.0)), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(texts(&Axis::new("", Scale::Linear, -3.0, 37.0)), ["0", "10", "20", "30"]);
        assert_eq!(texts(&Axis::new("", Scale::Linear, 0.5, 3.4)), ["0.5", "1", "1.5", "2", "2.5", "3"]);
    }
}
