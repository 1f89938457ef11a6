//! Bars, keys, questions and suggestions.

use super::*;
use crate::editor::egui::accesskit::Role;
use crate::editor::egui::{Event, Key, Modifiers};

#[test]
fn keys_and_clicks_go_to_steps_and_lamps_are_in_words() {
    let mut harness = small(Bench::pond());
    harness.key_press(Key::Num5);
    harness.run_steps(2);
    assert_eq!(harness.state().studio.step, Step::Pairs);
    press(&mut harness, "2 Water: good");
    assert_eq!(harness.state().studio.step, Step::Water);
    harness.get_by_label_contains("6 Motion and camera path: missing");
}

#[test]
fn the_menu_saves_and_opens_recent_files() {
    let mut harness = small(Bench::pond());
    press(&mut harness, "File");
    harness.get_by_label_contains("Save as…").click();
    harness.run_steps(3);
    assert_eq!(harness.state().log, [Request::SaveAs]);
    press(&mut harness, "File");
    harness.get_by_label_contains("Open recent").hover();
    harness.run_steps(20);
    press(&mut harness, "lake.tour.ron");
    assert_eq!(harness.state().log.last(), Some(&Request::Open(PathBuf::from("/pictures/lake.tour.ron"))));
    press(&mut harness, "File");
    harness.get_by_label_contains("Earlier versions").hover();
    harness.run_steps(20);
    press(&mut harness, "ten minutes ago");
    assert_eq!(harness.state().log.last(), Some(&Request::TakeVersion(0)));
}

#[test]
fn undo_says_what_it_undoes_and_typing_is_no_shortcut() {
    let mut harness = small(Bench::at(Step::Objects));
    harness.state_mut().studio.object = Some(0);
    harness.run_steps(2);
    press(&mut harness, "Turns to a camera that moves around it");
    harness.get_by_label("Undo").hover();
    harness.run_steps(20);
    harness.get_by_label("Undo: set turning to the camera (“boat”)");
    harness.get_by_role_and_label(Role::TextInput, "Object's name").click();
    harness.run_steps(3);
    harness.key_press(Key::Num3);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    let bench = harness.state();
    assert!(bench.out.text_has_focus);
    assert_eq!((bench.studio.step, bench.steps()), (Step::Objects, 1));
}

#[test]
fn what_is_typed_when_the_tour_is_saved_is_saved_too() {
    let mut harness = small(Bench::at(Step::Ground));
    choose(&mut harness, "Stands", "At a distance");
    harness.get_by_role_and_label(Role::SpinButton, "Distance").scroll_to_me();
    harness.run_steps(30);
    harness.get_by_role_and_label(Role::SpinButton, "Distance").click();
    harness.run_steps(3);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(2);
    harness.event(Event::Text("75".into()));
    harness.run_steps(2);
    harness.state_mut().log.clear();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    harness.run_steps(3);
    let at = crate::tour::edit::PlaceAt::Background;
    let place = Some(crate::tour::BackgroundPlace::Distance(75.0));
    assert_eq!(harness.state().log, [Request::Edit(Edit::Place { at, place }), Request::Save]);
}

#[test]
fn questions_are_answered_by_requests() {
    let file = PathBuf::from("/pictures/lake.tour.ron");
    let recovery = || Question::Recovery { name: "lake".into(), age: "ten minutes ago".into() };
    let changed = || Question::ChangedOnDisk { name: "lake.tour.ron".into() };
    for (question, answer, request) in [
        (Question::Unsaved, "Save and close", Request::SaveAndClose),
        (Question::Unsaved, "Close without saving", Request::CloseUnsaved),
        (Question::Unsaved, "Stay", Request::Stay),
        (recovery(), "Go on with them", Request::Recover),
        (recovery(), "Discard them", Request::DiscardRecovery),
        (changed(), "Save over it", Request::SaveOver),
        (changed(), "Save as…", Request::SaveAs),
        (Question::ExistingTour { file: file.clone() }, "Open it", Request::Open(file.clone())),
        (Question::ExistingTour { file: file.clone() }, "Begin a new one", Request::Stay),
    ] {
        let mut bench = Bench::pond();
        bench.question = Some(question);
        let mut harness = small(bench);
        press(&mut harness, answer);
        assert_eq!(harness.state().log, [request], "{answer}");
    }
}

#[test]
fn escape_stays_but_never_throws_recovered_marks_away() {
    let recovery = Question::Recovery { name: "lake".into(), age: "ten minutes ago".into() };
    for (question, log) in [(Question::Unsaved, vec![Request::Stay]), (recovery, vec![])] {
        let mut bench = Bench::pond();
        bench.question = Some(question);
        let mut harness = small(bench);
        harness.key_press(Key::Escape);
        harness.step();
        harness.state_mut().question = None;
        harness.run_steps(2);
        assert_eq!(harness.state().log, log);
    }
}

#[test]
fn while_a_question_is_asked_no_key_acts_behind_it() {
    fn press_all(harness: &mut Harness<'_, Bench>) {
        for key in [Key::Num3, Key::ArrowDown, Key::Delete, Key::Backspace, Key::Enter, Key::Escape] {
            harness.key_press(key);
            harness.run_steps(2);
        }
        for key in [Key::Z, Key::Y, Key::S, Key::O] {
            harness.key_press_modifiers(Modifiers::COMMAND, key);
            harness.run_steps(2);
        }
    }
    let mut bench = Bench::pond();
    let selected = Some(Handle::Mark(crate::tour::edit::PointAt::Horizon(0)));
    bench.studio.canvas.selected = selected;
    let mut harness = small(bench);
    // One that no key answers.
    harness.state_mut().question = Some(Question::Recovery { name: "lake".into(), age: "1 h ago".into() });
    harness.run_steps(3);
    press_all(&mut harness);
    let bench = harness.state();
    assert_eq!((bench.studio.step, bench.studio.canvas.selected), (Step::Horizon, selected));
    assert!(bench.log.is_empty(), "asked for: {:?}", bench.log);
    assert_eq!(bench.tour(), &pond());

    harness.state_mut().question = None;
    harness.run_steps(3);
    press_all(&mut harness);
    assert!(harness.state().studio.step == Step::Ground && !harness.state().log.is_empty());
}

#[test]
fn the_start_page_opens() {
    let mut bench = Bench::pond();
    bench.draft = None;
    let mut harness = small(bench);
    press(&mut harness, "Open a picture or tour…");
    press(&mut harness, "lake.tour.ron");
    assert_eq!(
        harness.state().log,
        [Request::OpenDialog, Request::Open(PathBuf::from("/pictures/lake.tour.ron"))]
    );
}

#[test]
fn a_suggestion_is_taken_mended_or_refused() {
    let ends = [PicturePoint::new(0.0, 240.0), PicturePoint::new(1000.0, 244.0)];
    let suggestion = || Suggestion {
        id: 3,
        step: Step::Horizon,
        title: "Horizon".into(),
        reason: "The picture mirrors itself.".into(),
        confidence: 0.9,
        edits: vec![Edit::Horizon(Some(ends))],
        ghosts: vec![Ghost::Line { points: ends.to_vec(), closed: false }],
    };
    for (label, takes, selects) in [("Take", true, false), ("Mend", true, true), ("Refuse", false, false)] {
        let mut bench = Bench::pond();
        bench.suggestions = vec![suggestion()];
        let mut harness = small(bench);
        press(&mut harness, label);
        let bench = harness.state();
        assert_eq!(bench.tour().camera.horizon == Some(ends), takes, "{label}");
        assert_eq!(bench.studio.canvas.selected.is_some(), selects, "{label}");
        assert!(bench.suggestions.is_empty() && bench.log.contains(&Request::DropSuggestion(3)), "{label}");
    }
}

#[test]
fn the_machine_can_be_asked() {
    for (step, label, what) in [
        (Step::Horizon, "Suggest the horizon", SuggestWhat::Horizon),
        (Step::Water, "Suggest water, sky and ground", SuggestWhat::Regions),
        (Step::Pairs, "Suggest pairs", SuggestWhat::Pairs),
        (Step::Ground, "Suggest", SuggestWhat::Everything),
    ] {
        let mut harness = small(Bench::at(step));
        press(&mut harness, label);
        assert_eq!(harness.state().log, [Request::Suggest(what)]);
    }
}
