//! The plugin in an app: tours become ready, are told apart, are drawn anywhere, and leave without a trace.

use bevy::camera::visibility::RenderLayers;
use bevy::math::DVec3;
use bevy::prelude::*;
use bevy_picture_tour::plugin::{ObjectMotion, SolvedTour, TourAsset, TourMotion, TourPart, TourWeather};
use bevy_picture_tour::tour::Motion;
use bevy_picture_tour::trace::compare::Comparison;
use bevy_picture_tour::water::body::BodyPose;

use crate::support::stage::Stage;
use crate::support::{adapter, made_scene};

#[test]
fn a_tour_of_the_start_is_ready_after_the_first_update() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    let root = stage.tour(made_scene::source(), Transform::default());
    assert!(stage.heard().ready.is_empty(), "nothing has run yet");
    stage.app.update();
    assert_eq!(stage.heard().ready, [root], "ready after the first update");
    assert!(stage.heard().failed.is_empty(), "{:?}", stage.heard().failed);
    let mut names = stage.child_names(root);
    names.sort();
    assert_eq!(names, ["background", "boat", "post", "water"]);
    let solved = stage.solved(root).expect("what was solved can be asked for");
    let distance = solved.solution.parameters.background_distance;
    assert!(
        (distance / made_scene::DISTANCE - 1.0).abs() < 0.02,
        "{distance} m instead of {}",
        made_scene::DISTANCE
    );

    for _ in 0..30 {
        stage.app.update();
    }
    assert_eq!(stage.heard().ready, [root], "it was built once, not again by its own asset event");
}

#[test]
fn a_tour_of_later_is_built_while_the_game_goes_on() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    stage.app.update();
    let root = stage.tour(made_scene::source(), Transform::default());
    stage.app.update();
    assert!(stage.solved(root).is_none(), "the update that starts the work does not wait for it");
    stage.wait("the tour's being ready", |stage| !stage.heard().ready.is_empty());
    assert_eq!(stage.heard().ready, [root]);
    let parts = stage.child_names(root);
    assert_eq!(parts.len(), 4, "background, boat, post and water: {parts:?}");
    for _ in 0..10 {
        stage.app.update();
    }
    assert_eq!(stage.heard().ready, [root], "it was built once");
}

#[test]
fn a_tour_that_leaves_takes_everything_with_it() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    stage.settle();
    let before = stage.counts();
    let root = stage.tour(made_scene::source(), Transform::default());
    stage.wait("the tour's being ready", |stage| !stage.heard().ready.is_empty());
    stage.settle();
    let shown = stage.counts();
    // Root, four parts, four depth passes; four meshes; records, waves, three texture maps, the atlas.
    assert_eq!(
        [0, 1, 2].map(|i| shown[i] - before[i]),
        [9, 4, 6],
        "entities, meshes, images of a shown tour"
    );

    stage.app.world_mut().entity_mut(root).despawn();
    for _ in 0..5 {
        stage.app.update();
    }
    assert_eq!(stage.counts(), before, "entities, meshes, images after it left");
    let world = stage.app.world_mut();
    assert_eq!(world.query::<&TourPart>().iter(world).count(), 0, "parts that stayed");
    assert_eq!(world.resource::<Assets<TourAsset>>().len(), 0, "tours that stayed");
}

#[test]
fn two_tours_are_both_drawn_where_they_are() {
    let Some(_gpu) = adapter() else { return };
    let source = made_scene::source();
    let mut stage = Stage::new();
    let near = stage.tour(source.clone(), Transform::default());
    // Far behind and above the first one, turned away from it.
    let place = Transform::from_xyz(300.0, 40.0, 5000.0).with_rotation(Quat::from_rotation_y(2.6));
    let far = stage.tour(source.clone(), place);
    let targets = [near, far].map(|tour| stage.camera(tour, made_scene::SIZE, Msaa::Off));
    for (target, name) in targets.iter().zip(["first", "second"]) {
        let shot = stage.shot(target, made_scene::SIZE);
        let found = Comparison::of(&shot, &source.picture).unwrap();
        assert!(
            found.max_code_difference <= 1,
            "the {name} tour is {} codes off at worst, {} % within 1",
            found.max_code_difference,
            100.0 * found.share_within(1)
        );
    }
}

#[test]
fn a_tour_may_be_moved_while_it_is_shown() {
    let Some(_gpu) = adapter() else { return };
    let source = made_scene::source();
    let mut stage = Stage::new();
    let root = stage.tour(source.clone(), Transform::default());
    let target = stage.camera(root, made_scene::SIZE, Msaa::Off);
    stage.settle();
    let place = Transform::from_xyz(-20.0, 3.0, 8.0).with_rotation(Quat::from_rotation_y(1.0));
    *stage.app.world_mut().get_mut::<Transform>(root).unwrap() = place;
    let found = Comparison::of(&stage.shot(&target, made_scene::SIZE), &source.picture).unwrap();
    assert!(found.max_code_difference <= 1, "{} codes off at worst", found.max_code_difference);
}

#[test]
fn children_follow_the_root_s_render_layers() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    let root = stage.tour(made_scene::source(), Transform::default());
    stage.app.world_mut().entity_mut(root).insert(RenderLayers::layer(3));
    stage.app.update();
    for layer in [3, 5] {
        stage.app.world_mut().entity_mut(root).insert(RenderLayers::layer(layer));
        stage.app.update();
        let parts = stage.descendants(root);
        assert_eq!(parts.len(), 8, "four parts and their depth passes");
        for part in parts {
            let found = stage.app.world().get::<RenderLayers>(part);
            assert_eq!(found, Some(&RenderLayers::layer(layer)), "layers of {part}");
        }
    }
    stage.app.world_mut().entity_mut(root).remove::<RenderLayers>();
    stage.app.update();
    let stay = stage
        .descendants(root)
        .into_iter()
        .filter(|part| stage.app.world().get::<RenderLayers>(*part).is_some());
    assert_eq!(stay.count(), 0, "parts that keep layers which the root has no more");
}

#[test]
fn a_tour_that_cannot_be_solved_fails_and_says_why() {
    let Some(_gpu) = adapter() else { return };
    let mut source = (*made_scene::source()).clone();
    // A horizon far from the pairs' own, and no pair kept: nothing is left to solve from.
    let mut file = source.tour.to_file();
    file.camera.horizon = None;
    let water = file.water.as_mut().unwrap();
    water.pairs.truncate(2);
    water.pairs[1].reflection = water.pairs[0].reflection;
    water.pairs[1].reflection.0.x += 60.0;
    let Ok(tour) = bevy_picture_tour::tour::Tour::check(file) else { panic!("the marks are possible ones") };
    source.tour = tour;
    let mut stage = Stage::new();
    let root = stage.tour(source.into(), Transform::default());
    stage.app.update();
    let failed = &stage.heard().failed;
    let (Some((entity, error)), true) = (failed.first(), stage.heard().ready.is_empty()) else {
        panic!("{} ready, failed: {failed:?}", stage.heard().ready.len())
    };
    assert_eq!(*entity, root);
    assert!(error.contains("reflection pairs"), "{error}");
    assert!(stage.app.world().get::<SolvedTour>(root).is_none());
}

#[test]
fn a_game_moves_a_tour_s_objects_and_turns_its_wind() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    let root = stage.tour(made_scene::source(), Transform::default());
    let target = stage.camera(root, made_scene::SIZE, ());
    stage.settle();
    let still = stage.shot(&target, made_scene::SIZE);
    let world = stage.app.world_mut();
    let mut objects = world.query::<(Entity, &Name, &ObjectMotion)>();
    let (boat, ..) = objects.iter(world).find(|(_, name, _)| name.as_str() == "boat").expect("it can move");

    let pose = BodyPose { position: DVec3::new(0.8, 0.2, 0.0), ..BodyPose::default() };
    stage.app.world_mut().entity_mut(boat).insert(ObjectMotion::Led(pose));
    stage.settle();
    let led = Comparison::of(&stage.shot(&target, made_scene::SIZE), &still).unwrap();
    assert!(led.mean_difference > 0.3, "the boat stays: a mean difference of {} codes", led.mean_difference);

    stage.app.world_mut().entity_mut(boat).insert(ObjectMotion::Own(Motion::Static));
    stage.settle();
    let back = Comparison::of(&stage.shot(&target, made_scene::SIZE), &still).unwrap();
    assert_eq!(back.max_code_difference, 0, "it does not come back");

    let mut weather = *stage.app.world().get::<TourWeather>(root).expect("a tour has its weather");
    weather.wind.speed = 4.0;
    stage.app.world_mut().entity_mut(root).insert(weather);
    stage.app.update();
    let motion = stage.app.world().get::<TourMotion>(root).expect("a tour has its motion");
    assert_eq!(motion.simulation().weather_to_come().wind.speed, 4.0);
}
