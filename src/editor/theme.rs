//! The look: a calm dark theme, one color per thing that is marked, and three for how sure something is.

use super::egui::{
    Color32, Context, CornerRadius, FontFamily, FontId, Margin, Stroke, Style, TextStyle, Theme, Visuals,
    vec2,
};

pub(super) const BACKDROP: Color32 = Color32::from_rgb(0x14, 0x17, 0x1b);
pub(super) const PANEL: Color32 = Color32::from_rgb(0x1d, 0x21, 0x27);
pub(super) const CARD: Color32 = Color32::from_rgb(0x26, 0x2b, 0x33);
pub(super) const FIELD: Color32 = Color32::from_rgb(0x32, 0x39, 0x43);
pub(super) const LINE: Color32 = Color32::from_rgb(0x40, 0x48, 0x53);
pub(super) const TEXT: Color32 = Color32::from_rgb(0xd6, 0xdb, 0xe1);
pub(super) const DIM: Color32 = Color32::from_rgb(0x93, 0x9c, 0xa8);
pub(super) const ACCENT: Color32 = Color32::from_rgb(0x5f, 0xa8, 0xd8);

/// Measured, good.
pub(super) const GOOD: Color32 = Color32::from_rgb(0x74, 0xc2, 0x8e);
/// Weak, rough.
pub(super) const ROUGH: Color32 = Color32::from_rgb(0xe2, 0xb4, 0x5e);
/// Assumed, missing, wrong, failed.
pub(super) const BAD: Color32 = Color32::from_rgb(0xdd, 0x7b, 0x6c);

pub(super) const HORIZON: Color32 = Color32::from_rgb(0xf2, 0xd3, 0x6b);
pub(super) const WATER: Color32 = Color32::from_rgb(0x5c, 0xb8, 0xf0);
pub(super) const GROUND: Color32 = Color32::from_rgb(0xb9, 0x9a, 0x6b);
pub(super) const BACKGROUND: Color32 = Color32::from_rgb(0xa6, 0x9c, 0xe0);
pub(super) const SKY: Color32 = Color32::from_rgb(0x9f, 0xcf, 0xe8);
pub(super) const OBJECT: Color32 = Color32::from_rgb(0x8f, 0xd0, 0x7a);
pub(super) const PAIR: Color32 = Color32::from_rgb(0xf0, 0x92, 0xc0);
pub(super) const HALO: Color32 = Color32::from_rgba_premultiplied(0, 0, 0, 0x90);

/// Smallest side of anything that is clicked or touched, points.
pub(super) const TARGET: f32 = 26.0;

/// Gives a context the studio's look. [`studio_ui`](super::studio_ui) does it once; a game that has a look of its own may
/// put that back afterwards.
pub fn apply_theme(context: &Context) {
    context.set_theme(Theme::Dark);
    context.set_style_of(Theme::Dark, style());
}

fn style() -> Style {
    let mut style = Style { visuals: visuals(), ..Style::default() };
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(8.0, 7.0);
    spacing.button_padding = vec2(9.0, 4.0);
    spacing.interact_size = vec2(44.0, TARGET);
    spacing.icon_width = 17.0;
    spacing.indent = 16.0;
    spacing.menu_margin = Margin::same(8);
    spacing.scroll.floating = false;
    spacing.scroll.bar_width = 7.0;
    style.text_styles = [
        (TextStyle::Heading, 17.0, FontFamily::Proportional),
        (TextStyle::Body, 13.5, FontFamily::Proportional),
        (TextStyle::Button, 13.5, FontFamily::Proportional),
        (TextStyle::Small, 11.5, FontFamily::Proportional),
        (TextStyle::Monospace, 12.5, FontFamily::Monospace),
    ]
    .into_iter()
    .map(|(style, size, family)| (style, FontId::new(size, family)))
    .collect();
    style.interaction.selectable_labels = false;
    style
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = PANEL;
    visuals.window_fill = PANEL;
    visuals.window_stroke = Stroke::new(1.0, LINE);
    visuals.extreme_bg_color = BACKDROP;
    visuals.faint_bg_color = CARD;
    visuals.override_text_color = Some(TEXT);
    visuals.weak_text_color = Some(DIM);
    visuals.warn_fg_color = ROUGH;
    visuals.error_fg_color = BAD;
    visuals.hyperlink_color = ACCENT;
    visuals.selection.bg_fill = ACCENT.gamma_multiply(0.45);
    visuals.selection.stroke = Stroke::new(1.0, TEXT);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, LINE);
    widgets.inactive.bg_fill = LINE;
    widgets.inactive.weak_bg_fill = FIELD;
    widgets.hovered.weak_bg_fill = FIELD.lerp_to_gamma(ACCENT, 0.25);
    widgets.active.weak_bg_fill = ACCENT.gamma_multiply(0.5);
    for state in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        state.corner_radius = CornerRadius::same(5);
    }
    visuals
}
