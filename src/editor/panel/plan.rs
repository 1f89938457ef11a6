//! A plan of the scene from above, laid over the tour: where the camera may fly, where it is, and the path.
//!
//! The safe volume is the scene's [`CameraBounds`]: beyond it most of what is shown is made up. Nothing keeps a path inside;
//! what of it lies outside is drawn as a warning.

use glam::{DVec2, DVec3};

use crate::camera::CameraPose;
use crate::scene::{CameraBounds, Role, Surface, TourScene};

use super::super::egui::{
    Align2, CornerRadius, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, pos2, vec2,
};
use super::super::text::with;
use super::super::theme;
use super::super::work::Work;

/// Share of the tour's image that the plan takes, and its largest width, points.
const SHARE: f32 = 0.34;
const WIDEST: f32 = 300.0;
/// Smallest width at which anything can be seen, points.
const NARROWEST: f32 = 110.0;
/// Height over width.
const SHAPE: f32 = 0.8;
/// Room for the camera's height at the right, points.
const HEIGHTS: f32 = 26.0;
/// How far the plan reaches around the nearest billboard's distance: aside, ahead and back, as shares of it.
const ASIDE: f64 = 0.95;
const AHEAD: f64 = 1.25;
const BACK: f64 = 0.25;

/// Draws the plan into the lower left corner of the tour's image.
pub(in super::super) fn plan_ui(ui: &Ui, tour: Rect, work: &Work<'_>) {
    let Some(scene) = work.view.scene else { return };
    let width = (SHARE * tour.width()).min(WIDEST).min(SHARE / SHAPE * tour.height());
    if width < NARROWEST {
        return;
    }
    let corner = tour.left_bottom() + vec2(8.0, -8.0);
    let frame = Rect::from_min_size(corner - vec2(0.0, width * SHAPE), vec2(width, width * SHAPE));
    let painter = ui.painter().with_clip_rect(frame);
    painter.rect_filled(frame, 5.0, theme::BACKDROP.gamma_multiply(0.82));
    let map = Rect { max: frame.max - vec2(HEIGHTS, 0.0), ..frame };
    let plan = Plan::new(map, scene);
    let inside = painter.with_clip_rect(map);
    plan.draw_scene(&inside, scene);
    let keyframes = work.tour.path.as_ref().map_or(&[][..], |path| &path.keyframes);
    let poses: Vec<CameraPose> = keyframes.iter().map(crate::tour::Keyframe::pose).collect();
    plan.draw_path(&inside, &scene.bounds, work, &poses);
    let heights = Rect { min: pos2(map.right(), frame.top()), ..frame };
    draw_heights(&painter.with_clip_rect(heights), heights, &scene.bounds, &poses, work.view.tour.flown);
    if let Some(flown) = work.view.tour.flown {
        plan.draw_camera(&inside, &flown, scene);
    }
    let outside = poses.iter().filter(|pose| !holds(&scene.bounds, pose.position)).count();
    if outside > 0 {
        let words = with(work.text.path.outside, outside);
        let at = frame.left_top() + vec2(6.0, 4.0);
        painter.text(at, Align2::LEFT_TOP, words, FontId::proportional(11.0), theme::ROUGH);
    }
}

/// Whether a camera may stand there.
fn holds(bounds: &CameraBounds, at: DVec3) -> bool {
    at.cmpge(bounds.low).all() && at.cmple(bounds.high).all()
}

/// Where meters are on the plan.
struct Plan {
    rect: Rect,
    /// (x, z) in the middle of its lower edge.
    origin: DVec2,
    points_per_meter: f64,
}

impl Plan {
    fn new(rect: Rect, scene: &TourScene) -> Self {
        let (home, nearest) = (scene.camera.pose.position, scene.bounds.nearest);
        let points_per_meter = (f64::from(rect.width()) / (2.0 * ASIDE * nearest))
            .min(f64::from(rect.height()) / ((AHEAD + BACK) * nearest));
        Self { rect, origin: DVec2::new(home.x, home.z + BACK * nearest), points_per_meter }
    }

    fn at(&self, xz: DVec2) -> Pos2 {
        let offset = (xz - self.origin) * self.points_per_meter;
        pos2(self.rect.center().x + offset.x as f32, self.rect.bottom() + offset.y as f32)
    }

    fn draw_scene(&self, painter: &Painter, scene: &TourScene) {
        let CameraBounds { low, high, .. } = scene.bounds;
        let safe = Rect::from_two_pos(self.at(DVec2::new(low.x, low.z)), self.at(DVec2::new(high.x, high.z)));
        painter.rect_filled(safe, CornerRadius::ZERO, theme::GOOD.gamma_multiply(0.22));
        painter.rect_stroke(safe, CornerRadius::ZERO, Stroke::new(1.0, theme::GOOD), StrokeKind::Middle);
        for component in &scene.components {
            let Surface::Wall(wall) = &component.surface else { continue };
            let color = if component.role == Role::Billboard { theme::OBJECT } else { theme::BACKGROUND };
            let ends = wall.ends().map(|end| self.at(end));
            painter.line_segment(ends, Stroke::new(2.0, color));
        }
    }

    fn draw_path(&self, painter: &Painter, bounds: &CameraBounds, work: &Work<'_>, poses: &[CameraPose]) {
        let way = work.tour.path.as_ref().and_then(crate::tour::CameraPath::way);
        if let Some(way) = way.filter(|_| poses.len() > 1) {
            let steps = 120;
            let at = |step: i32| way.at(way.duration() * f64::from(step) / f64::from(steps)).position;
            let points = (0..=steps).map(|step| self.at(DVec2::new(at(step).x, at(step).z))).collect();
            painter.add(Shape::line(points, Stroke::new(1.5, theme::ACCENT)));
        }
        for pose in poses {
            let at = self.at(DVec2::new(pose.position.x, pose.position.z));
            let color = if holds(bounds, pose.position) { theme::ACCENT } else { theme::ROUGH };
            painter.circle_filled(at, 3.5, color);
        }
    }

    fn draw_camera(&self, painter: &Painter, pose: &CameraPose, scene: &TourScene) {
        let lens = &scene.camera.intrinsics;
        let half = 0.5 * f64::from(lens.size.x) / lens.focal_px;
        let here = DVec2::new(pose.position.x, pose.position.z);
        let ray = |side: f64| {
            let direction = pose.rotation * DVec3::new(side * half, 0.0, -1.0);
            here + DVec2::new(direction.x, direction.z) * scene.bounds.nearest
        };
        for side in [-1.0, 1.0] {
            let sight = [self.at(here), self.at(ray(side))];
            painter.line_segment(sight, Stroke::new(1.0, theme::HORIZON.gamma_multiply(0.5)));
        }
        painter.circle(self.at(here), 4.0, theme::HORIZON, Stroke::new(1.0, theme::BACKDROP));
    }
}

/// The camera's height beside what is allowed, from the water up.
fn draw_heights(
    painter: &Painter,
    rect: Rect,
    bounds: &CameraBounds,
    poses: &[CameraPose],
    flown: Option<CameraPose>,
) {
    let (bottom, top) = (rect.bottom() - 8.0, rect.top() + 18.0);
    let highest = poses.iter().chain(&flown).map(|pose| pose.position.y).fold(1.15 * bounds.high.y, f64::max);
    let y = |height: f64| bottom - (height / highest.max(1e-6)).clamp(0.0, 1.0) as f32 * (bottom - top);
    let x = rect.center().x;
    painter.line_segment([pos2(x - 7.0, bottom), pos2(x + 7.0, bottom)], Stroke::new(1.5, theme::WATER));
    let safe = Rect::from_two_pos(pos2(x - 4.0, y(bounds.low.y)), pos2(x + 4.0, y(bounds.high.y)));
    painter.rect(
        safe,
        CornerRadius::ZERO,
        theme::GOOD.gamma_multiply(0.22),
        Stroke::new(1.0, theme::GOOD),
        StrokeKind::Middle,
    );
    for pose in poses {
        let color = if holds(bounds, pose.position) { theme::ACCENT } else { theme::ROUGH };
        painter.circle_filled(pos2(x, y(pose.position.y)), 2.5, color);
    }
    if let Some(flown) = flown {
        painter.circle_filled(pos2(x, y(flown.position.y)), 4.0, theme::HORIZON);
        let words = format!("{:.1} m", flown.position.y);
        painter.text(
            pos2(x, rect.top() + 4.0),
            Align2::CENTER_TOP,
            words,
            FontId::proportional(9.5),
            theme::DIM,
        );
    }
}
