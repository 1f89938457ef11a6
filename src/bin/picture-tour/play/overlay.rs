//! What the window says: the keys, and messages that fade.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, egui};

/// What is shown over the tour.
#[derive(Resource, Debug, Default)]
pub(super) struct Overlay {
    /// Whether the keys are shown.
    pub help: bool,
    /// Whether the weather can be changed.
    pub weather: bool,
    message: String,
    /// Problems stay until they are mended.
    pub problem: Option<String>,
    seconds_left: f32,
}

/// How long a message stays, seconds.
const MESSAGE_SECONDS: f32 = 5.0;

const KEYS: [(&str, &str); 12] = [
    ("drag, one finger", "look around and lean; on the water, stir it"),
    ("right drag", "look around, on the water too"),
    ("wheel, pinch", "step in or back"),
    ("W A S D, arrows", "walk"),
    ("Q E, page keys", "down, up"),
    ("Home", "glide back to where the picture was taken"),
    ("P", "the tour's own path"),
    ("Space", "stop everything, and go on"),
    ("V", "wind and weather"),
    ("F", "free flight"),
    ("drop a .tour.ron", "open another tour"),
    ("H, Esc", "these keys; quit"),
];

impl Overlay {
    /// Shows a message for some seconds.
    pub(super) fn say(&mut self, message: impl Into<String>) {
        self.message = message.into();
        self.seconds_left = MESSAGE_SECONDS;
    }
}

pub(super) fn show(mut contexts: EguiContexts, mut overlay: ResMut<Overlay>, time: Res<Time>) -> Result {
    let context = contexts.ctx_mut()?;
    overlay.seconds_left -= time.delta_secs();
    let frame = egui::Frame::popup(&context.global_style()).fill(egui::Color32::from_black_alpha(205));
    if overlay.help {
        egui::Area::new("keys".into()).anchor(egui::Align2::LEFT_TOP, [12.0, 12.0]).show(context, |ui| {
            frame.show(ui, |ui| {
                ui.visuals_mut().override_text_color = Some(egui::Color32::WHITE);
                egui::Grid::new("keys").num_columns(2).spacing([18.0, 6.0]).show(ui, |ui| {
                    for (key, does) in KEYS {
                        ui.strong(key);
                        ui.label(does);
                        ui.end_row();
                    }
                });
            });
        });
    }
    let message = overlay.problem.as_deref().or((overlay.seconds_left > 0.0).then_some(&overlay.message));
    if let Some(message) = message.filter(|message| !message.is_empty()) {
        egui::Area::new("message".into())
            .anchor(egui::Align2::CENTER_BOTTOM, [0.0, -16.0])
            .interactable(false)
            .show(context, |ui| {
                frame.show(ui, |ui| {
                    ui.set_max_width(820.0);
                    ui.visuals_mut().override_text_color = Some(egui::Color32::WHITE);
                    ui.label(message);
                });
            });
    }
    Ok(())
}
