//! Looking around on the picture changes no mark.

use super::*;
use crate::editor::egui::{
    Event, Key, Modifiers, MouseWheelUnit, PointerButton, TouchDeviceId, TouchId, TouchPhase,
};

#[test]
fn the_wheel_zooms_about_the_pointer_and_the_middle_button_pans() {
    let mut harness = small(Bench::at(Step::Horizon));
    let at = seen(&harness, 300.0, 400.0);
    harness.hover_at(at);
    harness.step();
    harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: Vec2::new(0.0, 3.0),
        phase: TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    harness.run_steps(30);
    let after = seen(&harness, 300.0, 400.0);
    assert!((after - at).length() < 0.5, "{at} moved to {after}");
    let scale = (seen(&harness, 310.0, 400.0).x - after.x) / 10.0;
    assert!(scale > 0.6, "only {scale} points a pixel");

    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Middle,
        pressed,
        modifiers: Modifiers::NONE,
    };
    harness.event(button(at, true));
    harness.step();
    for x in [20.0, 40.0, 60.0] {
        harness.hover_at(at + Vec2::new(x, 0.0));
        harness.step();
    }
    harness.event(button(at + Vec2::new(60.0, 0.0), false));
    harness.run_steps(2);
    let moved = seen(&harness, 300.0, 400.0) - at;
    assert!((moved - Vec2::new(60.0, 0.0)).length() < 8.0, "moved by {moved}");
    assert!(harness.state().edits().is_empty());

    press(&mut harness, "Fit");
    assert!((seen(&harness, 300.0, 400.0) - at).length() < 0.5);
}

#[test]
fn two_fingers_move_the_picture_and_change_nothing() {
    let mut harness = small(Bench::at(Step::Horizon));
    let corner = seen(&harness, 0.0, 250.0);
    let touch = |id: u64, phase, pos| Event::Touch {
        device_id: TouchDeviceId(0),
        id: TouchId(id),
        phase,
        pos,
        force: None,
    };
    // The first finger lands on a handle, as a pointer too.
    harness.hover_at(corner);
    harness.step();
    harness.drag_at(corner);
    harness.event(touch(1, TouchPhase::Start, corner));
    harness.step();
    harness.hover_at(corner + Vec2::new(12.0, 0.0));
    harness.event(touch(1, TouchPhase::Move, corner + Vec2::new(12.0, 0.0)));
    harness.step();
    harness.event(touch(2, TouchPhase::Start, corner + Vec2::new(100.0, 0.0)));
    harness.step();
    for y in [10.0, 20.0, 30.0, 40.0] {
        let by = Vec2::new(12.0, y);
        harness.event(touch(1, TouchPhase::Move, corner + by));
        harness.event(touch(2, TouchPhase::Move, corner + by + Vec2::new(88.0, 0.0)));
        harness.hover_at(corner + by);
        harness.step();
    }
    harness.event(touch(2, TouchPhase::End, corner));
    harness.event(touch(1, TouchPhase::End, corner));
    harness.drop_at(corner + Vec2::new(12.0, 40.0));
    harness.run_steps(3);
    let moved = seen(&harness, 0.0, 250.0) - corner;
    assert!(moved.y > 15.0, "the picture moved by {moved}");
    let bench = harness.state();
    assert_eq!(bench.tour().camera.horizon, pond().camera.horizon);
    assert_eq!(bench.steps(), 0, "{:?}", bench.log);
}

#[test]
fn with_the_space_bar_a_drag_on_a_handle_pans() {
    let mut harness = small(Bench::at(Step::Horizon));
    let corner = seen(&harness, 0.0, 250.0);
    harness.key_down(Key::Space);
    harness.step();
    drag(&mut harness, (0.0, 250.0), (60.0, 250.0));
    harness.key_up(Key::Space);
    harness.run_steps(2);
    assert!((seen(&harness, 0.0, 250.0) - corner).x > 15.0);
    assert!(harness.state().edits().is_empty());
}

#[test]
fn arrow_keys_over_the_tour_fly_and_move_no_mark() {
    let mut harness = small(Bench::at(Step::Horizon));
    click(&mut harness, (0.0, 250.0));
    assert!(harness.state().studio.canvas.selected.is_some());
    harness.get_by_label("Tour").hover();
    harness.run_steps(2);
    harness.key_press(Key::ArrowDown);
    harness.run_steps(2);
    assert!(harness.state().edits().is_empty(), "{:?}", harness.state().log);
}
