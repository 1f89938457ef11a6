//! The studio: panels and a picture canvas in plain egui, which turn what a user does into [`Request`]s.
//!
//! [`studio_ui`] is a function of three things: where to draw, the user interface's own state ([`Studio`]), and what is
//! known this frame ([`View`]). It changes no document, opens no file and asks no clock: whoever calls it carries out the
//! requests in their order. All texts are in `text`, all colors in `theme`.

mod canvas;
mod dialog;
mod field;
mod lamp;
mod out;
mod panel;
mod rail;
mod report_words;
mod screen;
mod session;
mod shortcuts;
mod status;
mod studio;
mod text;
mod theme;
mod top_bar;
mod view;
mod work;

/// The egui that [`studio_ui`] draws with; the one line that says where it comes from.
pub use bevy_egui::egui;

pub use canvas::{Canvas, Handle, Tool};
pub use lamp::{Lamp, Need, StepState, step_state};
pub use out::{BrushStroke, Out, Request, SuggestWhat};
pub use screen::studio_ui;
pub use session::{EditorPlugin, Pace, Session};
pub use studio::{Brush, Layout, Step, Studio};
pub use text::Language;
pub use theme::apply_theme;
pub use view::{DeskView, Ghost, MaskView, Message, PictureView, Question, Suggestion, Task, TourView, View};

#[cfg(test)]
mod tests;
