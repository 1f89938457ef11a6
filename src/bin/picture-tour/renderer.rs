//! Who draws the frames: the graphics card, or the reference ray tracer.

use std::io::Write;
use std::sync::Arc;

use bevy::transform::components::Transform;
use bevy_picture_tour::assemble::AssembledTour;
use bevy_picture_tour::camera::PinholeCamera;
use bevy_picture_tour::headless::HeadlessError;
use bevy_picture_tour::headless::HeadlessTour;
use bevy_picture_tour::motion::Simulation;
use bevy_picture_tour::picture::Picture;
use bevy_picture_tour::picture::color::linear_from_srgb3;
use bevy_picture_tour::picture::color::srgb_from_linear3;
use bevy_picture_tour::plugin::TourAsset;
use bevy_picture_tour::trace::Reference;
use glam::UVec2;

use crate::args::MAX_SIDE;
use crate::failure::Failure;
use crate::open::Opened;

/// Draws what a camera sees.
pub(crate) enum Renderer {
    /// On the graphics card, `side` x `side` times as many pixels as asked for, averaged.
    Gpu { tour: Box<HeadlessTour>, taken_by: PinholeCamera, side: u32 },
    /// On the processor, by the definition of right.
    Reference { tour: Arc<AssembledTour>, motion: Box<Simulation>, samples: u32 },
}

impl Renderer {
    /// A renderer of frames of `size` pixels. Without a graphics adapter, which is told on stderr, or when `reference`
    /// asks for it, the reference; `stop` is asked while that builds the scene.
    pub(crate) fn new(
        opened: Opened,
        size: UVec2,
        samples: u32,
        reference: bool,
        stop: &dyn Fn() -> bool,
    ) -> Result<Self, Failure> {
        let side = if reference { 1 } else { side_of(samples, size)? };
        let built = opened.assemble(stop)?;
        let by_reference = |tour: Arc<AssembledTour>| {
            let marked = opened.asset.tour();
            let land = tour.land(marked);
            let (motion, _) = Simulation::new(marked, &tour.scene, land.as_ref(), &tour.recordings);
            Ok(Self::Reference { tour, motion: Box::new(motion), samples })
        };
        if reference {
            return by_reference(built);
        }
        let taken_by = built.scene.camera;
        let asset = TourAsset::Built(Box::new(opened.asset.tour().clone()), Arc::clone(&built));
        match HeadlessTour::new(asset, size * side, Transform::IDENTITY) {
            Ok(tour) => Ok(Self::Gpu { tour: Box::new(tour), taken_by, side }),
            Err(HeadlessError::NoAdapter) => {
                writeln!(
                    std::io::stderr().lock(),
                    "no graphics adapter was found; rendering with the reference ray tracer instead"
                )
                .map_err(Failure::from)?;
                by_reference(built)
            }
            Err(error) => Err(failure(&opened.name, &error)),
        }
    }

    /// Lets the tour begin anew after so many seconds.
    pub(crate) fn repeat_after(&mut self, seconds: f64) -> Result<(), Failure> {
        match self {
            Self::Gpu { tour, .. } => tour.repeat_after(seconds),
            Self::Reference { motion, .. } => motion.looped(seconds).map(|looped| **motion = looped),
        }
        .map_err(|error| Failure::CannotRun(error.to_string()))
    }

    /// The camera that took the picture.
    pub(crate) fn taken_by(&self) -> PinholeCamera {
        match self {
            Self::Gpu { taken_by, .. } => *taken_by,
            Self::Reference { tour, .. } => tour.scene.camera,
        }
    }

    /// Draws what `camera` sees so many seconds after the tour's start, or in the still picture; its frame has the size that the renderer was made for.
    pub(crate) fn render(
        &mut self,
        camera: &PinholeCamera,
        seconds: Option<f64>,
    ) -> Result<Picture, Failure> {
        match self {
            Self::Gpu { tour, side, .. } => {
                tour.go_to(seconds);
                let intrinsics = camera.intrinsics.scaled_to(camera.intrinsics.size * *side);
                let large = tour
                    .render(&PinholeCamera { intrinsics, pose: camera.pose })
                    .map_err(|error| failure("the frame", &error))?;
                averaged(large, *side)
            }
            Self::Reference { tour, motion, samples } => {
                let reference = Reference::new(&tour.scene, &tour.maps);
                let Some(seconds) = seconds else { return Ok(reference.render(camera, *samples)) };
                motion.go_to(seconds);
                let water = motion.water();
                Ok(reference.with_water(&water).at_moment(motion.moment()).render(camera, *samples))
            }
        }
    }
}

fn failure(name: &str, error: &HeadlessError) -> Failure {
    Failure::CannotRun(format!("{name} cannot be rendered: {error}; try --reference"))
}

/// How many pixels a side stand for one, so that there are `samples` of them.
fn side_of(samples: u32, size: UVec2) -> Result<u32, Failure> {
    let side = samples.isqrt();
    if side * side != samples {
        return Err(Failure::CannotRun(format!(
            "--samples {samples} is not a square, which the graphics card needs; write {} or {}, or add --reference",
            side * side,
            (side + 1) * (side + 1)
        )));
    }
    if (size * side).max_element() > MAX_SIDE {
        return Err(Failure::CannotRun(format!(
            "{} x {} px with --samples {samples} are too large for the graphics card; lower one, or add --reference",
            size.x, size.y
        )));
    }
    Ok(side)
}

/// The picture with blocks of `side` x `side` pixels averaged in linear light.
fn averaged(picture: Picture, side: u32) -> Result<Picture, Failure> {
    if side == 1 {
        return Ok(picture);
    }
    let size = picture.size() / side;
    let pixels =
        (0..size.y).flat_map(|y| (0..size.x).map(move |x| (x * side, y * side))).map(|(left, top)| {
            let mut sum = [0.0_f32; 3];
            for (x, y) in (top..top + side).flat_map(|y| (left..left + side).map(move |x| (x, y))) {
                let light = linear_from_srgb3(picture.pixel(x, y));
                sum = std::array::from_fn(|c| sum[c] + light[c]);
            }
            srgb_from_linear3(sum.map(|sum| sum / (side * side) as f32))
        });
    Picture::new(size, pixels.collect()).map_err(|error| Failure::CannotRun(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_and_white_average_to_half_the_light() {
        let picture = Picture::new(UVec2::new(4, 2), [[[0; 3], [255; 3]]; 4].concat()).unwrap();
        let small = averaged(picture, 2).unwrap();
        assert_eq!((small.size(), small.pixels()), (UVec2::new(2, 1), &[[188; 3]; 2][..]));
    }

    #[test]
    fn samples_on_the_card_are_square_numbers() {
        assert!(matches!(side_of(16, UVec2::new(100, 50)), Ok(4)));
        assert!(side_of(5, UVec2::new(100, 50)).is_err());
        assert!(side_of(4, UVec2::new(16_000, 50)).is_err());
    }
}
