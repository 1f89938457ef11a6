//! The weather at hand: a panel that lets the wind change.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, egui};
use bevy_picture_tour::plugin::{TourMotion, TourWeather};

use bevy_picture_tour::wind::HIGHEST_WAVES;

use super::overlay::Overlay;

/// Fastest wind that the panel offers, m/s: a storm.
const FASTEST: f64 = 25.0;

pub(super) fn show(
    mut contexts: EguiContexts,
    overlay: Res<Overlay>,
    mut tours: Query<(&mut TourMotion, &mut TourWeather)>,
) -> Result {
    if !overlay.weather {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let frame = egui::Frame::popup(&context.global_style()).fill(egui::Color32::from_black_alpha(205));
    egui::Area::new("weather".into()).anchor(egui::Align2::RIGHT_TOP, [-12.0, 12.0]).show(context, |ui| {
        frame.show(ui, |ui| {
            ui.visuals_mut().override_text_color = Some(egui::Color32::WHITE);
            for (mut motion, mut weather) in &mut tours {
                let mut wanted = weather.0;
                ui.add(slider(&mut wanted.wind.speed, 0.0..=FASTEST).text("wind, m/s"));
                ui.add(slider(&mut wanted.wind.direction_deg, -180.0..=180.0).text("blows towards, °"));
                ui.add(slider(&mut wanted.wind.gusts, 0.0..=1.0).text("gusts"));
                ui.add(slider(&mut wanted.waves, 0.0..=HIGHEST_WAVES).text("waves, times the wind's"));
                weather.set_if_neq(TourWeather(wanted));
                let mut still = motion.still;
                if ui.checkbox(&mut still, "the still picture").changed() {
                    motion.still = still;
                }
            }
        });
    });
    Ok(())
}

/// A slider that leaves a number beyond its range as it is until it is moved.
fn slider(value: &mut f64, range: std::ops::RangeInclusive<f64>) -> egui::Slider<'_> {
    egui::Slider::new(value, range).clamping(egui::SliderClamping::Edits)
}
