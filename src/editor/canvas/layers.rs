//! The marks of a draft as shapes on the screen: functions of what is to be seen, without any state.
//!
//! Lines have a dark halo, so that they show on bright and dark parts of a picture alike.

use glam::DVec2;

use crate::picture::PicturePoint;
use crate::tour::edit::{LineAt, PlaceAt, RegionAt};
use crate::tour::{Motion, Region, Scale};

use super::super::egui::epaint::PathStroke;
use super::super::egui::{Color32, Pos2, Shape, Stroke, Vec2};
use super::super::work::Work;
use super::super::{Ghost, Step, theme};
use super::expected::expected_reflection;
use super::frame::Frame;
use super::handle::lines;

/// A line with its halo.
pub(super) fn line(points: &[Pos2], closed: bool, color: Color32, width: f32) -> [Shape; 2] {
    let shape = |stroke: PathStroke| {
        if closed {
            Shape::closed_line(points.to_vec(), stroke)
        } else {
            Shape::line(points.to_vec(), stroke)
        }
    };
    let halo = theme::HALO.gamma_multiply(f32::from(color.a()) / 255.0);
    [shape(PathStroke::new(width + 2.0, halo)), shape(PathStroke::new(width, color))]
}

fn dashed(points: &[Pos2], color: Color32) -> Vec<Shape> {
    Shape::dashed_line(points, Stroke::new(1.5, color), 7.0, 5.0)
}

fn on_screen(frame: Frame, points: &[PicturePoint]) -> Vec<Pos2> {
    points.iter().map(|point| frame.to_screen(*point)).collect()
}

/// The color of a line with corners.
pub(super) fn line_color(at: LineAt) -> Color32 {
    match at {
        LineAt::Region(RegionAt::Water) => theme::WATER,
        LineAt::Region(RegionAt::Ground) => theme::GROUND,
        LineAt::Region(RegionAt::Sky) => theme::SKY,
        LineAt::Region(RegionAt::Band(_)) | LineAt::Place(_) => theme::BACKGROUND,
        LineAt::Region(RegionAt::Object(_)) => theme::OBJECT,
    }
}

/// All outlines and contact lines; those of the step stand out.
pub(super) fn outlines(frame: Frame, step: Step, object: Option<usize>, work: &Work<'_>) -> Vec<Shape> {
    let active = lines(step, object, work);
    let bands = 0..work.tour.background.bands.len();
    let regions = [RegionAt::Water, RegionAt::Ground, RegionAt::Sky].into_iter();
    let regions = regions.chain(bands.clone().map(RegionAt::Band));
    let regions = regions.chain((0..work.tour.objects.len()).map(RegionAt::Object)).map(LineAt::Region);
    let places = [PlaceAt::Background].into_iter().chain(bands.map(PlaceAt::Band)).map(LineAt::Place);
    let mut shapes = Vec::new();
    for at in regions.chain(places) {
        let Some(points) = at.get(work.tour) else { continue };
        let is_active = active.contains(&at);
        let strength = if is_active { 1.0 } else { 0.3 };
        let points = on_screen(frame, points);
        let closed = matches!(at, LineAt::Region(_));
        if points.len() >= 2 {
            let width = if is_active { 2.0 } else { 1.0 };
            shapes.extend(line(&points, closed, line_color(at).gamma_multiply(strength), width));
        }
    }
    shapes
}

/// The masks' names that are in the draft, with the strength and color in which they are shown.
pub(super) fn masks<'a>(step: Step, object: Option<usize>, work: &Work<'a>) -> Vec<(&'a str, Color32)> {
    let active = lines(step, object, work);
    let bands = (0..work.tour.background.bands.len()).map(RegionAt::Band);
    let objects = (0..work.tour.objects.len()).map(RegionAt::Object);
    let regions = [RegionAt::Water, RegionAt::Ground, RegionAt::Sky].into_iter().chain(bands).chain(objects);
    regions
        .filter_map(|at| {
            let Region::Mask(name) = at.get(work.tour)? else { return None };
            let strength = if active.contains(&LineAt::Region(at)) { 0.45 } else { 0.1 };
            Some((name.as_str(), line_color(LineAt::Region(at)).gamma_multiply(strength)))
        })
        .collect()
}

/// The marked horizon from side to side, and the solver's with its deviation.
pub(super) fn horizon(frame: Frame, step: Step, work: &Work<'_>) -> Vec<Shape> {
    let strength = if step == Step::Horizon { 1.0 } else { 0.35 };
    let mut shapes = Vec::new();
    if let (Some(solution), Some(camera)) = (work.solution(), work.camera())
        && let Some(ends) = camera.horizon().and_then(|ends| across(frame, ends))
    {
        let deviation = solution.report.parameter("pitch").and_then(|pitch| pitch.deviation);
        if let Some(deviation) = deviation {
            // The horizon moves by about f · δ when the pitch changes by δ.
            let half = (deviation * solution.parameters.focal_px * frame.eye.zoom) as f32;
            let half = Vec2::new(0.0, half.min(frame.screen.height()));
            let band = vec![ends[0] - half, ends[1] - half, ends[1] + half, ends[0] + half];
            let fill = theme::HORIZON.gamma_multiply(0.1 * strength);
            shapes.push(Shape::convex_polygon(band, fill, Stroke::NONE));
        }
        shapes.extend(dashed(&ends, theme::HORIZON.gamma_multiply(strength)));
    }
    if let Some(marked) = work.tour.camera.horizon
        && let Some(ends) = across(frame, marked)
    {
        shapes.extend(line(&ends, false, theme::HORIZON.gamma_multiply(strength), 2.0));
    }
    shapes
}

/// The line through two points, from the left to the right side of the canvas.
fn across(frame: Frame, [a, b]: [PicturePoint; 2]) -> Option<[Pos2; 2]> {
    let (a, b) = (frame.to_screen(a), frame.to_screen(b));
    let slope = (b.y - a.y) / (b.x - a.x);
    let at = |x: f32| Pos2::new(x, a.y + (x - a.x) * slope);
    slope.is_finite().then(|| [at(frame.screen.left()), at(frame.screen.right())])
}

/// Pairs, each with what it is off by, drawn `times` as long.
pub(super) fn pairs(frame: Frame, step: Step, times: f64, work: &Work<'_>) -> Vec<Shape> {
    let Some(water) = &work.tour.water else { return Vec::new() };
    let is_active = step == Step::Pairs;
    let mut shapes = Vec::new();
    for (index, pair) in water.pairs.iter().enumerate() {
        let report = work.solution().and_then(|solution| solution.report.pairs.get(index));
        let color = match report {
            Some(report) if !report.kept => theme::BAD,
            _ => theme::PAIR,
        };
        let ends = [frame.to_screen(pair.point), frame.to_screen(pair.reflection)];
        if !is_active {
            shapes.extend(line(&ends, false, color.gamma_multiply(0.25), 1.0));
            continue;
        }
        shapes.extend(line(&ends, false, color.gamma_multiply(0.7), 1.2));
        let expected = work
            .solution()
            .zip(work.camera())
            .and_then(|(solution, camera)| expected_reflection(pair, work.tour, solution, &camera));
        if let Some(expected) = expected {
            let off: DVec2 = (expected.0 - pair.reflection.0) * times;
            let tip = frame.to_screen(PicturePoint(pair.reflection.0 + off));
            shapes.extend(line(&[ends[1], tip], false, theme::ROUGH, 2.0));
            shapes.push(Shape::circle_filled(tip, 2.5, theme::ROUGH));
        }
    }
    shapes
}

/// Contact lines of objects, the known length, a swaying object's axis and a boat's course.
pub(super) fn objects(frame: Frame, step: Step, object: Option<usize>, work: &Work<'_>) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for (index, marked) in work.tour.objects.iter().enumerate() {
        let is_active = matches!(step, Step::Objects | Step::Motion) && object == Some(index);
        let strength = if is_active { 1.0 } else { 0.35 };
        let contact = on_screen(frame, &marked.contact);
        shapes.extend(line(&contact, false, theme::GROUND.gamma_multiply(strength), 2.0));
        match &marked.motion {
            Motion::Sway(sway) => {
                if let (Some(root), Some(tip)) = (sway.root, sway.tip) {
                    let axis = on_screen(frame, &[root, tip]);
                    shapes.extend(line(&axis, false, theme::ACCENT.gamma_multiply(strength), 1.5));
                }
            }
            Motion::Course(course) if step == Step::Motion => {
                let way: Vec<_> = course.waypoints.iter().filter_map(|point| work.seen_at(*point)).collect();
                let way = on_screen(frame, &way);
                if way.len() >= 2 {
                    let closed = course.closed && way.len() > 2;
                    shapes.extend(line(&way, closed, theme::ACCENT.gamma_multiply(strength), 2.0));
                }
            }
            _ => {}
        }
    }
    if let (Step::Horizon, Some(Scale::Length { from, to, .. })) = (step, &work.tour.camera.scale) {
        shapes.extend(line(&on_screen(frame, &[*from, *to]), false, theme::OBJECT, 2.0));
    }
    shapes
}

/// What is only proposed, dashed.
pub(super) fn ghosts(frame: Frame, step: Step, work: &Work<'_>) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let suggested = work.view.suggestions.iter().filter(|suggestion| suggestion.step == step);
    for ghost in suggested.flat_map(|suggestion| &suggestion.ghosts) {
        match ghost {
            Ghost::Line { points, closed } => {
                let mut points = on_screen(frame, points);
                points.extend(points.first().copied().filter(|_| *closed));
                shapes.extend(dashed(&points, theme::ACCENT));
            }
            Ghost::Pair(point, reflection) => {
                let ends = on_screen(frame, &[*point, *reflection]);
                shapes.extend(dashed(&ends, theme::ACCENT));
                shapes.extend(
                    ends.iter().map(|end| Shape::circle_stroke(*end, 4.0, Stroke::new(1.5, theme::ACCENT))),
                );
            }
            Ghost::Place(point, radius) => {
                let radius = (radius * frame.eye.zoom) as f32;
                let stroke = Stroke::new(1.5, theme::ACCENT);
                shapes.push(Shape::circle_stroke(frame.to_screen(*point), radius, stroke));
            }
        }
    }
    shapes
}

/// How a handle stands out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Emphasis {
    Idle,
    Hovered,
    Selected,
    Active,
}

/// A handle: a ring with a dark rim; filled when selected, wide when dragged.
pub(super) fn handle(at: Pos2, color: Color32, emphasis: Emphasis) -> Vec<Shape> {
    let (radius, fill) = match emphasis {
        Emphasis::Idle => (4.5, theme::BACKDROP.gamma_multiply(0.6)),
        Emphasis::Hovered => (6.5, color.gamma_multiply(0.5)),
        Emphasis::Selected => (6.0, color),
        Emphasis::Active => (9.0, Color32::TRANSPARENT),
    };
    vec![
        Shape::circle_filled(at, radius, fill),
        Shape::circle_stroke(at, radius + 1.0, Stroke::new(1.0, theme::HALO)),
        Shape::circle_stroke(at, radius, Stroke::new(2.0, color)),
    ]
}

/// Points that are being drawn, with the way to the pointer.
pub(super) fn sketch(points: &[Pos2], pointer: Option<Pos2>, traced: &[Pos2]) -> Vec<Shape> {
    let mut shapes = Vec::new();
    if points.len() >= 2 {
        shapes.extend(line(points, false, theme::ACCENT, 2.0));
    }
    if traced.len() >= 2 {
        shapes.extend(line(traced, false, theme::ACCENT.gamma_multiply(0.7), 1.5));
    } else if let (Some(last), Some(pointer)) = (points.last(), pointer) {
        shapes.extend(dashed(&[*last, pointer], theme::ACCENT));
    }
    shapes.extend(points.iter().map(|point| Shape::circle_filled(*point, 2.5, theme::ACCENT)));
    shapes
}
