//! A tour is a good guest: it leaves the game's cameras and meshes alone and is drawn rightly among them.

use bevy::camera::{Hdr, RenderTarget, Viewport};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;
use bevy_picture_tour::camera::PinholeCamera;
use bevy_picture_tour::picture::Picture;
use bevy_picture_tour::plugin::{ColorPolicy, TourCamera};
use bevy_picture_tour::trace::compare::Comparison;
use glam::DVec3;

use crate::support::stage::Stage;
use crate::support::{adapter, made_scene};

const MAGENTA: [u8; 3] = [255, 0, 255];

#[test]
fn a_camera_of_the_game_stays_as_it_is() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    let root = stage.tour(made_scene::source(), Transform::default());
    let _watched = stage.camera(root, made_scene::SIZE, Msaa::Off);
    let target = stage.target(made_scene::SIZE);
    let lens = PerspectiveProjection { fov: 0.7, near: 0.2, far: 77.0, ..default() };
    let place = Transform::from_xyz(0.5, 2.0, 1.0).with_rotation(Quat::from_rotation_y(0.1));
    let bundle =
        (Camera3d::default(), Projection::Perspective(lens), Tonemapping::AcesFitted, Msaa::Sample4, place);
    let guest = stage.app.world_mut().spawn((bundle, RenderTarget::from(target.clone()))).id();
    // Bevy itself fits the aspect ratio to the target once.
    stage.app.update();
    let state = |stage: &Stage| {
        let entity = stage.app.world().entity(guest);
        [
            format!("{:?}", entity.get::<Projection>()),
            format!("{:?}", entity.get::<Tonemapping>()),
            format!("{:?}", entity.get::<Msaa>()),
            format!("{:?}", entity.get::<Transform>()),
            format!("{:?}", entity.get::<Camera>().and_then(|camera| camera.viewport.clone())),
        ]
    };
    let before = state(&stage);
    let shot = stage.shot(&target, made_scene::SIZE);
    assert_eq!(
        state(&stage),
        before,
        "projection, tonemapping, MSAA, transform and viewport of the game's camera"
    );
    let first = shot.pixel(0, 0);
    assert!(shot.pixels().iter().any(|pixel| *pixel != first), "the game's camera sees the tour too");
}

/// Where the picture's camera sees a point of the tour, as pixel indices.
fn pixel_of(camera: &PinholeCamera, point: DVec3) -> [u32; 2] {
    let seen = camera.project(point).expect("the point should be ahead").0;
    [seen.x as u32, seen.y as u32]
}

#[test]
fn meshes_of_the_game_hide_and_are_hidden() {
    let Some(_gpu) = adapter() else { return };
    let source = made_scene::source();
    let mut stage = Stage::new();
    // Away from the game's origin, so that the game's space is not the tour's.
    let place = Transform::from_xyz(12.0, -3.0, 7.0).with_rotation(Quat::from_rotation_y(-0.8));
    let root = stage.tour(source.clone(), place);
    let target = stage.camera(root, made_scene::SIZE, Msaa::Off);

    // Centers in the tour's space: before everything, between boat and wall but hidden by the boat's cabin, between
    // them and free, behind the wall, under the water.
    let before = DVec3::new(-1.0, 1.2, -4.0);
    let covered = DVec3::new(-1.5, 0.9, -15.0);
    let free = DVec3::new(8.0, 3.0, -20.0);
    let behind = DVec3::new(-12.0, 6.0, -60.0);
    let sunk = DVec3::new(3.5, -0.8, -9.0);
    let world = stage.app.world_mut();
    let cube = world.resource_mut::<Assets<Mesh>>().add(Cuboid::from_length(0.4));
    let color = Color::srgb_u8(MAGENTA[0], MAGENTA[1], MAGENTA[2]);
    let paint = StandardMaterial { base_color: color, unlit: true, ..default() };
    let paint = world.resource_mut::<Assets<StandardMaterial>>().add(paint);
    for point in [before, covered, free, behind, sunk] {
        let at = place * Transform::from_translation(point.as_vec3());
        world.spawn((Mesh3d(cube.clone()), MeshMaterial3d(paint.clone()), at));
    }
    stage.wait("the tour's being ready", |stage| !stage.heard().ready.is_empty());
    let camera = stage.solved(root).unwrap().scene.camera;
    let shot = stage.shot(&target, made_scene::SIZE);

    for (point, name) in [(before, "before everything"), (free, "between boat and wall")] {
        let [x, y] = pixel_of(&camera, point);
        assert_eq!(shot.pixel(x, y), MAGENTA, "the cube {name} should be seen at ({x}, {y})");
    }
    for (point, name) in
        [(covered, "behind the boat"), (behind, "behind the wall"), (sunk, "under the water")]
    {
        let [x, y] = pixel_of(&camera, point);
        let (found, expected) = (shot.pixel(x, y), source.picture.pixel(x, y));
        assert!(
            near(found, expected),
            "the cube {name} shows at ({x}, {y}): {found:?} instead of {expected:?}"
        );
    }
    // Nothing but the two cubes differs from the picture.
    let other = differing(&shot, &source.picture).filter(|(found, _)| *found != MAGENTA).count();
    assert_eq!(other, 0, "pixels that are neither the picture's nor a cube's");
}

fn near(a: [u8; 3], b: [u8; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1)
}

/// The pixels of two pictures that differ by more than a code.
fn differing<'a>(a: &'a Picture, b: &'a Picture) -> impl Iterator<Item = ([u8; 3], [u8; 3])> + 'a {
    a.pixels().iter().copied().zip(b.pixels().iter().copied()).filter(|(a, b)| !near(*a, *b))
}

#[test]
fn hdr_and_msaa_cameras_show_the_picture_s_codes() {
    let Some(_gpu) = adapter() else { return };
    let source = made_scene::source();
    let mut stage = Stage::new();
    let root = stage.tour(source.clone(), Transform::default());
    let targets = [
        ("plain", stage.camera(root, made_scene::SIZE, Msaa::Off)),
        ("MSAA 4x", stage.camera(root, made_scene::SIZE, Msaa::Sample4)),
        ("Hdr", stage.camera(root, made_scene::SIZE, (Msaa::Off, Hdr, Tonemapping::None))),
        ("Hdr and MSAA 4x", stage.camera(root, made_scene::SIZE, (Msaa::Sample4, Hdr, Tonemapping::None))),
    ];
    for (name, target) in &targets {
        let found = Comparison::of(&stage.shot(target, made_scene::SIZE), &source.picture).unwrap();
        assert!(
            found.max_code_difference <= 1,
            "{name}: {} codes off at worst, {} % within 1",
            found.max_code_difference,
            100.0 * found.share_within(1)
        );
    }
}

#[test]
fn a_graded_tour_follows_the_camera_s_tonemapping_and_an_exact_one_does_not() {
    let Some(_gpu) = adapter() else { return };
    let source = made_scene::source();
    let mut stage = Stage::new();
    let root = stage.tour(source.clone(), Transform::default());
    let target = stage.camera(root, made_scene::SIZE, (Msaa::Off, Tonemapping::Reinhard));
    let brightness = |shot: &Picture| {
        let sum: u64 = shot.pixels().iter().flatten().map(|code| u64::from(*code)).sum();
        sum as f64 / (3 * shot.pixels().len()) as f64
    };

    let exact = stage.shot(&target, made_scene::SIZE);
    stage.app.world_mut().entity_mut(root).insert(ColorPolicy::Graded);
    let graded = stage.shot(&target, made_scene::SIZE);
    stage.app.world_mut().entity_mut(root).insert(ColorPolicy::Exact);
    let again = stage.shot(&target, made_scene::SIZE);

    for (name, shot) in [("at first", &exact), ("after grading", &again)] {
        let found = Comparison::of(shot, &source.picture).unwrap();
        assert!(found.max_code_difference <= 1, "{name}: {} codes off", found.max_code_difference);
    }
    // Reinhard's curve darkens whatever is not black.
    let (plain, toned) = (brightness(&exact), brightness(&graded));
    assert!(toned < 0.95 * plain, "mean code {toned:.1} graded, {plain:.1} exact");
}

#[test]
fn a_contained_picture_keeps_its_shape_and_a_game_s_viewport_stays() {
    let Some(_gpu) = adapter() else { return };
    let mut stage = Stage::new();
    let root = stage.tour(made_scene::source(), Transform::default());
    let tall = UVec2::new(made_scene::SIZE.x, 2 * made_scene::SIZE.y);
    let target = stage.target(tall);
    let own =
        Viewport { physical_position: UVec2::new(3, 5), physical_size: UVec2::new(99, 77), ..default() };
    let looks = || TourCamera { tour: Some(root), listens: false, ..default() };
    let given = Camera { viewport: Some(own.clone()), order: 1, ..default() };
    let split = stage.app.world_mut().spawn((looks(), given, RenderTarget::from(target.clone()))).id();
    let free = stage.app.world_mut().spawn((looks(), RenderTarget::from(target.clone()), Msaa::Off)).id();
    stage.settle();

    let viewport = |entity: Entity| {
        let camera = stage.app.world().get::<Camera>(entity).expect("a camera");
        camera.viewport.as_ref().map(|view| (view.physical_position, view.physical_size))
    };
    assert_eq!(viewport(split), Some((own.physical_position, own.physical_size)), "the game's viewport");
    let bars = UVec2::new(0, made_scene::SIZE.y / 2);
    assert_eq!(viewport(free), Some((bars, made_scene::SIZE)), "the letterbox");
}
