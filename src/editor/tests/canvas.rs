//! Pointer and keys on the picture yield the right edits.

use glam::DVec2;

use super::*;
use crate::editor::egui::{Key, Modifiers};
use crate::picture::Mask;
use crate::tour::edit::{LineAt, ListEdit, PointAt, RegionAt};

fn close(a: PicturePoint, b: (f64, f64), px: f64) {
    assert!(a.0.distance(DVec2::new(b.0, b.1)) <= px, "{a} is not {b:?}");
}

#[test]
fn dragging_a_handle_is_one_step_that_can_be_undone() {
    let mut harness = small(Bench::at(Step::Horizon));
    drag(&mut harness, (0.0, 250.0), (40.0, 200.0));
    let bench = harness.state();
    let edits = bench.edits();
    assert!(
        edits.iter().all(|edit| matches!(edit, Edit::MovePoint { at: PointAt::Horizon(0), .. })),
        "{edits:?}"
    );
    assert_eq!(
        (bench.log.first(), bench.log.last()),
        (Some(&Request::BeginGesture), Some(&Request::EndGesture))
    );
    assert_eq!(bench.steps(), 1);
    close(bench.tour().camera.horizon.unwrap()[0], (40.0, 200.0), 0.1);

    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    close(harness.state().tour().camera.horizon.unwrap()[0], (0.0, 250.0), 1e-9);
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(2);
    close(harness.state().tour().camera.horizon.unwrap()[0], (40.0, 200.0), 0.1);
}

#[test]
fn escape_takes_a_drag_back() {
    let mut harness = small(Bench::at(Step::Horizon));
    let (from, to) = (seen(&harness, 1000.0, 250.0), seen(&harness, 800.0, 100.0));
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    harness.hover_at(to);
    harness.run_steps(2);
    assert!(!harness.state().edits().is_empty());
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    harness.hover_at(from.lerp(to, 0.5));
    harness.step();
    harness.drop_at(to);
    harness.run_steps(2);
    let bench = harness.state();
    close(bench.tour().camera.horizon.unwrap()[1], (1000.0, 250.0), 1e-9);
    assert_eq!(bench.steps(), 0);
}

#[test]
fn undo_takes_a_drag_back_and_save_divides_it() {
    let mut harness = small(Bench::at(Step::Horizon));
    let (from, to) = (seen(&harness, 1000.0, 250.0), seen(&harness, 800.0, 100.0));
    let hold = |harness: &mut Harness<'_, Bench>, key| {
        harness.hover_at(from);
        harness.step();
        harness.drag_at(from);
        harness.step();
        for part in [0.3, 0.5] {
            harness.hover_at(from.lerp(to, part));
            harness.step();
        }
        harness.key_press_modifiers(Modifiers::COMMAND, key);
        harness.run_steps(2);
        for part in [0.6, 0.8, 1.0] {
            harness.hover_at(from.lerp(to, part));
            harness.step();
        }
        harness.drop_at(to);
        harness.run_steps(2);
    };
    hold(&mut harness, Key::Z);
    let bench = harness.state();
    close(bench.tour().camera.horizon.unwrap()[1], (1000.0, 250.0), 1e-9);
    assert_eq!((bench.steps(), bench.log.last()), (0, Some(&Request::CancelGesture)), "{:?}", bench.log);

    hold(&mut harness, Key::S);
    let bench = harness.state();
    close(bench.tour().camera.horizon.unwrap()[1], (800.0, 100.0), 0.5);
    assert!(bench.log.contains(&Request::Save));
    assert_eq!(bench.steps(), 2, "{:?}", bench.log);
}

#[test]
fn handles_are_found_by_name_also_outside_the_picture() {
    let mut bench = Bench::at(Step::Horizon);
    let mut tour = pond();
    tour.camera.horizon = Some([PicturePoint::new(-30.0, 250.0), PicturePoint::new(1000.0, 250.0)]);
    bench.draft = Some(Draft::new(tour));
    let mut harness = small(bench);
    let at = harness.get_by_label("Horizon, left end").rect();
    assert!(at.width() >= 24.0 && at.height() >= 24.0, "{at}");
    assert!((at.center() - seen(&harness, -30.0, 250.0)).length() < 0.1);
    drag(&mut harness, (-30.0, 250.0), (-30.0, 300.0));
    close(harness.state().tour().camera.horizon.unwrap()[0], (-30.0, 300.0), 0.2);
}

#[test]
fn arrow_keys_move_by_one_ten_and_a_tenth_of_a_pixel() {
    let mut harness = small(Bench::at(Step::Water));
    click(&mut harness, (1000.0, 290.0));
    let selected = harness.state().studio.canvas.selected;
    assert_eq!(selected, Some(Handle::Mark(PointAt::On(LineAt::Region(RegionAt::Water), 1))));
    let corner = |harness: &Harness<'_, Bench>| match &harness.state().tour().water.as_ref().unwrap().region {
        Region::Polygon(corners) => corners[1],
        Region::Mask(_) => panic!("a mask"),
    };
    for (modifiers, key, to) in [
        (Modifiers::NONE, Key::ArrowDown, (1000.0, 291.0)),
        (Modifiers::SHIFT, Key::ArrowLeft, (990.0, 291.0)),
        (Modifiers::ALT, Key::ArrowUp, (990.0, 290.9)),
    ] {
        harness.key_press_modifiers(modifiers, key);
        harness.run_steps(2);
        close(corner(&harness), to, 1e-9);
    }
    assert_eq!(harness.state().steps(), 3);
}

#[test]
fn dragging_an_edge_puts_a_corner_in_and_delete_takes_it_out() {
    let mut harness = small(Bench::at(Step::Water));
    drag(&mut harness, (500.0, 290.0), (500.0, 320.0));
    let line = LineAt::Region(RegionAt::Water);
    let bench = harness.state();
    assert!(matches!(bench.edits()[0], Edit::InsertPoint { index: 1, .. }), "{:?}", bench.edits());
    assert_eq!((bench.steps(), line.get(bench.tour()).unwrap().len()), (1, 5));
    close(line.get(bench.tour()).unwrap()[1], (500.0, 320.0), 1.0);
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    let bench = harness.state();
    assert_eq!(bench.edits().last(), Some(&&Edit::RemovePoint { line, index: 1 }));
    assert_eq!(line.get(bench.tour()).unwrap().len(), 4);
}

#[test]
fn a_dragged_corner_snaps_to_another_point_unless_alt_is_held() {
    let mut harness = small(Bench::at(Step::Objects));
    harness.state_mut().studio.object = Some(0);
    harness.run_steps(1);
    drag(&mut harness, (600.0, 360.0), (698.0, 362.0));
    let corner = |harness: &Harness<'_, Bench>| {
        LineAt::Region(RegionAt::Object(0)).get(harness.state().tour()).unwrap()[0]
    };
    close(corner(&harness), (700.0, 360.0), 1e-9);
    let mut harness = small(Bench::at(Step::Objects));
    harness.state_mut().studio.object = Some(0);
    harness.state_mut().studio.snapping = false;
    harness.run_steps(1);
    drag(&mut harness, (600.0, 360.0), (698.0, 362.0));
    close(corner(&harness), (698.0, 362.0), 0.2);
}

#[test]
fn an_outline_is_drawn_by_clicks_and_closed_by_enter() {
    let mut harness = small(Bench::at(Step::Objects));
    press(&mut harness, "Draw a new object");
    for corner in [(200.0, 300.0), (300.0, 300.0), (300.0, 450.0), (200.0, 450.0)] {
        click(&mut harness, corner);
    }
    assert_eq!(harness.state().studio.canvas.drawn(), 4);
    assert!(harness.state().edits().is_empty());
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    let bench = harness.state();
    let [Edit::Objects(ListEdit::Insert(1, object))] = bench.edits()[..] else {
        panic!("{:?}", bench.edits());
    };
    assert_eq!(object.name, "object 1");
    close(object.contact[1], (300.0, 450.0), 1.0);
    assert_eq!((bench.studio.object, bench.studio.canvas.tool), (Some(1), Tool::Select));
}

#[test]
fn an_outline_takes_the_way_along_edges_when_it_leads_there() {
    let mut harness = small(Bench::at(Step::Water));
    press(&mut harness, "Draw anew");
    click(&mut harness, (200.0, 300.0));
    let way = [(200.0, 300.0), (250.0, 310.0), (300.0, 300.0)];
    let first = harness.state().studio.canvas.drawn();
    assert_eq!(first, 1);
    harness.state_mut().traced = way.map(|(x, y)| PicturePoint::new(x, y)).to_vec();
    click(&mut harness, (300.0, 300.0));
    assert_eq!(harness.state().studio.canvas.drawn(), 3);
}

#[test]
fn a_pair_is_dragged_from_point_to_reflection() {
    let mut harness = small(Bench::at(Step::Pairs));
    press(&mut harness, "Mark pairs");
    drag(&mut harness, (420.0, 150.0), (420.0, 380.0));
    let bench = harness.state();
    let [Edit::Pairs(ListEdit::Insert(2, pair))] = bench.edits()[..] else { panic!("{:?}", bench.edits()) };
    close(pair.point, (420.0, 150.0), 0.5);
    close(pair.reflection, (420.0, 380.0), 0.5);
    assert_eq!(bench.studio.canvas.tool, Tool::Pair, "the next pair can be marked at once");
}

#[test]
fn a_pair_is_clicked_with_a_trembling_hand() {
    let mut harness = small(Bench::at(Step::Pairs));
    press(&mut harness, "Mark pairs");
    // Longer than a click may take, and not quite in one place.
    let long_click = |harness: &mut Harness<'_, Bench>, at: (f64, f64)| {
        let at = seen(harness, at.0, at.1);
        harness.hover_at(at);
        harness.step();
        harness.drag_at(at);
        harness.run_steps(6);
        harness.hover_at(at + Vec2::new(2.0, 1.0));
        harness.step();
        harness.drop_at(at + Vec2::new(2.0, 1.0));
        harness.run_steps(8);
    };
    long_click(&mut harness, (420.0, 150.0));
    assert_eq!((harness.state().studio.canvas.drawn(), harness.state().edits().len()), (1, 0));
    long_click(&mut harness, (420.0, 380.0));
    let bench = harness.state();
    let [Edit::Pairs(ListEdit::Insert(2, pair))] = bench.edits()[..] else { panic!("{:?}", bench.edits()) };
    close(pair.point, (420.0, 150.0), 8.0);
    close(pair.reflection, (420.0, 380.0), 8.0);
}

#[test]
fn a_click_finds_what_a_mask_of_another_size_covers() {
    // The picture's file has half the document's pixels, so the boat's mask has.
    let mut bench = Bench::at(Step::Objects);
    let size = SIZE / 2;
    let covered = |i: u32| (300..350).contains(&(i % size.x)) && (180..210).contains(&(i / size.x));
    let values = (0..size.element_product()).map(|i| if covered(i) { 255 } else { 0 }).collect();
    let mut tour = pond();
    tour.objects[0].outline = Region::Mask("masks/boat.png".into());
    let corners = [(640.0, 380.0), (660.0, 380.0), (660.0, 400.0), (640.0, 400.0)];
    tour.objects.push(Object {
        name: "oar".into(),
        outline: Region::Polygon(corners.map(|(x, y)| PicturePoint::new(x, y)).to_vec()),
        ..tour.objects[0].clone()
    });
    let mut draft = Draft::new(tour);
    draft.masks.load("masks/boat.png", Mask::new(size, values).unwrap());
    bench.draft = Some(draft);
    let mut harness = small(bench);
    for (at, object) in [((690.0, 370.0), Some(0)), ((650.0, 390.0), Some(1)), ((310.0, 190.0), Some(1))] {
        click(&mut harness, at);
        assert_eq!(harness.state().studio.object, object, "at {at:?}");
    }
    harness.state_mut().studio.step = Step::Pairs;
    harness.run_steps(2);
    press(&mut harness, "Mark pairs");
    click(&mut harness, (690.0, 370.0));
    click(&mut harness, (690.0, 480.0));
    let bench = harness.state();
    let Some(Edit::Pairs(ListEdit::Insert(_, pair))) = bench.edits().last() else {
        panic!("{:?}", bench.edits())
    };
    assert_eq!(pair.on.as_deref(), Some("boat"));
}

#[test]
fn strokes_and_boxes_ask_for_the_machine() {
    let mut harness = small(Bench::at(Step::Water));
    press(&mut harness, "Mend by strokes");
    drag(&mut harness, (300.0, 400.0), (400.0, 450.0));
    harness.key_press(Key::X);
    harness.run_steps(2);
    drag(&mut harness, (300.0, 500.0), (400.0, 500.0));
    let log = &harness.state().log;
    let [on, beside] = [0, 1].map(|i| match log.get(i) {
        Some(Request::RefineStroke { at: RegionAt::Water, stroke }) => stroke,
        other => panic!("{other:?}"),
    });
    assert!(on.points.len() >= 3, "{on:?}");
    close(on.points[0], (300.0, 400.0), 0.5);
    assert!(on.inside && !beside.inside, "X switches the side");

    let mut harness = small(Bench::at(Step::Objects));
    click(&mut harness, (650.0, 390.0));
    assert_eq!(harness.state().studio.object, Some(0), "a click on the boat selects it");
    press(&mut harness, "Find in a box");
    drag(&mut harness, (590.0, 340.0), (720.0, 430.0));
    let Some(Request::RefineBox { object: 0, corners }) = harness.state().log.last() else {
        panic!("{:?}", harness.state().log);
    };
    close(corners[1], (720.0, 430.0), 0.5);
}

#[test]
fn brush_strokes_come_piece_by_piece_within_one_gesture() {
    let mut harness = small(Bench::at(Step::Water));
    press(&mut harness, "Brush");
    drag(&mut harness, (300.0, 400.0), (400.0, 450.0));
    let log = &harness.state().log;
    assert_eq!((log.first(), log.last()), (Some(&Request::BeginGesture), Some(&Request::EndGesture)));
    let pieces =
        log.iter().filter(|request| matches!(request, Request::Paint { at: RegionAt::Water, .. })).count();
    assert!(pieces >= 3 && pieces == log.len() - 2, "{log:?}");
}

#[test]
fn a_waypoint_follows_the_pointer_and_a_course_can_be_bent() {
    let mut bench = Bench::at(Step::Motion);
    bench.studio.object = Some(0);
    let mut tour = pond();
    let waypoints = bench.with_work(|work| {
        [(400.0, 500.0), (600.0, 500.0)]
            .map(|(x, y)| work.water_at(PicturePoint::new(x, y)).unwrap())
            .to_vec()
    });
    tour.objects[0].motion = Motion::Course(crate::tour::Course {
        waypoints,
        speed: 1.0,
        draft: 0.3,
        length: None,
        closed: false,
    });
    bench.draft = Some(Draft::new(tour));
    let mut harness = small(bench);
    drag(&mut harness, (600.0, 500.0), (700.0, 400.0));
    let bench = harness.state();
    let Motion::Course(course) = &bench.tour().objects[0].motion else { panic!("no course") };
    let seen = bench.with_work(|work| work.seen_at(course.waypoints[1]).unwrap());
    close(seen, (700.0, 400.0), 0.5);
    assert_eq!(bench.steps(), 1);
    drag(&mut harness, (550.0, 450.0), (500.0, 400.0));
    let bench = harness.state();
    let Motion::Course(course) = &bench.tour().objects[0].motion else { panic!("no course") };
    assert_eq!((course.waypoints.len(), bench.steps()), (3, 2), "{:?}", bench.log);
    let seen = bench.with_work(|work| work.seen_at(course.waypoints[1]).unwrap());
    close(seen, (500.0, 400.0), 3.0);
}

#[test]
fn an_edge_is_not_lost_between_two_handles_that_lie_close() {
    let mut harness = small(Bench::at(Step::Objects));
    harness.state_mut().studio.object = Some(0);
    harness.run_steps(1);
    // Feet and lower corners of the boat share their places; whichever is taken, exactly one moves.
    drag(&mut harness, (700.0, 420.0), (730.0, 440.0));
    let bench = harness.state();
    let moved = bench.edits().iter().all(|edit| matches!(edit, Edit::MovePoint { .. }));
    assert!(moved && bench.steps() == 1, "{:?}", bench.edits());
}
