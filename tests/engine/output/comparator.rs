//! The comparator of pictures fails when it must: no difference is too small, none is hidden.

use drape::output::compare::{Allowed, Budget, Difference, difference_picture, triptych};
use drape::output::png::Pixels;
use proptest::prelude::*;

/// A picture without symmetry: every pixel differs from its neighbours.
fn picture(width: u32, height: u32) -> Pixels {
    let pixel = |i: u64| {
        let [r, g, b, ..] = drape::math::splitmix64(i).to_le_bytes();
        [r, g, b, 255]
    };
    Pixels { width, height, rgba: (0..u64::from(width * height)).map(pixel).collect() }
}

/// `picture` with `change` made to one pixel.
fn changed(picture: &Pixels, index: usize, change: impl Fn(&mut [u8; 4])) -> Pixels {
    let mut other = picture.clone();
    change(&mut other.rgba[index]);
    other
}

fn budgets(texts: &[&str]) -> Vec<Budget> {
    texts.iter().map(|text| text.parse().expect("a budget")).collect()
}

#[test]
fn a_picture_equals_itself() {
    let a = picture(13, 7);
    let difference = Difference::between(&a, &a.clone());
    assert_eq!((difference.differing(), difference.max(), difference.rmse), (0, 0, 0.0));
    assert_eq!(difference.pixels(), 91);
    assert!(difference.is_within(&[]));
}

#[test]
fn one_level_in_one_channel_of_one_pixel_is_found_wherever_it_is() {
    let a = picture(13, 7);
    for index in 0..a.rgba.len() {
        for channel in 0..4 {
            let b = changed(&a, index, |pixel| pixel[channel] ^= 1);
            let difference = Difference::between(&a, &b);
            assert_eq!((difference.differing(), difference.max()), (1, 1), "{index} {channel}");
            assert!(difference.rmse > 0.0);
            assert!(!difference.is_within(&[]));
        }
    }
}

#[test]
fn alpha_alone_is_a_difference_and_is_seen_in_the_picture() {
    let a = picture(4, 4);
    let b = changed(&a, 5, |pixel| pixel[3] = 0);
    let difference = Difference::between(&a, &b);
    assert_eq!(difference.histogram().collect::<Vec<_>>(), [(255, 1)]);
    let shown = difference_picture(&a, &b);
    assert_eq!(shown.rgba[5], [255, 255, 255, 255]);
    assert_eq!(shown.rgba.iter().filter(|pixel| pixel[0] > 0).count(), 1);
}

#[test]
fn a_shift_by_one_pixel_is_a_difference() {
    let a = picture(16, 16);
    for shift in [1, 16] {
        let mut b = a.clone();
        b.rgba.rotate_right(shift);
        assert!(Difference::between(&a, &b).differing() > 250, "shift by {shift}");
    }
}

#[test]
fn pictures_of_different_sizes_differ_everywhere() {
    let a = picture(6, 4);
    for (width, height) in [(4, 6), (6, 5), (5, 4), (1, 1)] {
        let b = Pixels {
            width,
            height,
            rgba: a.rgba.iter().copied().cycle().take((width * height) as usize).collect(),
        };
        let difference = Difference::between(&a, &b);
        let all = u64::from(width.max(6) * height.max(4));
        assert_eq!((difference.differing(), difference.pixels()), (all, all));
        assert_eq!((difference.max(), difference.rmse), (255, 255.0));
        assert!(!difference.is_within(&budgets(&["254:1000000"])));
        assert!(difference_picture(&a, &b).rgba.iter().all(|pixel| *pixel == [255; 4]));
    }
}

#[test]
fn swapped_pictures_give_the_same_numbers_and_another_triptych() {
    let (a, b) = (picture(9, 5), changed(&picture(9, 5), 3, |pixel| pixel[0] ^= 0x80));
    assert_eq!(Difference::between(&a, &b), Difference::between(&b, &a));
    let sheet = triptych(&a, &b);
    assert_ne!(sheet, triptych(&b, &a));
    assert_eq!((sheet.width, sheet.height), (9 * 3 + 8, 5));
    let column = |sheet: &Pixels, left: usize| -> Vec<[u8; 4]> {
        sheet.rgba.chunks_exact(sheet.width as usize).flat_map(|row| row[left..left + 9].to_vec()).collect()
    };
    assert_eq!(column(&sheet, 0), a.rgba, "expected stands on the left");
    assert_eq!(column(&sheet, 13), difference_picture(&a, &b).rgba);
    assert_eq!(column(&sheet, 26), b.rgba, "actual stands on the right");
}

#[test]
fn budgets_count_per_band_of_magnitudes() {
    let a = Pixels { width: 10, height: 1, rgba: vec![[100, 100, 100, 255]; 10] };
    let mut b = a.clone();
    for (index, off) in [1, 5, 5, 6].into_iter().enumerate() {
        b.rgba[index][1] += off;
    }
    let difference = Difference::between(&a, &b);
    for (texts, within) in [
        (vec![], false),
        (vec!["5:3", "6:1"], true),
        (vec!["6:1", "5:3"], true),
        (vec!["5:2", "6:1"], false),
        (vec!["5:3", "6:0"], false),
        (vec!["5:3"], false),
        (vec!["6:4"], true),
        (vec!["6:3"], false),
        (vec!["255:4"], true),
        (vec!["4:4", "255:3"], true),
        // A band's spare allowance is no allowance for the next band.
        (vec!["5:100", "255:0"], false),
    ] {
        assert_eq!(difference.is_within(&budgets(&texts)), within, "{texts:?}");
    }
    assert_eq!(difference.histogram().collect::<Vec<_>>(), [(1, 1), (5, 2), (6, 1)]);
}

#[test]
fn budgets_that_make_no_sense_are_refused() {
    for text in [
        "", "5", ":", "5:", ":5", "0:5", "256:1", "-1:1", "5:-1", "5:1:1", "5:x", "5.0:1", "%", "5:%", "-1%",
        "101%", "NaN%",
    ] {
        assert!(text.parse::<Budget>().is_err(), "{text}");
    }
    assert_eq!("255:0".parse(), Ok(Budget { magnitude: 255, count: Allowed::Pixels(0) }));
    assert_eq!("0.5%".parse(), Ok(Budget { magnitude: 255, count: Allowed::Percent(0.5) }));
    assert_eq!("3:2%".parse(), Ok(Budget { magnitude: 3, count: Allowed::Percent(2.0) }));
}

#[test]
fn a_percentage_is_of_the_pixels_that_are_compared() {
    let a = Pixels { width: 10, height: 20, rgba: vec![[0, 0, 0, 255]; 200] };
    let b = changed(&changed(&a, 0, |pixel| pixel[0] = 9), 1, |pixel| pixel[1] = 3);
    let all = Difference::between(&a, &b);
    assert!(all.is_within(&budgets(&["1%"])) && !all.is_within(&budgets(&["0.99%"])));
    assert!(all.is_within(&budgets(&["3:0.5%", "9:0.5%"])) && !all.is_within(&budgets(&["3:1%"])));
    // Of the first hundred alone, two are more than one percent.
    let part = Difference::between_where(&a, &b, |i| i < 100);
    assert_eq!((part.pixels(), part.differing()), (100, 2));
    assert!(part.is_within(&budgets(&["2%"])) && !part.is_within(&budgets(&["1.9%"])));
    let rest = Difference::between_where(&a, &b, |i| i >= 2);
    assert!(rest.is_within(&[]) && rest.rmse == 0.0);
    let joined = Difference::joined(&[part.clone(), rest]);
    assert_eq!((joined.pixels(), joined.differing(), joined.max()), (298, 2, 9));
    assert!((joined.rmse - (90.0_f64 / 3.0 / 298.0).sqrt()).abs() < 1e-15, "{}", joined.rmse);
}

#[test]
fn the_root_mean_square_is_over_colour_and_over_alpha_only_where_there_is_some() {
    let a = Pixels { width: 2, height: 1, rgba: vec![[0, 0, 0, 255]; 2] };
    let b = changed(&a, 0, |pixel| pixel[0] = 6);
    // sqrt(36 / 6 channels), then sqrt((36 + 36) / 8 channels).
    assert!((Difference::between(&a, &b).rmse - 6.0_f64.sqrt()).abs() < 1e-15);
    let c = changed(&b, 1, |pixel| pixel[3] = 249);
    assert!((Difference::between(&a, &c).rmse - 3.0).abs() < 1e-15);
}

proptest! {
    #[test]
    fn only_equal_pictures_are_equal(
        (width, height) in (1_u32..8, 1_u32..8),
        index in any::<prop::sample::Index>(),
        flip in any::<[u8; 4]>(),
    ) {
        let a = picture(width, height);
        let b = changed(&a, index.index(a.rgba.len()), |pixel| {
            for (channel, bits) in pixel.iter_mut().zip(flip) {
                *channel ^= bits;
            }
        });
        let difference = Difference::between(&a, &b);
        prop_assert_eq!(difference.differing() == 0, a == b);
        prop_assert_eq!(difference.is_within(&[]), a == b);
        prop_assert_eq!(difference.rmse == 0.0, a == b);
        prop_assert_eq!(difference_picture(&a, &b).rgba.iter().any(|pixel| pixel[0] > 0), a != b);
    }
}
