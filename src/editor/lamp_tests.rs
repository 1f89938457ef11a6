//! Facts about the lamps: when a step is missing, rough or good.

use glam::UVec2;

use super::*;
use crate::editor::tests::{pond, solved_pond};
use crate::tour::{BackgroundPlace, FocalLength, ReflectionPair, Tour, TourFile};

const WIDTH: u32 = 1000;

fn lamp(step: Step, tour: &TourFile, solution: Option<&Solution>) -> StepState {
    step_state(step, tour, &[], solution, WIDTH)
}

#[test]
fn nothing_marked_is_missing_everywhere() {
    let tour = TourFile::new("lake.png".into());
    for step in Step::ALL {
        let state = lamp(step, &tour, None);
        assert_eq!(state.lamp, Lamp::Missing, "{step:?}");
        assert!(!state.needs.is_empty(), "{step:?} says nothing");
    }
}

#[test]
fn a_first_horizon_is_not_blamed_for_the_missing_water() {
    let mut tour = TourFile::new("lake.png".into());
    tour.camera.horizon = pond().camera.horizon;
    let problems = Tour::check(tour.clone()).unwrap_err().0;
    assert!(!problems.is_empty());
    for (step, needs) in [(Step::Horizon, [Need::HorizonUnsure]), (Step::Water, [Need::Water])] {
        assert_eq!(step_state(step, &tour, &problems, None, WIDTH).needs, needs, "{step:?}");
    }
}

#[test]
fn a_horizon_is_rough_until_the_solution_confirms_it() {
    let (tour, solution) = (pond(), solved_pond());
    assert_eq!(lamp(Step::Horizon, &tour, None).lamp, Lamp::Rough);
    assert_eq!(lamp(Step::Horizon, &tour, Some(&solution)), StepState { lamp: Lamp::Good, needs: vec![] });
    let mut off = tour;
    let shift = |PicturePoint(point)| PicturePoint(point + glam::DVec2::new(0.0, 25.0));
    off.camera.horizon = off.camera.horizon.map(|ends| ends.map(shift));
    let state = lamp(Step::Horizon, &off, Some(&solution));
    let [Need::HorizonOff(pixels)] = state.needs[..] else { panic!("{state:?}") };
    assert_eq!(state.lamp, Lamp::Rough);
    assert!((pixels - 25.0).abs() < 1.0, "{pixels} px instead of 25");
}

#[test]
fn what_was_drafted_is_rough_until_somebody_has_looked_at_it() {
    let (mut tour, solution) = (pond(), solved_pond());
    assert_eq!(lamp(Step::Water, &tour, Some(&solution)).lamp, Lamp::Good);
    let is_rough = |tour: &TourFile| {
        lamp(Step::Water, tour, Some(&solution))
            == StepState { lamp: Lamp::Rough, needs: vec![Need::Guess(RegionAt::Water)] }
    };
    for (name, is_guess) in [
        ("masks/draft/water.png", true),
        ("masks/draft-2/water.png", true),
        ("pond.masks/water.png", true),
        ("pond.masks_2/water.png", true),
        ("masks/water.png", false),
        ("masks/drafty/water.png", false),
        ("masks.old/water.png", false),
        ("water.png", false),
    ] {
        tour.water.as_mut().unwrap().region = Region::Mask(name.into());
        assert_eq!(is_rough(&tour), is_guess, "{name}");
    }
}

#[test]
fn pairs_are_good_when_enough_agree_and_the_lens_is_known() {
    let (mut tour, mut solution) = (pond(), solved_pond());
    let water = tour.water.as_mut().unwrap();
    water.pairs.clear();
    assert_eq!(lamp(Step::Pairs, &tour, Some(&solution)).needs, [Need::Pairs(4)]);
    let at = |x: f64| ReflectionPair {
        point: PicturePoint::new(x, 200.0),
        reflection: PicturePoint::new(x, 420.0),
        on: None,
        name: None,
    };
    tour.water.as_mut().unwrap().pairs = [100.0, 130.0, 160.0].map(at).to_vec();
    assert_eq!(lamp(Step::Pairs, &tour, None).needs, [Need::Pairs(1)]);
    tour.water.as_mut().unwrap().pairs.push(at(190.0));
    let crowded = lamp(Step::Pairs, &tour, Some(&solution)).needs;
    assert!(crowded.contains(&Need::PairsSpread), "{crowded:?}");
    tour.water.as_mut().unwrap().pairs.push(at(800.0));
    for label in [Label::Assumed, Label::Measured] {
        solution.report.parameters[0].label = label;
        let state = lamp(Step::Pairs, &tour, Some(&solution));
        let is_known = label == Label::Measured;
        assert_eq!(state.lamp == Lamp::Good, is_known, "{state:?}");
        assert_eq!(state.needs.contains(&Need::FocalLength), !is_known, "{state:?}");
    }
}

#[test]
fn what_the_check_finds_stands_at_its_step() {
    let mut tour = pond();
    tour.camera.focal_length = FocalLength::Known(-1.0);
    tour.background.place = Some(BackgroundPlace::Distance(-5.0));
    let problems = Tour::check(tour.clone()).unwrap_err().0;
    for step in Step::ALL {
        let state = step_state(step, &tour, &problems, Some(&solved_pond()), WIDTH);
        let has_problem = state.needs.iter().any(|need| matches!(need, Need::Problem(_)));
        assert_eq!(has_problem, matches!(step, Step::Horizon | Step::Ground), "{step:?}: {state:?}");
        assert!(!has_problem || state.lamp == Lamp::Rough);
    }
}

#[test]
fn an_object_above_the_horizon_is_named() {
    let (mut tour, solution) = (pond(), solved_pond());
    assert_eq!(lamp(Step::Objects, &tour, Some(&solution)).lamp, Lamp::Good);
    tour.objects[0].contact = [PicturePoint::new(600.0, 50.0), PicturePoint::new(700.0, 50.0)];
    assert_eq!(lamp(Step::Objects, &tour, Some(&solution)).needs, [Need::Contact("boat".into())]);
    let camera = solution.parameters.camera(UVec2::new(WIDTH, 600));
    assert!(camera.horizon().unwrap()[0].y() > 50.0);
}
