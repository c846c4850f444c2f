//! Whole numbers among numbers.

use serde_json::{Value, json};

/// `value` as an integer, if it is one of at most 2^53.
pub(super) fn whole(value: f64) -> Option<i64> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    #[expect(clippy::cast_possible_truncation, reason = "the guard leaves exact integers only")]
    (value.fract() == 0.0 && (-EXACT..=EXACT).contains(&value)).then_some(value as i64)
}

/// `value` as a document writes it: whole numbers without a point, but for -0, which no integer is.
pub(crate) fn number(value: f64) -> Value {
    let whole = whole(value).filter(|whole| *whole != 0 || value.is_sign_positive());
    whole.map_or_else(|| json!(value), |whole| json!(whole))
}
