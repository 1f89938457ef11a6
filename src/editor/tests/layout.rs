//! At 1280 × 720 and on a 4K screen nothing overlaps and nothing leaves the window.

use std::time::Duration;

use egui_kittest::kittest::NodeT as _;

use super::*;
use crate::editor::egui::accesskit::Role;
use crate::editor::egui::{Rect, ViewportId};

/// What can be clicked, by name, with its place.
fn controls(harness: &Harness<'_, Bench>) -> Vec<(String, Rect)> {
    let roles = [
        Role::Button,
        Role::CheckBox,
        Role::RadioButton,
        Role::Slider,
        Role::SpinButton,
        Role::ComboBox,
        Role::TextInput,
    ];
    harness
        .root()
        .children_recursive()
        .filter(|node| roles.contains(&node.accesskit_node().role()))
        .map(|node| {
            let label = node.accesskit_node().label().unwrap_or_default();
            (format!("{:?} {label}", node.accesskit_node().role()), node.rect())
        })
        .collect()
}

fn full(step: Step) -> Bench {
    let mut bench = Bench::at(step);
    bench.studio.object = Some(0);
    bench.tasks = vec![Task { id: 1, title: "Solving".into(), done: Some(0.4), can_cancel: true }];
    bench.message = Some(Message {
        what: "the disk is full".into(),
        advice: "free some room and save again; a copy of all marks is kept in the recovery file".into(),
        is_error: true,
    });
    let keyframe = |seconds: f64| crate::tour::Keyframe {
        position: DVec3::Y,
        yaw_deg: 0.0,
        pitch_deg: 0.0,
        roll_deg: 0.0,
        seconds,
        hold: 0.0,
        easing: crate::tour::Easing::Smooth,
    };
    let mut tour = pond();
    tour.path =
        Some(crate::tour::CameraPath { keyframes: [0.0, 4.0, 5.0].map(keyframe).to_vec(), looped: false });
    tour.sky = Some(crate::tour::Sky { region: None, drift: None });
    tour.objects[0].name = "the old rowing boat of my grandfather's neighbor".into();
    bench.draft = Some(Draft::new(tour));
    bench.suggestions = vec![Suggestion {
        id: 7,
        step,
        title: "A horizon at 250 px".into(),
        reason: "The picture mirrors itself about this line over nine tenths of its width.".into(),
        confidence: 0.8,
        edits: vec![Edit::LoopPath(true)],
        ghosts: vec![Ghost::Place(PicturePoint::new(100.0, 100.0), 40.0)],
    }];
    bench
}

#[test]
fn nothing_overlaps_and_nothing_leaves_the_window() {
    for (size, name) in
        [(SMALL, "1280x720"), (Vec2::new(3840.0, 2160.0), "4K"), (Vec2::new(1024.0, 640.0), "1024x640")]
    {
        let mut border = None;
        for step in Step::ALL {
            let harness = sized(full(step), size);
            let controls = controls(&harness);
            assert!(controls.len() > 12, "{step:?} at {name} shows only {controls:?}");
            for (label, rect) in &controls {
                // The step's panel scrolls, so its lower part may be below the window, but never beside it.
                assert!(
                    rect.left() >= 0.0 && rect.right() <= size.x && rect.top() >= -1.0,
                    "{label} at {rect} leaves {name} at {step:?}"
                );
            }
            let picture = harness.get_by_label("Picture").rect();
            let border = *border.get_or_insert(picture.left());
            assert_eq!(picture.left(), border, "the panel's width changed at {step:?}, {name}");
            for (label, rect) in &controls {
                let is_beside =
                    rect.left() >= border || rect.bottom() < picture.top() || rect.top() > size.y - 40.0;
                assert!(
                    is_beside || rect.right() < border,
                    "{label} at {rect} leaves the panel at {step:?}, {name}"
                );
            }
            for (i, (a, at_a)) in controls.iter().enumerate() {
                for (b, at_b) in &controls[i + 1..] {
                    // A slider holds its own number.
                    let inside = at_a.contains_rect(*at_b) || at_b.contains_rect(*at_a);
                    let overlap = at_a.intersect(*at_b);
                    let overlaps = overlap.width() > 1.0 && overlap.height() > 1.0;
                    assert!(!overlaps || inside, "{a} {at_a} and {b} {at_b} overlap at {step:?}, {name}");
                }
            }
        }
    }
}

#[test]
fn picture_and_tour_share_the_room_and_one_alone_has_all() {
    let mut harness = small(Bench::pond());
    let (picture, tour) = (harness.get_by_label("Picture").rect(), harness.get_by_label("Tour").rect());
    assert!(
        picture.right() <= tour.left() && (picture.width() - tour.width()).abs() < 1.0,
        "{picture} {tour}"
    );
    assert!(picture.width() > 400.0 && picture.height() > 500.0, "{picture}");
    assert_eq!(harness.state().out.wanted_tour_size, UVec2::new(tour.width() as u32, tour.height() as u32));
    press(&mut harness, "Picture only");
    assert!(harness.query_by_label("Tour").is_none());
    assert_eq!(harness.state().out.wanted_tour_size, UVec2::ZERO);
    let alone = harness.get_by_label("Picture").rect();
    assert!((alone.width() - (tour.right() - picture.left())).abs() < 1.0, "{alone}");
    press(&mut harness, "Tour only");
    assert!(harness.query_by_label("Picture").is_none());
}

#[test]
fn the_pointer_over_the_tour_is_told() {
    let mut harness = small(Bench::pond());
    for (label, over) in [("Tour", true), ("Picture", false)] {
        harness.get_by_label(label).hover();
        harness.run_steps(2);
        assert_eq!(harness.state().out.pointer_over_tour, over, "{label}");
    }
}

#[test]
fn an_idle_studio_draws_nothing_anew() {
    for step in Step::ALL {
        let mut harness = small(Bench::at(step));
        harness.run_steps(30);
        let delay = harness.output().viewport_output[&ViewportId::ROOT].repaint_delay;
        assert!(delay > Duration::from_secs(1), "{step:?} wants to be drawn again after {delay:?}");
    }
}
