//! A small lake made in code: a boat and a post in still water before a patterned wall, painted by a ray caster that
//! knows every plane, so that whatever is recovered from the picture can be held against the truth.
//!
//! Meters and axes are the tour's own. Light is linear; the water gives back 0.7 of what it mirrors and adds a blue of
//! its own, at any angle.

use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

use bevy_picture_tour::assemble::TourSource;
use bevy_picture_tour::camera::{CameraPose, Intrinsics, PinholeCamera, Ray};
use bevy_picture_tour::picture::color::srgb_from_linear3;
use bevy_picture_tour::picture::{Picture, PicturePoint, PngPixels, encode_png};
use bevy_picture_tour::tour::{
    Document, FocalLength, Motion, Object, ReflectionPair, Region, Scale, Support, Tour, TourFile, WaterArea,
};
use glam::{DVec2, DVec3, UVec2};

/// The picture's size in pixels.
pub(crate) const SIZE: UVec2 = UVec2::new(320, 180);
/// Focal length, pixels.
pub(crate) const FOCAL_PX: f64 = 280.0;
/// Height above the water, meters.
pub(crate) const HEIGHT: f64 = 1.6;
/// The camera looks down a little, degrees.
pub(crate) const PITCH_DEG: f64 = -3.0;
/// Where the wall behind everything stands, meters ahead.
pub(crate) const DISTANCE: f64 = 40.0;

/// What the water gives back of what it mirrors, and what it adds, linear light.
const REFLECT: f32 = 0.7;
const TINT: [f32; 3] = [0.006, 0.014, 0.03];

/// Rays a pixel, along each side.
const SAMPLES: u32 = 4;

/// Something upright and frontal that stands in the water.
struct Body {
    name: &'static str,
    /// Meters ahead.
    depth: f64,
    /// Left and right foot, meters.
    feet: [f64; 2],
    /// Whether it fills a point (across, up) of its plane.
    fills: fn(DVec2) -> bool,
    color: fn(DVec2) -> [f32; 3],
    /// Points of it that people mark, meters across and up.
    marks: [DVec2; 3],
}

/// Near to far.
const BODIES: [Body; 2] = [
    Body {
        name: "post",
        depth: 7.0,
        feet: [1.5, 1.9],
        fills: |p| (1.5..1.9).contains(&p.x) && (0.0..2.1).contains(&p.y),
        color: |p| shade([0.30, 0.20, 0.12], (3.0 * p.y).sin()),
        marks: [DVec2::new(1.5, 0.8), DVec2::new(1.9, 0.6), DVec2::new(1.7, 0.3)],
    },
    Body {
        name: "boat",
        depth: 10.0,
        feet: [-2.4, 0.6],
        // A hull that widens upwards, and a cabin.
        fills: |p| {
            let hull = (0.0..0.7).contains(&p.y) && p.x > -2.4 - 0.3 * p.y && p.x < 0.6 + 0.3 * p.y;
            hull || ((-1.6..-0.4).contains(&p.x) && (0.7..1.5).contains(&p.y))
        },
        color: |p| shade([0.45, 0.10, 0.08], (4.0 * p.x).sin() * (5.0 * p.y).cos()),
        marks: [DVec2::new(-1.6, 1.5), DVec2::new(-0.4, 1.5), DVec2::new(0.81, 0.7)],
    },
];

/// Points of the wall that people mark, meters across and up.
const WALL_MARKS: [DVec2; 4] =
    [DVec2::new(-15.0, 6.0), DVec2::new(-9.0, 9.0), DVec2::new(4.0, 8.0), DVec2::new(16.0, 4.0)];

fn shade(color: [f32; 3], by: f64) -> [f32; 3] {
    color.map(|x| x * (1.0 + 0.3 * by as f32))
}

/// The wall: patterned land up to 7 m, sky above.
fn wall(p: DVec2) -> [f32; 3] {
    let share = ((p.y - 6.5) / 1.0).clamp(0.0, 1.0) as f32;
    let land = shade([0.10, 0.16, 0.06], (TAU * p.x / 4.0).sin() * (TAU * p.y / 3.0).cos());
    let high = (p.y / 40.0).clamp(0.0, 1.0) as f32;
    let sky = [0.75 - 0.4 * high, 0.78 - 0.3 * high, 0.85 - 0.1 * high];
    [0, 1, 2].map(|c| land[c] * (1.0 - share) + sky[c] * share)
}

/// What a ray sees first.
#[derive(Clone, Copy, PartialEq)]
enum Seen {
    Body(usize),
    Wall,
    Water,
}

fn look(ray: Ray) -> (Seen, [f32; 3]) {
    let on_plane = |depth: f64| {
        let t = (-depth - ray.origin.z) / ray.direction.z;
        (t > 0.0).then(|| ray.at(t)).map(|point| DVec2::new(point.x, point.y))
    };
    for (index, body) in BODIES.iter().enumerate() {
        if let Some(point) = on_plane(body.depth).filter(|point| (body.fills)(*point)) {
            return (Seen::Body(index), (body.color)(point));
        }
    }
    match on_plane(DISTANCE) {
        Some(point) if point.y >= 0.0 => (Seen::Wall, wall(point)),
        _ => {
            let water = ray.at(-ray.origin.y / ray.direction.y);
            let up = DVec3::new(ray.direction.x, -ray.direction.y, ray.direction.z);
            // A hair above the surface, so that nothing is met twice.
            let (_, color) = look(Ray { origin: water + 1e-9 * DVec3::Y, direction: up });
            (Seen::Water, [0, 1, 2].map(|c| REFLECT * color[c] + TINT[c]))
        }
    }
}

/// The camera that paints the picture.
pub(crate) fn camera() -> PinholeCamera {
    PinholeCamera {
        intrinsics: Intrinsics {
            focal_px: FOCAL_PX,
            principal: PicturePoint(SIZE.as_dvec2() / 2.0),
            size: SIZE,
        },
        pose: CameraPose::from_angles(DVec3::new(0.0, HEIGHT, 0.0), 0.0, PITCH_DEG.to_radians(), 0.0),
    }
}

/// What `camera` truly sees, and how much of each pixel is what.
fn paint(camera: &PinholeCamera) -> (Picture, Vec<[u8; 3]>) {
    let size = camera.intrinsics.size;
    let count = (SAMPLES * SAMPLES) as f32;
    let (mut pixels, mut shares) = (Vec::new(), Vec::new());
    for i in 0..size.x * size.y {
        let corner = UVec2::new(i % size.x, i / size.x).as_dvec2();
        let (mut light, mut share) = ([0.0_f32; 3], [0.0_f32; 3]);
        for s in 0..SAMPLES * SAMPLES {
            let inside = (UVec2::new(s % SAMPLES, s / SAMPLES).as_dvec2() + 0.5) / f64::from(SAMPLES);
            let (seen, color) = look(camera.ray(PicturePoint(corner + inside)));
            light = [0, 1, 2].map(|c| light[c] + color[c] / count);
            match seen {
                Seen::Body(index) => share[index] += 1.0 / count,
                Seen::Water => share[2] += 1.0 / count,
                Seen::Wall => {}
            }
        }
        pixels.push(srgb_from_linear3(light));
        shares.push(share.map(|x| (255.0 * x).round() as u8));
    }
    (Picture::new(size, pixels).unwrap(), shares)
}

/// What `camera` truly sees.
pub(crate) fn truth(camera: &PinholeCamera) -> Picture {
    paint(camera).0
}

/// The picture as if it hung as a whole on the wall: what a camera elsewhere would see without any depth.
pub(crate) fn flat(camera: &PinholeCamera, picture: &Picture) -> Picture {
    let own = self::camera();
    let last = SIZE.as_dvec2() - 1.0;
    let pixels = (0..SIZE.x * SIZE.y).map(|i| {
        let ray = camera.ray(PicturePoint::pixel_center(i64::from(i % SIZE.x), i64::from(i / SIZE.x)));
        let on_wall = ray.at((-DISTANCE - ray.origin.z) / ray.direction.z);
        let at = own.project(on_wall).map_or(DVec2::ZERO, |point| point.0);
        let nearest = at.floor().clamp(DVec2::ZERO, last).as_uvec2();
        picture.pixel(nearest.x, nearest.y)
    });
    Picture::new(SIZE, pixels.collect()).unwrap()
}

/// A point and its reflection as a person marks them, to a quarter of a pixel.
fn pair(on: &str, across: f64, up: f64, depth: f64) -> ReflectionPair {
    let camera = camera();
    let mark = |y: f64| {
        let seen = camera.project(DVec3::new(across, y, -depth)).expect("a mark should be ahead");
        PicturePoint((seen.0 * 4.0).round() / 4.0)
    };
    ReflectionPair { point: mark(up), reflection: mark(-up), on: Some(on.to_owned()), name: None }
}

/// The tour that a careful person would write about the picture: horizon and focal length known.
pub(crate) fn tour() -> Tour {
    let camera = camera();
    let mut tour: TourFile = Document::new("lake.png".to_owned());
    tour.picture.size = Some(SIZE);
    tour.camera.horizon = camera.horizon();
    tour.camera.focal_length = FocalLength::Known(FOCAL_PX);
    tour.camera.scale = Some(Scale::HeightAboveWater(HEIGHT));
    let mut pairs: Vec<_> = WALL_MARKS.iter().map(|p| pair("background", p.x, p.y, DISTANCE)).collect();
    for body in &BODIES {
        pairs.extend(body.marks.iter().map(|p| pair(body.name, p.x, p.y, body.depth)));
        let foot = |x: f64| camera.project(DVec3::new(x, 0.0, -body.depth)).expect("feet are ahead");
        tour.objects.push(Object {
            name: body.name.to_owned(),
            support: Support::Water,
            outline: Region::Mask(format!("masks/{}.png", body.name)),
            contact: body.feet.map(foot),
            turns_to_camera: false,
            motion: Motion::Static,
        });
    }
    tour.water = Some(WaterArea { region: Region::Mask("masks/water.png".to_owned()), pairs });
    Tour::check(tour).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The files that the tour names, as bytes.
pub(crate) fn files() -> &'static [(String, Vec<u8>)] {
    static FILES: OnceLock<Vec<(String, Vec<u8>)>> = OnceLock::new();
    FILES.get_or_init(|| {
        let (picture, shares) = paint(&camera());
        let mask = |index: usize| {
            let values: Vec<u8> = shares.iter().map(|share| share[index]).collect();
            encode_png(SIZE, PngPixels::Gray(&values)).unwrap()
        };
        let names = BODIES.iter().map(|body| body.name).chain(["water"]);
        let mut files: Vec<_> =
            names.enumerate().map(|(i, name)| (format!("masks/{name}.png"), mask(i))).collect();
        files.push(("lake.png".to_owned(), encode_png(SIZE, PngPixels::Rgb(picture.pixels())).unwrap()));
        files
    })
}

/// The tour with its pixels.
pub(crate) fn source() -> Arc<TourSource> {
    let read = |wanted: &str| files().iter().find(|(name, _)| name == wanted).map(|(_, bytes)| bytes.clone());
    let source = TourSource::read(&tour(), &|file| read(file.as_str()).ok_or_else(|| "not made".to_owned()));
    Arc::new(source.unwrap_or_else(|problems| panic!("{problems}")))
}

/// Writes the tour as `lake.tour.ron` with its files into `folder`.
pub(crate) fn write_to(folder: &std::path::Path) {
    std::fs::create_dir_all(folder.join("masks")).unwrap();
    for (name, bytes) in files() {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
    std::fs::write(folder.join("lake.tour.ron"), tour().write()).unwrap();
}
