//! The state of the user interface itself: what is shown and selected. Nothing of it is in a tour's file.

use super::canvas::{Canvas, Tool};
use super::text::Language;

/// The six steps, in their order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Step {
    /// The horizon, the principal point and the known length.
    #[default]
    Horizon,
    /// Where water is visible.
    Water,
    /// Ground, background, bands and sky.
    Ground,
    /// What stands in the scene.
    Objects,
    /// Points and their reflections; the solver's report.
    Pairs,
    /// Wind, waves, motion of objects and the camera's path.
    Motion,
}

impl Step {
    /// All of them, in their order.
    pub const ALL: [Self; 6] =
        [Self::Horizon, Self::Water, Self::Ground, Self::Objects, Self::Pairs, Self::Motion];
}

/// Which halves of the window are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Picture and tour.
    #[default]
    Split,
    /// The picture alone.
    Picture,
    /// The tour alone.
    Tour,
}

/// The brush that paints on masks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Half its width, picture pixels.
    pub radius: f64,
    /// 0 (soft) to 1 (hard).
    pub hardness: f64,
    /// Whether it paints; otherwise it erases.
    pub inside: bool,
}

impl Default for Brush {
    fn default() -> Self {
        Self { radius: 12.0, hardness: 0.7, inside: true }
    }
}

/// What the user interface remembers from frame to frame.
#[derive(Debug)]
pub struct Studio {
    /// The language of all texts.
    pub language: Language,
    /// The step at work.
    pub step: Step,
    /// What is shown.
    pub layout: Layout,
    /// The picture's canvas: zoom, tool, selection, drag.
    pub canvas: Canvas,
    /// The selected object; may be gone.
    pub object: Option<usize>,
    /// The brush.
    pub brush: Brush,
    /// Whether outlines cling to edges of the picture while they are drawn.
    pub live_wire: bool,
    /// Whether dragged points snap to others.
    pub snapping: bool,
    /// Whether residuals are drawn ten times their length.
    pub residuals_tenfold: bool,
    /// Whether the tour moves in the preview.
    pub motion_preview: bool,
    /// Whether a plan of where the camera may fly is drawn over the tour while the path is at work.
    pub safe_volume: bool,
    /// Where the path's time line stands, seconds.
    pub path_seconds: f64,
    pub(super) in_gesture: bool,
    pub(super) gesture_canceled: bool,
    pub(super) is_themed: bool,
    pub(super) pointer_was_over_tour: bool,
}

impl Default for Studio {
    fn default() -> Self {
        Self {
            language: Language::default(),
            step: Step::default(),
            layout: Layout::default(),
            canvas: Canvas::default(),
            object: None,
            brush: Brush::default(),
            live_wire: true,
            snapping: true,
            residuals_tenfold: false,
            motion_preview: true,
            safe_volume: true,
            path_seconds: 0.0,
            in_gesture: false,
            gesture_canceled: false,
            is_themed: false,
            pointer_was_over_tour: false,
        }
    }
}

impl Studio {
    /// Lays down what belongs to the document that was open before.
    pub fn begin(&mut self) {
        self.canvas = Canvas::default();
        (self.object, self.path_seconds) = (None, 0.0);
    }

    /// Goes to a step; what was half drawn or selected in another one is let go.
    pub fn go_to(&mut self, step: Step) {
        if step != self.step {
            self.step = step;
            self.canvas.let_go();
        }
    }

    /// Takes a tool into the hand, or lays it down when it is there already.
    pub fn take(&mut self, tool: Tool) {
        let tool = if self.canvas.tool == tool { Tool::Select } else { tool };
        self.canvas.let_go();
        self.canvas.tool = tool;
        // Strokes begin on what is meant.
        self.brush.inside = true;
    }
}
