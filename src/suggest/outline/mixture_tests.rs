//! Facts about mixtures of colors at their places.

use super::*;

/// Two clouds of 500 colors, around (0.2, 0.2, 0.2) and (0.8, 0.5, 0.2), both all over a square.
fn clouds() -> Vec<Sample> {
    let mut random = Random::new(7, 0);
    let middles = [[0.2; 3], [0.8, 0.5, 0.2]];
    let sample = |i: usize| {
        let [x, y] = [i % 25, i / 25].map(|at| at as f32 / 40.0);
        let color: [f32; 3] = std::array::from_fn(|k| middles[i % 2][k] + 0.1 * (random.unit() as f32 - 0.5));
        [x, y, color[0], color[1], color[2]]
    };
    (0..1000).map(sample).collect()
}

#[test]
fn a_color_is_cheap_where_it_is_common() {
    let samples = clouds();
    let of_side = |side: usize| {
        Mixture::clustered(&samples, 5, 1, |cell| f32::from(u8::from(cell % 2 == side))).unwrap()
    };
    let [first, second] = [of_side(0), of_side(1)];
    for (i, sample) in samples.iter().enumerate() {
        let [own, other] = if i % 2 == 0 { [&first, &second] } else { [&second, &first] };
        assert!(own.cheapest(sample).1 + 10.0 < other.cheapest(sample).1, "sample {i}");
    }
}

#[test]
fn the_same_color_costs_more_where_it_was_not_seen() {
    // Dark above and bright below; a place that was not seen between two dark ones is expected to be dark.
    let sample = |i: usize| {
        let [x, y] = [i % 20, i / 20].map(|at| at as f32 / 20.0);
        let value = if y < 0.5 { 0.2 } else { 0.8 } + 0.01 * (i % 7) as f32;
        [x, y, value, value, value]
    };
    let samples: Vec<Sample> = (0..400).map(sample).collect();
    let is_seen = |cell: usize| !(5..15).contains(&(cell % 20));
    let mixture = Mixture::clustered(&samples, 6, 1, |cell| f32::from(u8::from(is_seen(cell)))).unwrap();
    let cost = |y: f32, value: f32| mixture.cheapest(&[0.5, y, value, value, value]).1;
    assert!(cost(0.1, 0.22) + 2.0 < cost(0.1, 0.82), "{} {}", cost(0.1, 0.22), cost(0.1, 0.82));
    assert!(cost(0.9, 0.82) + 2.0 < cost(0.9, 0.22), "{} {}", cost(0.9, 0.82), cost(0.9, 0.22));
}

#[test]
fn a_weight_counts_as_so_many_samples() {
    let samples = [[0.0; 5], [0.3; 5], [0.3; 5], [0.3; 5]];
    let thrice = Mixture::fit(&samples[..2], |cell| Some((0, [1.0, 3.0][cell]))).unwrap();
    let listed = Mixture::fit(&samples, |_| Some((0, 1.0))).unwrap();
    let [a, b] = [&thrice, &listed].map(|mixture| mixture.cheapest(&[0.1; 5]).1);
    assert!((a - b).abs() < 1e-4, "{a} {b}");
}

#[test]
fn one_color_is_no_singularity_and_none_is_no_mixture() {
    let same = [[0.5; 5]; 40];
    let mixture = Mixture::clustered(&same, 5, 1, |_| 1.0).unwrap();
    assert!(mixture.cheapest(&[0.5; 5]).1.is_finite());
    assert!(mixture.cheapest(&[0.5; 5]).1 + 100.0 < mixture.cheapest(&[0.5, 0.5, 0.6, 0.6, 0.6]).1);
    assert!(Mixture::clustered(&same, 5, 1, |_| 0.0).is_none());
}
