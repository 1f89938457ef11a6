//! Step 6, second part: the wind over everything, and the waves.

use std::ops::RangeInclusive;

use crate::tour::edit::Edit;
use crate::tour::{Jonswap, Octaves, Sea, Waves};
use crate::water::sea::fetch;

use super::super::Out;
use super::super::egui::Ui;
use super::super::field::{self, Number};
use super::super::text::Text;
use super::super::work::Work;

/// Shows wind and waves.
pub(super) fn weather_ui(ui: &mut Ui, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    field::title(ui, t.motion.wind);
    ui.push_id("wind", |ui| field::card(ui, |ui| wind_ui(ui, work, out)));
    field::title(ui, t.motion.waves);
    ui.push_id("waves", |ui| field::card(ui, |ui| waves_ui(ui, work, out)));
}

fn wind_ui(ui: &mut Ui, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let wind = work.tour.wind;
    let mut wanted = wind;
    let rows: [(&mut f64, Number<'_>); 4] = [
        (
            &mut wanted.speed,
            Number::new(t.motion.wind_speed, 0.0..=60.0).logarithmic().unit(" m/s").decimals(1),
        ),
        (&mut wanted.direction_deg, direction(t.motion.direction, t.motion.direction_hint)),
        (&mut wanted.gusts, Number::new(t.motion.gusts, 0.0..=1.0)),
        (&mut wanted.period_seconds, Number::new(t.motion.period, 4.0..=120.0).unit(" s").decimals(0)),
    ];
    for (value, number) in rows {
        if let Some(new) = number.slide(ui, *value) {
            *value = new;
        }
    }
    let seed = Number::new(t.motion.seed, 0.0..=1e6).decimals(0).speed(0.2).hint(t.motion.seed_hint);
    if let Some(seed) = seed.show(ui, wind.seed as f64) {
        wanted.seed = seed.round() as u64;
    }
    if wanted != wind {
        out.edit(Edit::Wind(wanted));
    }
}

/// A direction on the water, degrees.
fn direction<'a>(name: &'a str, hint: &'a str) -> Number<'a> {
    Number::new(name, -180.0..=360.0).unit("°").decimals(0).hint(hint)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Calm,
    Octaves,
    Jonswap,
    Recorded,
}

fn waves_ui(ui: &mut Ui, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let waves = &work.tour.waves;
    let set = |out: &mut Out, sea| out.edit(Edit::Waves(Waves { sea, ..waves.clone() }));
    let kind = match waves.sea {
        Sea::Calm => Kind::Calm,
        Sea::Octaves(_) => Kind::Octaves,
        Sea::Jonswap(_) => Kind::Jonswap,
        Sea::Recorded(_) => Kind::Recorded,
    };
    let kinds = [
        (Kind::Calm, t.motion.calm),
        (Kind::Octaves, t.motion.octaves),
        (Kind::Jonswap, t.motion.jonswap),
        (Kind::Recorded, t.motion.recorded),
    ];
    // A recording is made elsewhere; it can be kept or left.
    let kinds = if kind == Kind::Recorded { &kinds[..] } else { &kinds[..3] };
    match field::choice(ui, "sea", t.motion.sea, kind, kinds) {
        Some(Kind::Calm) => set(out, Sea::Calm),
        Some(Kind::Octaves) => set(out, Sea::Octaves(Octaves::default())),
        Some(Kind::Jonswap) => set(out, Sea::Jonswap(Jonswap::default())),
        Some(Kind::Recorded) | None => {}
    }
    match &waves.sea {
        Sea::Octaves(octaves) => {
            let wanted = octaves_ui(ui, *octaves, work);
            if wanted != *octaves {
                set(out, Sea::Octaves(wanted));
            }
        }
        Sea::Jonswap(jonswap) => {
            let wanted = jonswap_ui(ui, *jonswap, work);
            if wanted != *jonswap {
                set(out, Sea::Jonswap(wanted));
            }
        }
        Sea::Calm | Sea::Recorded(_) => {}
    }
    if let Some(ripples) = field::tick(ui, t.motion.ripples, waves.ripples) {
        out.edit(Edit::Waves(Waves { ripples, ..waves.clone() }));
    }
}

/// A number that the wind sets unless it is given.
fn own<'a>(t: &'a Text, name: &'a str, range: RangeInclusive<f64>) -> Number<'a> {
    Number::new(name, range).hint(t.motion.own_number_hint)
}

/// The waves' height: mostly a few centimeters.
fn wave_height(t: &Text) -> Number<'_> {
    own(t, t.motion.wave_height, 0.0..=10.0).logarithmic().unit(" m").decimals(3)
}

fn octaves_ui(ui: &mut Ui, octaves: Octaves, work: &Work<'_>) -> Octaves {
    let t = work.text;
    let mut wanted = octaves;
    let (height, longest) = fetch::of_octaves(&octaves, &work.tour.wind);
    let rows: [(&mut Option<f64>, Number<'_>, f64); 3] = [
        (&mut wanted.max_height, wave_height(t), height),
        (&mut wanted.wavelength, own(t, t.motion.wavelength, 0.1..=300.0).logarithmic().unit(" m"), longest),
        (
            &mut wanted.direction_deg,
            direction(t.motion.direction, t.motion.direction_hint),
            work.tour.wind.direction_deg,
        ),
    ];
    for (value, number, usual) in rows {
        if let Some(new) = number.optional(ui, *value, usual) {
            *value = new;
        }
    }
    if let Some(count) =
        Number::new(t.motion.octave_count, 1.0..=12.0).decimals(0).slide(ui, octaves.octaves.into())
    {
        wanted.octaves = count.round() as u32;
    }
    if let Some(factor) =
        Number::new(t.motion.wave_speed, 0.0..=4.0).unit("×").slide(ui, octaves.speed_factor)
    {
        wanted.speed_factor = factor;
    }
    wanted
}

fn jonswap_ui(ui: &mut Ui, jonswap: Jonswap, work: &Work<'_>) -> Jonswap {
    let t = work.text;
    let mut wanted = jonswap;
    let (height, period) = fetch::of_jonswap(&jonswap, &work.tour.wind);
    let rows: [(&mut Option<f64>, Number<'_>, f64); 3] = [
        (&mut wanted.max_height, wave_height(t), height),
        (&mut wanted.peak_period_seconds, own(t, t.motion.peak_period, 0.3..=20.0).unit(" s"), period),
        (
            &mut wanted.direction_deg,
            direction(t.motion.direction, t.motion.direction_hint),
            work.tour.wind.direction_deg,
        ),
    ];
    for (value, number, usual) in rows {
        if let Some(new) = number.optional(ui, *value, usual) {
            *value = new;
        }
    }
    let depth = Number::new(t.motion.water_depth, 0.05..=10_000.0).logarithmic().unit(" m");
    if let Some(depth) = depth.slide(ui, jonswap.depth) {
        wanted.depth = depth;
    }
    if let Some(spreading) =
        Number::new(t.motion.spreading, 1.0..=30.0).decimals(1).slide(ui, jonswap.spreading)
    {
        wanted.spreading = spreading;
    }
    wanted
}
