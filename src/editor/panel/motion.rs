//! Step 6, first part: how each object moves. A kind is picked; sliders that are not ticked keep the kind's own numbers.

use glam::DVec2;

use crate::picture::PicturePoint;
use crate::tour::edit::{Edit, PointAt};
use crate::tour::{Course, Drift, Floating, Motion, Sky, Sway, SwayKind, Waypoint};
use crate::water::body::Hull;
use crate::wind::preset::preset;

use super::super::canvas::Tool;
use super::super::egui::Ui;
use super::super::field::{self, Number};
use super::super::text::with;
use super::super::work::Work;
use super::super::{Out, Studio};
use super::objects::list_ui;
use super::{point_ui, tool_button};

/// The kinds of motion that can be picked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Still,
    Sway(SwayKind),
    Anchored,
    UnderWay,
    Recorded,
}

impl Kind {
    fn of(motion: &Motion<String>) -> Self {
        match motion {
            Motion::Static => Self::Still,
            Motion::Sway(sway) => Self::Sway(sway.kind),
            Motion::Floating(_) => Self::Anchored,
            Motion::Course(_) => Self::UnderWay,
            Motion::Recorded(_) => Self::Recorded,
        }
    }
}

/// Shows the objects' motions.
pub(super) fn motion_ui(ui: &mut Ui, studio: &mut Studio, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    if let Some(wanted) = field::tick(ui, t.motion.preview, studio.motion_preview) {
        studio.motion_preview = wanted;
    }
    field::title(ui, t.motion.objects);
    if work.tour.objects.is_empty() {
        ui.weak(t.motion.no_objects);
    }
    list_ui(ui, studio, work);
    if let Some(index) = studio.object
        && let Some(object) = work.tour.objects.get(index)
    {
        ui.push_id(("motion", index), |ui| {
            field::card(ui, |ui| {
                kind_ui(ui, index, &object.motion, studio, work, out);
                match &object.motion {
                    Motion::Sway(sway) => sway_ui(ui, index, sway, work, out),
                    Motion::Floating(floating) => floating_ui(ui, index, floating, work, out),
                    Motion::Course(course) => course_ui(ui, index, course, studio, work, out),
                    Motion::Static | Motion::Recorded(_) => {}
                }
            });
        });
    }
    clouds_ui(ui, work, out);
}

fn kind_ui(
    ui: &mut Ui,
    object: usize,
    motion: &Motion<String>,
    studio: &mut Studio,
    work: &Work<'_>,
    out: &mut Out,
) {
    let t = work.text;
    let kinds = [
        (Kind::Still, t.motion.still),
        (Kind::Sway(SwayKind::Trunk), t.motion.trunk),
        (Kind::Sway(SwayKind::Branch), t.motion.crown),
        (Kind::Sway(SwayKind::Reed), t.motion.reeds),
        (Kind::Sway(SwayKind::Grass), t.motion.grass),
        (Kind::Anchored, t.motion.anchored),
        (Kind::UnderWay, t.motion.under_way),
        (Kind::Recorded, t.motion.recorded),
    ];
    let kind = Kind::of(motion);
    // A recording is made elsewhere; it can be kept or left.
    let kinds = if kind == Kind::Recorded { &kinds[..] } else { &kinds[..7] };
    let Some(wanted) = field::choice(ui, "kind", t.motion.kind, kind, kinds) else { return };
    let (draft, length) = match motion {
        Motion::Floating(floating) => (floating.draft, floating.length),
        Motion::Course(course) => (course.draft, course.length),
        _ => (0.3, None),
    };
    let motion = match wanted {
        Kind::Still => Motion::Static,
        Kind::Sway(kind) => Motion::Sway(match motion {
            Motion::Sway(sway) => Sway { kind, ..sway.clone() },
            _ => Sway::of_kind(kind),
        }),
        Kind::Anchored => Motion::Floating(Floating { length, ..Floating::of_draft(draft) }),
        Kind::UnderWay => match first_course(object, work) {
            Some(waypoints) => Motion::Course(Course { waypoints, speed: 1.0, draft, length, closed: false }),
            // Nobody knows yet where on the water it is: the course is drawn first.
            None => return studio.take(Tool::Course(object)),
        },
        Kind::Recorded => return,
    };
    out.edit(Edit::Motion { object, motion });
}

/// A short way along an object's contact line, to be drawn on.
fn first_course(object: usize, work: &Work<'_>) -> Option<Vec<Waypoint>> {
    let [left, right] = work.tour.objects.get(object)?.contact;
    let Waypoint(here) = work.water_at(PicturePoint((left.0 + right.0) / 2.0))?;
    let Waypoint(ahead) = work.water_at(right)?;
    let way = (ahead - here).try_normalize().unwrap_or(DVec2::X) * 10.0;
    Some(vec![Waypoint(here), Waypoint(here + way)])
}

fn sway_ui(ui: &mut Ui, object: usize, sway: &Sway, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let usual = preset(sway.kind);
    let mut wanted = sway.clone();
    let set = |to: &mut Option<f64>, new: Option<Option<f64>>| {
        if let Some(new) = new {
            *to = new;
        }
    };
    let row = |name, range| Number::new(name, range).hint(t.motion.own_number_hint);
    let strength = row(t.motion.amplitude, 0.0..=0.2).decimals(3);
    set(&mut wanted.amplitude, strength.optional(ui, sway.amplitude, usual.amplitude));
    let quickness = row(t.motion.frequency, 0.02..=10.0).logarithmic().unit(" Hz");
    set(&mut wanted.frequency_hz, quickness.optional(ui, sway.frequency_hz, usual.frequency_hz));
    set(
        &mut wanted.damping,
        row(t.motion.damping, 0.01..=1.0).logarithmic().optional(ui, sway.damping, usual.damping),
    );
    let period = row(t.motion.period, 4.0..=120.0).unit(" s").decimals(0);
    set(&mut wanted.period_seconds, period.optional(ui, sway.period_seconds, work.tour.wind.period_seconds));
    if wanted != *sway {
        out.edit(Edit::Motion { object, motion: Motion::Sway(wanted) });
    }
    let contact = work.tour.objects[object].contact;
    if sway.root.is_none() || sway.tip.is_none() {
        if ui.button(t.motion.show_axis).on_hover_text(t.motion.show_axis_hint).clicked() {
            let root = PicturePoint((contact[0].0 + contact[1].0) / 2.0);
            let tip = top_of(object, work).unwrap_or(PicturePoint(root.0 - DVec2::new(0.0, 60.0)));
            let sway = Sway { root: sway.root.or(Some(root)), tip: sway.tip.or(Some(tip)), ..sway.clone() };
            out.edit(Edit::Motion { object, motion: Motion::Sway(sway) });
        }
    } else {
        point_ui(ui, t.mark.sway_root, PointAt::SwayRoot(object), work, out);
        point_ui(ui, t.mark.sway_tip, PointAt::SwayTip(object), work, out);
    }
}

/// The topmost corner of an object's outline, if that is a polygon.
fn top_of(object: usize, work: &Work<'_>) -> Option<PicturePoint> {
    use crate::tour::Region;
    let Region::Polygon(corners) = &work.tour.objects.get(object)?.outline else { return None };
    corners.iter().copied().min_by(|a, b| a.y().total_cmp(&b.y()))
}

fn floating_ui(ui: &mut Ui, object: usize, floating: &Floating, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    let mut wanted = floating.clone();
    let row = |name, range| Number::new(name, range).logarithmic().hint(t.motion.own_number_hint);
    if let Some(draft) = row(t.motion.draft, 0.01..=20.0).unit(" m").slide(ui, floating.draft) {
        wanted.draft = draft;
    }
    let hull = Hull::new(floating, contact_length(object, work));
    let rows: [(&mut Option<f64>, Number<'_>, f64); 5] = [
        (&mut wanted.length, row(t.motion.length, 0.1..=400.0).unit(" m"), hull.length),
        (&mut wanted.heave_damping, row(t.motion.heave_damping, 0.01..=2.0), hull.heave_damping),
        (&mut wanted.roll_damping, row(t.motion.roll_damping, 0.01..=2.0), hull.roll_damping),
        (
            &mut wanted.heave_period_seconds,
            row(t.motion.heave_period, 0.2..=60.0).unit(" s"),
            hull.heave_period,
        ),
        (&mut wanted.roll_period_seconds, row(t.motion.roll_period, 0.2..=60.0).unit(" s"), hull.roll_period),
    ];
    for (value, number, usual) in rows {
        if let Some(new) = number.optional(ui, *value, usual) {
            *value = new;
        }
    }
    if wanted != *floating {
        out.edit(Edit::Motion { object, motion: Motion::Floating(wanted) });
    }
}

/// Meters from foot to foot on the water; not a number where that cannot be told (the hull has a usual one then).
fn contact_length(object: usize, work: &Work<'_>) -> f64 {
    let feet = work.tour.objects.get(object).map(|object| object.contact.map(|foot| work.water_at(foot)));
    match feet {
        Some([Some(Waypoint(left)), Some(Waypoint(right))]) => left.distance(right),
        _ => f64::NAN,
    }
}

fn course_ui(
    ui: &mut Ui,
    object: usize,
    course: &Course,
    studio: &mut Studio,
    work: &Work<'_>,
    out: &mut Out,
) {
    let t = work.text;
    let mut wanted = course.clone();
    let speed = Number::new(t.motion.speed, 0.05..=30.0).logarithmic().unit(" m/s");
    if let Some(speed) = speed.slide(ui, course.speed) {
        wanted.speed = speed;
    }
    let draft = Number::new(t.motion.draft, 0.01..=20.0).logarithmic().unit(" m");
    if let Some(draft) = draft.slide(ui, course.draft) {
        wanted.draft = draft;
    }
    if let Some(closed) = field::tick(ui, t.motion.closed, course.closed) {
        wanted.closed = closed;
    }
    for (index, waypoint) in wanted.waypoints.iter_mut().enumerate() {
        // Meters on the water, typed like a point of the picture.
        let name = with(t.mark.waypoint, index + 1);
        if let Some(PicturePoint(xz)) = field::point(ui, &name, PicturePoint(waypoint.0)) {
            waypoint.0 = xz;
        }
    }
    if wanted != *course {
        out.edit(Edit::Motion { object, motion: Motion::Course(wanted) });
    }
    if work.camera().is_some() {
        tool_button(ui, studio, Tool::Course(object), t.motion.draw_course);
    } else {
        ui.weak(t.motion.course_needs_camera);
    }
}

/// How the clouds drift.
fn clouds_ui(ui: &mut Ui, work: &Work<'_>, out: &mut Out) {
    let t = work.text;
    field::title(ui, t.motion.clouds);
    let Some(Sky { drift, .. }) = &work.tour.sky else {
        ui.weak(t.motion.no_sky);
        return;
    };
    field::card(ui, |ui| {
        if let Some(own) = field::tick(ui, t.motion.own_drift, drift.is_some()) {
            out.edit(Edit::Drift(own.then_some(Drift { speed: 2.0, direction_deg: 0.0 })));
        }
        let Some(drift) = drift else { return };
        let speed = Number::new(t.motion.drift_speed, 0.0..=100.0).unit(" px/s").decimals(1);
        if let Some(speed) = speed.slide(ui, drift.speed) {
            out.edit(Edit::Drift(Some(Drift { speed, ..*drift })));
        }
        let direction = Number::new(t.motion.drift_direction, -180.0..=360.0).unit("°").decimals(0);
        if let Some(direction_deg) = direction.slide(ui, drift.direction_deg) {
            out.edit(Edit::Drift(Some(Drift { direction_deg, ..*drift })));
        }
    });
}
