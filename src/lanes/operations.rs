//! Tests: every operation of every kind of lanes is that of plain numbers.

use super::{
    F64, FragmentLanes, Lane, Part, Texels, Whole,
    level::{Level, dispatch},
};

const SPECIAL: [f32; 11] =
    [0.0, -0.0, 1.0, -1.5, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e-45, 2.5, -2.5, 1e30];

/// Whole numbers, also those that a cast saturates.
const WHOLES: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    255.0,
    -16_384.0,
    4_194_303.0,
    -4_194_305.0,
    16_777_216.0,
    3e9,
    -3e9,
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    7.0,
    -7.0,
];

/// Every lane of a value, or NaN of one kind.
fn lanes<L: Lane>(value: L) -> Vec<f64> {
    let mut lanes = Vec::new();
    value.each_part(|_, part| lanes.extend((0..<L::Part as Part>::WIDTH).map(|i| part.lane(i))));
    assert_eq!(lanes.len(), L::PARTS * <L::Part as Part>::WIDTH);
    lanes
}

/// Operations on pairs of special numbers, by lanes and by f32.
fn operations<L: Lane>(token: L::Token) {
    for (a, b) in SPECIAL.into_iter().flat_map(|a| SPECIAL.map(|b| (a, b))) {
        let (x, y) = (L::splat(token, a), L::splat(token, b));
        let pairs = [
            (x + y, a + b),
            (x - y, a - b),
            (x * y, a * b),
            (x / y, a / b),
            (x + b, a + b),
            (x - b, a - b),
            (x * b, a * b),
            (-x, -a),
            (Lane::sqrt(x), a.sqrt()),
            (Lane::floor(x), a.floor()),
            (Lane::abs(x), if a < 0.0 { -a } else { a }),
            (Lane::max(x, y), if b < a { a } else { b }),
            (Lane::min(x, y), if a < b { a } else { b }),
            (x.select_less(y, x, y), if a < b { a } else { b }),
        ];
        for (i, (wide, one)) in pairs.into_iter().enumerate() {
            let one = f64::from(one);
            let same = |lane: &f64| lane.to_bits() == one.to_bits() || (lane.is_nan() && one.is_nan());
            assert!(
                lanes(wide).iter().all(same),
                "operation {i} of {a} and {b}: {:?} for {one}",
                lanes(wide)
            );
        }
    }
}

/// What only a single vector has.
fn of_parts<P: Part>(token: P::Token) {
    let from = |i: usize| WHOLES[i % 16];
    for first in 0..16 {
        let value = P::from_fn(token, |i| from(i + first));
        for i in 0..P::WIDTH {
            #[expect(clippy::cast_possible_truncation, reason = "what is tested")]
            let cast = from(i + first) as i32;
            assert_eq!(value.to_whole().lane(i), cast);
            assert_eq!(value.to_whole().each(|i| i / 2).lane(i), cast / 2);
            let small = value.whole_if_small().lane(i);
            assert!(small == cast || !(0..1 << 30).contains(&small), "{small} for {cast}");
            let (low, high) =
                (Whole::max(value.to_whole().all(-5), value.to_whole()).lane(i), Ord::max(cast, -5));
            assert_eq!(low, high);
        }
        let keys: Vec<u32> = (0..16).map(|i| i % 3).collect();
        let replaced = value.replace(&keys, 1, P::splat(token, 9.0));
        for (i, &key) in keys.iter().enumerate().take(P::WIDTH) {
            let expected = if key == 1 { 9.0 } else { value.lane(i) };
            assert!(replaced.lane(i) == expected || expected.is_nan());
        }
    }
    let texel = |i: usize| [0.25, 0.5, 0.75, 1.0].map(|c: f32| c + u8::try_from(i).map_or(0.0, f32::from));
    for (channel, value) in P::transpose(token, texel).into_iter().enumerate() {
        let mut stored = [0.0; 16];
        value.store(&mut stored);
        for (i, stored) in stored.into_iter().enumerate().take(P::WIDTH) {
            assert_eq!([value.lane(i), f64::from(stored)], [f64::from(texel(i)[channel]); 2]);
        }
    }
    let third = P::narrow(P::double_from_fn(token, |i| [1.0, 3.0][i % 2] / 3.0));
    let one = P::narrow(P::double(token, 1.0) * P::double(token, 1.0));
    assert!((0..P::WIDTH).all(|i| one.lane(i) == 1.0 && (third.lane(i) == 1.0) == (i % 2 == 1)));
}

/// Texels mixed in every lane are those of the formula.
fn of_texels<P: Part>(token: P::Token) {
    let number = |i: usize| u8::try_from(i % 251).map_or(0.0, f32::from) * 0.37;
    let texels: Vec<[f32; 4]> =
        (0..70).map(|i| [number(i), number(3 * i + 7), number(17 * i), 1.0]).collect();
    let red: Vec<f32> = texels.iter().map(|texel| texel[0]).collect();
    let weight = |i: usize| number(5 * i + 1) / 93.0;
    let (right, lower) = (P::from_fn(token, weight), P::from_fn(token, |i| weight(i + 16)));
    // The last one reads the last texel.
    let places = P::from_fn(token, |i| number(11 * (i + 1)).min(58.0).floor()).to_whole();
    let places = places.each(|place| if place == places.lane(P::WIDTH - 1) { 58 } else { place });
    let mixed = P::bilinear(Texels { full: &texels, packed: None }, places, 10, [right, lower]);
    for (channel, mixed) in
        mixed.into_iter().chain([P::bilinear_plane(&red, places, 10, [right, lower])]).enumerate()
    {
        for i in 0..P::WIDTH {
            let texel = |further: usize| texels[places.lane(i) as usize + further][channel % 3];
            let mix = |a: P, b: P, f: P| a + (b - a) * f;
            let all = |further: usize| P::splat(token, texel(further));
            let expected = mix(mix(all(0), all(1), right), mix(all(10), all(11), right), lower);
            assert_eq!(mixed.lane(i).to_bits(), expected.lane(i).to_bits(), "channel {channel}, lane {i}");
        }
    }
}

/// Packed texels are read as the numbers that they stand for.
fn of_packed_texels<P: Part>(token: P::Token) {
    let byte = |i: usize, channel: usize| u8::try_from((i * 5 + channel * 85) % 256).unwrap();
    // Neighbours that are equal, in all 256 ways, and others.
    for (count, step) in (0..256).map(|count| (count, 0)).chain([(0, 1), (7, 3)]) {
        let bytes: Vec<[u8; 3]> = (0..70).map(|i| [0, 1, 2].map(|c| byte(count + step * i, c))).collect();
        let full: Vec<[f32; 4]> =
            bytes.iter().map(|b| [b[0], b[1], b[2], 255].map(|b| f32::from(b) / 255.0)).collect();
        let packed: Vec<u32> = bytes.iter().map(|b| u32::from_le_bytes([b[0], b[1], b[2], 0])).collect();
        let weights = [P::from_fn(token, |i| [0.0, 0.3, 0.7][i % 3]), P::splat(token, 0.1)];
        let places = P::from_fn(token, |i| u8::try_from(3 * i).map_or(0.0, f32::from)).to_whole();
        let mixed = [None, Some(&*packed)]
            .map(|packed| P::bilinear(Texels { full: &full, packed }, places, 10, weights));
        for (expected, found) in mixed[0].into_iter().zip(mixed[1]) {
            for i in 0..P::WIDTH {
                assert_eq!(found.lane(i).to_bits(), expected.lane(i).to_bits(), "{count}, {step}, lane {i}");
            }
        }
    }
}

/// Lanes that are less have their bit, and others, NaN among them, have not.
fn of_comparisons<P: Part>(token: P::Token) {
    let values = [-1.0, -0.0, 0.0, 1.0, f32::INFINITY, f32::NAN];
    for (value, other) in values.into_iter().flat_map(|value| values.map(|other| (value, other))) {
        for lane in 0..P::WIDTH {
            let one = P::from_fn(token, |i| if i == lane { value } else { 7.0 });
            let less = one.lanes_less(P::splat(token, other));
            let rest = if 7.0 < other { P::ALL_LANES & !(1 << lane) } else { 0 };
            assert_eq!(less, rest | u32::from(value < other) << lane, "{value} < {other} in lane {lane}");
        }
    }
}

/// Everything at a level.
fn all<S: FragmentLanes>(simd: S) {
    operations::<S::Lanes>(simd);
    of_parts::<<S::Lanes as Lane>::Part>(simd);
    of_texels::<<S::Lanes as Lane>::Part>(simd);
    of_packed_texels::<<S::Lanes as Lane>::Part>(simd);
    of_comparisons::<<S::Lanes as Lane>::Part>(simd);
}

#[test]
fn every_operation_is_that_of_plain_numbers_at_every_level() {
    Level::for_each(|_| dispatch!(simd => all(simd)));
    operations::<f32>(());
    of_parts::<f32>(());
    of_texels::<f32>(());
    of_texels::<F64>(());
    of_comparisons::<f32>(());
    of_comparisons::<F64>(());
    of_parts::<F64>(());
}
