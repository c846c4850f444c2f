//! The values of `--time-limit` and `--memory-limit`.

use std::time::Duration;

/// A time in seconds, such as `90` or `0.5`.
pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.strip_suffix('s').unwrap_or(text).parse().unwrap_or(f64::NAN);
    Duration::try_from_secs_f64(seconds)
        .map_err(|_| "allowed: seconds, 0 and up, such as 90 or 0.5".to_owned())
}

/// A number of bytes, such as `500M`: alone, or with K, M, G or T for powers of 1024 (Ki, KiB and KB say the same).
pub(crate) fn bytes(text: &str) -> Result<u64, String> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, unit) = text.split_at(digits);
    let shift = match unit.trim().to_ascii_lowercase().as_str() {
        "" | "b" => Some(0),
        "k" | "ki" | "kib" | "kb" => Some(10),
        "m" | "mi" | "mib" | "mb" => Some(20),
        "g" | "gi" | "gib" | "gb" => Some(30),
        "t" | "ti" | "tib" | "tb" => Some(40),
        _ => None,
    };
    let bytes =
        number.parse::<u64>().ok().zip(shift).and_then(|(number, shift)| number.checked_mul(1 << shift));
    bytes.ok_or_else(|| {
        format!("allowed: a whole number of bytes, such as 1000000, 500M or 2G, at most {}", u64::MAX)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_read() {
        assert_eq!(seconds("1.5"), Ok(Duration::from_millis(1500)));
        assert_eq!(seconds("2s"), Ok(Duration::from_secs(2)));
        assert!(["", "-1", "nan", "inf", "1e300", "5m"].into_iter().all(|text| seconds(text).is_err()));
        assert_eq!([bytes("7"), bytes("2K"), bytes("500 MiB")], [Ok(7), Ok(2048), Ok(500 << 20)]);
        assert!(["", "M", "-1", "1.5G", "5X", "99999999999T"].into_iter().all(|text| bytes(text).is_err()));
    }
}
