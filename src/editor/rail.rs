//! The rail of the six steps: number, name and lamp of each, side by side.

use super::egui::{
    Align2, Color32, FontId, Label, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, WidgetType, pos2,
    vec2,
};
use super::text::Text;
use super::work::Work;
use super::{Lamp, Step, StepState, Studio, step_state, theme};

/// Height of the rail, points.
const HEIGHT: f32 = 44.0;

impl Step {
    /// The step's name.
    pub(super) fn name(self, t: &Text) -> &'static str {
        match self {
            Self::Horizon => t.step.horizon,
            Self::Water => t.step.water,
            Self::Ground => t.step.ground,
            Self::Objects => t.step.objects,
            Self::Pairs => t.step.pairs,
            Self::Motion => t.step.motion,
        }
    }

    /// One sentence of what to do.
    pub(super) fn task(self, t: &Text) -> &'static str {
        match self {
            Self::Horizon => t.step.horizon_task,
            Self::Water => t.step.water_task,
            Self::Ground => t.step.ground_task,
            Self::Objects => t.step.objects_task,
            Self::Pairs => t.step.pairs_task,
            Self::Motion => t.step.motion_task,
        }
    }
}

/// A step's lamp and needs, of a draft.
pub(super) fn state_of(step: Step, work: &Work<'_>) -> StepState {
    step_state(step, work.tour, work.view.problems, work.solution(), work.size.x)
}

/// Shows the rail.
pub(super) fn rail_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>) {
    let gap = 4.0;
    let count = Step::ALL.len() as f32;
    let width = ((ui.available_width() - gap * (count - 1.0)) / count).floor().max(60.0);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        for (index, step) in Step::ALL.into_iter().enumerate() {
            let lamp = state_of(step, work).lamp;
            if step_ui(ui, index + 1, step, lamp, step == studio.step, width, work.text) {
                studio.go_to(step);
            }
        }
    });
}

/// One step; whether it was clicked.
fn step_ui(ui: &mut Ui, number: usize, step: Step, lamp: Lamp, is_open: bool, width: f32, t: &Text) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click());
    let name = step.name(t);
    // The lamp's color alone would not do for everybody.
    let label = format!("{number} {name}: {}", lamp.word(t));
    response.widget_info(|| WidgetInfo::selected(WidgetType::SelectableLabel, true, is_open, &label));
    let fill = match (is_open, response.hovered()) {
        (true, _) => theme::CARD,
        (_, true) => theme::CARD.gamma_multiply(0.6),
        _ => Color32::TRANSPARENT,
    };
    let painter = ui.painter();
    painter.rect_filled(rect, 6.0, fill);
    if is_open {
        let bar = rect.with_min_y(rect.bottom() - 3.0).shrink2(vec2(6.0, 0.0));
        painter.rect_filled(bar, 1.5, theme::ACCENT);
    }
    if response.has_focus() {
        painter.rect_stroke(rect, 6.0, Stroke::new(1.0, theme::ACCENT), StrokeKind::Inside);
    }
    let center = rect.left_center() + vec2(16.0, 0.0);
    match lamp {
        Lamp::Missing => painter.circle_stroke(center, 6.0, Stroke::new(2.0, lamp.color())),
        Lamp::Rough | Lamp::Good => painter.circle_filled(center, 6.5, lamp.color()),
    };
    if lamp == Lamp::Good {
        let tick = vec![center + vec2(-3.0, 0.0), center + vec2(-0.8, 2.4), center + vec2(3.2, -2.6)];
        painter.line(tick, Stroke::new(1.6, theme::BACKDROP));
    }
    let color = if is_open { theme::TEXT } else { theme::DIM };
    let text_left = rect.left() + 31.0;
    let font = TextStyle::Body.resolve(ui.style());
    let galley = painter.layout(format!("{number}  {name}"), font, color, rect.right() - 4.0 - text_left);
    let at = pos2(text_left, rect.center().y - galley.size().y / 2.0);
    painter.with_clip_rect(rect).galley(at, galley, color);
    response.on_hover_text(label).clicked()
}

/// The open step's title, sentence and needs.
pub(super) fn step_head_ui(ui: &mut Ui, step: Step, work: &Work<'_>) {
    let t = work.text;
    let StepState { lamp, needs } = state_of(step, work);
    ui.horizontal(|ui| {
        ui.heading(step.name(t));
        let (rect, _) = ui.allocate_exact_size(vec2(8.0, 8.0), Sense::hover());
        ui.painter().circle_filled(rect.center(), 4.0, lamp.color());
        ui.colored_label(lamp.color(), lamp.word(t));
    });
    ui.label(step.task(t));
    for need in &needs {
        ui.horizontal_top(|ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(10.0, 18.0), Sense::hover());
            let font = FontId::proportional(13.0);
            ui.painter().text(rect.center(), Align2::CENTER_CENTER, "›", font, lamp.color());
            ui.add(Label::new(need.sentence(t)).wrap());
        });
    }
    if let (Step::Pairs | Step::Horizon, Some(error)) = (step, work.solve_error()) {
        ui.colored_label(theme::BAD, super::report_words::sentence(&error.to_string()));
    }
}
