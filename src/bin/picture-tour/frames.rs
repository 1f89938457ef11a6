//! Which frames `render` writes: what each is called, and where its camera stands.

use std::ops::Range;

use bevy_picture_tour::camera::CameraPath;
use bevy_picture_tour::camera::CameraPose;
use bevy_picture_tour::tour;
use bevy_picture_tour::tour::Tour;

use crate::args::RenderArguments;
use crate::failure::Failure;
use crate::views;

/// One picture to write.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Its file's name.
    pub(crate) file: String,
    /// Where the camera stands and looks; `None` where the picture was taken from.
    pub(crate) pose: Option<CameraPose>,
    /// How long after the tour's start it is; `None` for the still picture.
    pub(crate) seconds: Option<f64>,
}

/// The frames that the arguments ask for; never none.
pub(crate) fn planned(arguments: &RenderArguments, tour: &Tour) -> Result<Vec<Frame>, Failure> {
    let path = tour.path.as_ref().and_then(tour::CameraPath::way);
    let moving = |seconds: f64| (!arguments.still).then_some(seconds);
    if let Some(file) = &arguments.views {
        let views = views::read(file)?.into_iter();
        return Ok(views
            .map(|view| Frame { file: format!("{}.png", view.name), pose: Some(view.pose), seconds: None })
            .collect());
    }
    if let Some(seconds) = arguments.at {
        let pose = path.map(|path| path.at(seconds));
        return Ok(vec![Frame { file: format!("at_{seconds:.3}s.png"), pose, seconds: moving(seconds) }]);
    }
    if let Some(seconds) = arguments.loop_seconds {
        let count = loop_count(seconds, arguments.fps);
        let round = match path {
            _ if !arguments.path => None,
            Some(path) if path.is_looped() => Some(path),
            Some(_) => {
                return Err(Failure::CannotRun(
                    "the tour's path ends elsewhere than it begins; add `looped: true` to it, or leave --path out"
                        .to_owned(),
                ));
            }
            None => return Err(no_path()),
        };
        let length = loop_length(seconds, arguments.fps);
        let rounds = |path: &CameraPath| (length / path.duration()).round().max(1.0);
        let pose = |seconds: f64| {
            round.as_ref().map(|path| path.at(seconds / length * rounds(path) * path.duration()))
        };
        return Ok(range(arguments, count)?.map(|index| frame(arguments, index, pose, Some)).collect());
    }
    if !arguments.path {
        if arguments.frames.is_some() {
            return Err(Failure::CannotRun("--frames needs a film; add --path or --loop SECONDS".to_owned()));
        }
        return Ok(vec![Frame { file: "first_view.png".to_owned(), pose: None, seconds: None }]);
    }
    let path = path.ok_or_else(no_path)?;
    let range = range(arguments, count(&path, arguments.fps))?;
    Ok(range.map(|index| frame(arguments, index, |seconds| Some(path.at(seconds)), moving)).collect())
}

/// How long a loop is, so that it has a whole number of frames.
pub(crate) fn loop_length(seconds: f64, fps: u32) -> f64 {
    f64::from(loop_count(seconds, fps)) / f64::from(fps)
}

fn loop_count(seconds: f64, fps: u32) -> u32 {
    (seconds * f64::from(fps)).round() as u32
}

/// One frame of a film.
fn frame(
    arguments: &RenderArguments,
    index: u32,
    pose: impl Fn(f64) -> Option<CameraPose>,
    moving: impl Fn(f64) -> Option<f64>,
) -> Frame {
    let seconds = f64::from(index) / f64::from(arguments.fps);
    Frame { file: format!("frame_{index:05}.png"), pose: pose(seconds), seconds: moving(seconds) }
}

/// Which of a film's frames are asked for.
fn range(arguments: &RenderArguments, count: u32) -> Result<Range<u32>, Failure> {
    arguments.frames.map_or(Some(0..count), |frames| frames.of(count)).ok_or_else(|| {
        Failure::CannotRun(format!(
            "the film has {count} frames at {} a second, so --frames begins beyond its end; ask for frames from \
             0..{count}",
            arguments.fps
        ))
    })
}

fn no_path() -> Failure {
    Failure::CannotRun(
        "the tour has no camera path; add `path: (keyframes: [...])` to it, or use --views".to_owned(),
    )
}

/// Frames of a path: an open one has a frame at its end, a looped one goes on with its first instead.
fn count(path: &CameraPath, fps: u32) -> u32 {
    // A rounding error must not cost the last frame.
    let steps = path.duration() * f64::from(fps) + 1e-6;
    if path.is_looped() { (steps as u32).max(1) } else { (steps as u32).saturating_add(1) }
}

#[cfg(test)]
mod tests {
    use bevy_picture_tour::camera::Easing;
    use bevy_picture_tour::camera::Keyframe;
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_looped_path_does_not_show_its_first_frame_twice() {
        let station = |x: f64| Keyframe {
            pose: CameraPose::from_angles(DVec3::new(x, 1.8, 0.0), 0.0, 0.0, 0.0),
            arrive: 0.1,
            hold: 0.0,
            easing: Easing::Smooth,
        };
        let path = |looped| CameraPath::new(vec![station(0.0), station(1.0)], looped).unwrap();

        // 0.2 s around, 0.1 s there.
        assert_eq!(count(&path(true), 30), 6);
        assert_eq!(count(&path(false), 30), 4);
    }
}
