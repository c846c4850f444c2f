//! Colours and the few functions that shape them.

/// Red, green and blue as shown on a screen, 0..=1.
pub(super) type Color = [f64; 3];

/// A colour written as 0xRRGGBB.
pub(super) const fn hex(rgb: u32) -> Color {
    [((rgb >> 16) & 255) as f64 / 255.0, ((rgb >> 8) & 255) as f64 / 255.0, (rgb & 255) as f64 / 255.0]
}

/// `a` where `t` is 0, `b` where it is 1.
pub(super) fn mix(a: Color, b: Color, t: f64) -> Color {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t)
}

/// Every channel times `by`.
pub(super) fn scale(color: Color, by: f64) -> Color {
    color.map(|channel| channel * by)
}

/// Light added to light.
pub(super) fn add(a: Color, b: Color) -> Color {
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// 0 below `low`, 1 above `high`, a smooth rise between (also falls, if `low` is the higher one).
pub(super) fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A gradient through `stops` of (place, colour) in rising order.
pub(super) fn ramp(stops: &[(f64, Color)], x: f64) -> Color {
    let next = stops.partition_point(|stop| stop.0 <= x).clamp(1, stops.len() - 1);
    let ((a, from), (b, to)) = (stops[next - 1], stops[next]);
    mix(from, to, smooth(a, b, x))
}

/// The nearest bytes.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=255")]
pub(super) fn to_bytes(color: Color) -> [u8; 3] {
    color.map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8)
}
