//! Reflection maps that know where each texel came from.
//!
//! A texel is *seen* when the picture's water shows it and nothing nearer, or its mirror image, stands before it; else
//! *predicted* from the component's own texture by the fitted water, brought to its seen neighbors by the membrane of
//! what the prediction misses there; *missing* when the texture had to be made up too.

use glam::{DVec3, IVec2};
use rayon::prelude::*;

use super::beyond::frame;
use super::coverage::Coverage;
use super::fill::push_pull;
use super::holes::patch;
use super::inpaint::Cell;
use super::mirror::{mirrored, reflection_of};
use super::softness::{blur_px, fit_slope, softened};
use super::tint::{Tint, TintSample};
use super::zones::Zones;
use super::{Fill, Grid, Layer, MapOptions, Method, lift, paper};
use crate::picture::Picture;
use crate::picture::PicturePoint;
use crate::picture::color::linear_from_srgb;
use crate::picture::color::srgb_from_linear;
use crate::picture::distances;
use crate::scene::Surface;
use crate::scene::TourScene;

/// Misses of the prediction beyond this many median errors are no shade of the water; in codes, kept in these bounds.
const MISS_TOLERANCE: f32 = 3.0;
const TOLERANCE_CODES: [f32; 2] = [10.0, 20.0];

/// Shares of agreeing texels around between which the prediction's part goes from none to all.
const TRUST: [f32; 2] = [0.3, 0.7];

/// Predictions trusted less than this are replaced by what the water shows elsewhere.
const LEAST_TRUST: f32 = 0.5;

/// How far up or down a mirror image may lie from where its plane says, pixels per pixel of picture width.
const SEARCH_REACH: f32 = 0.006;

/// From this distance to what is seen on, predictions are taken whole, pixels per pixel of picture width.
const LONELY: f32 = 0.06;

/// Where a texel of a reflection map came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The picture's water shows it.
    Seen,
    /// Made from the component's own texture.
    Predicted,
    /// Neither was in the picture.
    Missing,
}

/// Fits the water, and then its ripples, on what the picture shows twice.
pub(super) fn fit_water(scene: &TourScene, picture: &Picture, coverage: &Coverage, owner: &Grid<u8>) -> Tint {
    let size = picture.size();
    // A sample every few pixels says as much as all of them.
    let step = (f64::from(size.x) * f64::from(size.y) / 60_000.0).sqrt().max(1.0) as i32;
    let mut samples = Vec::new();
    for y in (0..size.y as i32).step_by(step as usize) {
        for x in (0..size.x as i32).step_by(step as usize) {
            let pixel = IVec2::new(x, y);
            let Some(component) = owner.get(pixel).filter(|&owner| owner != 255) else { continue };
            let surface = &scene.components[usize::from(component)].surface;
            let Some(found) = mirrored(scene, surface, PicturePoint::pixel_center(x.into(), y.into())) else {
                continue;
            };
            let at = found.direct.0.floor().as_ivec2();
            if coverage.is_pure(usize::from(component), at) {
                samples.push(TintSample {
                    direct: linear(picture, at),
                    mirrored: linear(picture, pixel),
                    grazing: found.grazing,
                });
            }
        }
    }
    let mut tint = Tint::fit(&samples);
    tint.slope = fit_slope(scene, picture, coverage, owner, &tint);
    tint
}

/// A picture pixel in linear light.
pub(super) fn linear(picture: &Picture, pixel: IVec2) -> [f32; 3] {
    picture.pixel(pixel.x as u32, pixel.y as u32).map(linear_from_srgb)
}

/// What the water shows of a backdrop where something nearer hides it, brought to direct colors.
pub(super) fn backdrop_from_water(
    scene: &TourScene,
    picture: &Picture,
    tint: &Tint,
    owner: &Grid<u8>,
    index: usize,
    pixel: IVec2,
) -> Option<[f32; 3]> {
    let surface = &scene.components[index].surface;
    let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
    let at = reflection_of(scene, surface, point)?;
    let corner = (at.0 - 0.5).floor().as_ivec2();
    let part = (at.0 - 0.5 - corner.as_dvec2()).as_vec2();
    let mut mean = [0.0; 3];
    for (step, weight) in [
        (IVec2::ZERO, (1.0 - part.x) * (1.0 - part.y)),
        (IVec2::X, part.x * (1.0 - part.y)),
        (IVec2::Y, (1.0 - part.x) * part.y),
        (IVec2::ONE, part.x * part.y),
    ] {
        if usize::from(owner.get(corner + step)?) != index {
            return None;
        }
        let color = linear(picture, corner + step);
        for c in 0..3 {
            mean[c] += weight * color[c];
        }
    }
    let ray: DVec3 = scene.camera.ray(at).direction;
    tint.direct(mean, (-ray.y / ray.length()) as f32)
}

/// By how many codes a color may differ from what the fitted water says and still be taken to agree.
pub(super) fn tolerance(tint: &Tint) -> u8 {
    (MISS_TOLERANCE * tint.error_codes).clamp(TOLERANCE_CODES[0], TOLERANCE_CODES[1]) as u8
}

/// Everything a component's reflection map is made from.
pub(super) struct ReflectionInput<'a> {
    pub scene: &'a TourScene,
    pub picture: &'a Picture,
    pub coverage: &'a Coverage,
    pub zones: &'a Zones,
    pub owner: &'a Grid<u8>,
    pub tint: &'a Tint,
    /// Pixels beside a billboard or its mirror image.
    pub by_body: &'a Grid<bool>,
    /// Filled direct colors of the component, linear light.
    pub direct: &'a Grid<[f32; 3]>,
    pub options: &'a MapOptions,
}

/// A component's reflection map before the lift, and the origin of each texel.
///
/// `None` if canceled.
pub(super) fn reflection_map(
    input: &ReflectionInput,
    index: usize,
    progress: &dyn Fn(f32) -> bool,
) -> Option<(Layer, Vec<Origin>)> {
    let ReflectionInput { scene, picture, coverage, zones, owner, tint, direct, .. } = input;
    let surface = &scene.components[index].surface;
    let size = picture.size();
    let (origin, extent) = match &zones[index] {
        Some(zone) => (zone.grown.origin, zone.grown.size),
        None => {
            // From the highest water of the picture, on which the mirrored background begins.
            let top = coverage.above.cells.iter().position(|above| !above).unwrap_or(0) / size.x as usize;
            let (low, high) = frame(size);
            let low = IVec2::new(low.x, (top as i32 - 2).max(low.y));
            (low, (high - low).as_uvec2())
        }
    };
    let texels = Grid::from_fn(origin, extent, |pixel| {
        let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
        let seen = owner.get(pixel) == Some(index as u8);
        let found = mirrored(scene, surface, point);
        let (predicted, sourced) = match found {
            Some(found) => {
                let at = found.direct.0.floor().as_ivec2();
                let sourced = coverage.is_pure(index, at);
                let blur = blur_px(scene, tint.slope, found.behind);
                (tint.mirrored(softened(direct, found.direct, blur), found.grazing), sourced)
            }
            None => ([0.0; 3], false),
        };
        let origin = match (seen, sourced) {
            (true, _) => Origin::Seen,
            (false, true) => Origin::Predicted,
            (false, false) => Origin::Missing,
        };
        (predicted, origin)
    });
    let unseen = match input.options.method {
        Method::Ours => {
            let (cells, trust) = unseen_colors(input, &texels);
            let mut colors = Grid { origin, size: extent, cells };
            make_up(input, surface, &texels, &trust, &mut colors, index, progress)?;
            colors.cells
        }
        Method::Paper => paper::unseen_colors(input, &texels, progress)?,
    };
    let layer = Layer::from_fn(origin, extent, |pixel| {
        let cell = texels.index(pixel).unwrap_or(0);
        let (_, from) = texels.cells[cell];
        let alpha = match &zones[index] {
            Some(zone) => zone.coverage.get(pixel).unwrap_or(0),
            None => 255,
        };
        let [r, g, b] = if from == Origin::Seen {
            picture.pixel(pixel.x as u32, pixel.y as u32)
        } else {
            unseen[cell].map(srgb_from_linear)
        };
        [r, g, b, alpha]
    });
    Some((layer, texels.cells.into_iter().map(|(_, origin)| origin).collect()))
}

/// Fills the texels that nothing predicts, from what the water shows elsewhere: those that mirror what lies even above the
/// component's texture map, and those near which predictions fail.
fn make_up(
    input: &ReflectionInput,
    surface: &Surface,
    texels: &Grid<([f32; 3], Origin)>,
    trust: &[f32],
    colors: &mut Grid<[f32; 3]>,
    index: usize,
    progress: &dyn Fn(f32) -> bool,
) -> Option<()> {
    let ReflectionInput { scene, picture, direct, options, .. } = input;
    let top = f64::from(direct.origin.y);
    let cells: Vec<Cell> = (0..texels.cells.len())
        .into_par_iter()
        .map(|cell| {
            let pixel = texels.pixel(cell);
            let point = PicturePoint::pixel_center(pixel.x.into(), pixel.y.into());
            let beyond = mirrored(scene, surface, point).is_some_and(|found| found.direct.y() < top);
            if (beyond || trust[cell] < LEAST_TRUST) && texels.cells[cell].1 != Origin::Seen {
                Cell::Hole
            } else {
                Cell::Source
            }
        })
        .collect();
    if !cells.contains(&Cell::Hole) {
        return Some(());
    }
    for cell in (0..cells.len()).filter(|&cell| texels.cells[cell].1 == Origin::Seen) {
        colors.cells[cell] = linear(picture, texels.pixel(cell));
    }
    let known: Vec<f32> = cells.iter().map(|&cell| f32::from(u8::from(cell == Cell::Source))).collect();
    push_pull(colors.size.x as usize, &mut colors.cells, &known);
    let patches = options.fill == Fill::Patches && options.paint_beyond;
    (!patches || patch(colors, &cells, picture.size(), index as u64, progress)).then_some(())
}

/// Colors for the texels that the water does not show, linear light: the prediction plus what it misses on the seen
/// texels around; where it fails on those altogether (their distance is wrong, something swims there), their own colors.
/// And how far each prediction is trusted, 0–1.
fn unseen_colors(input: &ReflectionInput, texels: &Grid<([f32; 3], Origin)>) -> (Vec<[f32; 3]>, Vec<f32>) {
    let ReflectionInput { picture, tint, by_body, .. } = input;
    let width = texels.size.x as usize;
    let tolerance = tolerance(tint);
    let reach = (SEARCH_REACH * picture.size().x as f32).round() as i32;
    // Per texel what the prediction misses, the seen color, and whether the two agree.
    let ((mut misses, mut around), agreeing): ((Vec<[f32; 3]>, Vec<[f32; 3]>), Vec<f32>) = texels
        .cells
        .par_iter()
        .enumerate()
        .map(|(cell, (predicted, origin))| {
            if *origin != Origin::Seen {
                return (([0.0; 3], [0.0; 3]), 0.0);
            }
            let pixel = texels.pixel(cell);
            let codes = picture.pixel(pixel.x as u32, pixel.y as u32);
            let [r, g, b] = codes.map(linear_from_srgb);
            // What stands nearer or farther than the component's plane is mirrored some pixels above or below.
            let off = |predicted: [f32; 3]| {
                (0..3).map(|c| codes[c].abs_diff(srgb_from_linear(predicted[c]))).max().unwrap_or(0)
            };
            let near = [0, -reach, reach, -reach / 2, reach / 2]
                .iter()
                .filter_map(|&up| texels.get(pixel + IVec2::new(0, up)))
                .map(|(predicted, _)| predicted)
                .find(|&predicted| off(predicted) < tolerance);
            let from = near.unwrap_or(*predicted);
            let misses = [r - from[0], g - from[1], b - from[2]];
            ((misses, [r, g, b]), f32::from(u8::from(near.is_some())))
        })
        .unzip();
    let all: Vec<f32> =
        texels.cells.iter().map(|(_, origin)| f32::from(u8::from(*origin == Origin::Seen))).collect();
    // What disagrees beside a body may be a part of it that was not told from the background, and stays where it is.
    let seen: Vec<f32> = all
        .par_iter()
        .enumerate()
        .map(|(cell, &seen)| {
            let doubtful = agreeing[cell] == 0.0 && by_body.get(texels.pixel(cell)) == Some(true);
            if doubtful { 0.0 } else { seen }
        })
        .collect();
    push_pull(width, &mut misses, &agreeing);
    let mut agreement: Vec<[f32; 1]> = agreeing.iter().map(|&agrees| [agrees]).collect();
    push_pull(width, &mut agreement, &all);
    push_pull(width, &mut around, &seen);
    let far = LONELY * picture.size().x as f32;
    let from_seen = distances(width, texels.size.y as usize, |cell| all[cell] == 1.0);
    (0..texels.cells.len())
        .into_par_iter()
        .map(|cell| {
            let (predicted, _) = texels.cells[cell];
            let trust = ((agreement[cell][0] - TRUST[0]) / (TRUST[1] - TRUST[0])).clamp(0.0, 1.0);
            // Far from all that is seen a prediction that fails there may still be right.
            let lonely = if tint.explains() { (2.0 * from_seen[cell] / far - 1.0).min(1.0) } else { 0.0 };
            let trust = trust.max(lonely);
            let color = std::array::from_fn(|c| {
                let made = (predicted[c] + misses[cell][c]).clamp(0.0, 1.0);
                trust * made + (1.0 - trust) * around[cell][c]
            });
            (color, trust)
        })
        .unzip()
}

/// Raises the nearest mirror image at every water pixel until the layers over each other show the picture.
pub(super) fn lift_reflections(
    scene: &TourScene,
    picture: &Picture,
    coverage: &Coverage,
    zones: &Zones,
    layers: &mut [Option<Layer>],
) {
    let edits = {
        let layers = &*layers;
        Grid::from_fn(IVec2::ZERO, picture.size(), |pixel| {
            if !coverage.water.get(pixel).unwrap_or(false) {
                return None;
            }
            let mut stack = zones.stack_at(scene, pixel);
            let nearest = stack.pop()?;
            let behind = composite(layers, &stack, pixel)?;
            let alpha = layers[nearest].as_ref()?.get(pixel)?[3];
            let target = picture.pixel(pixel.x as u32, pixel.y as u32);
            Some((nearest, lift::lifted(target, behind, alpha)))
        })
    };
    for (cell, edit) in edits.cells.iter().enumerate() {
        if let Some((nearest, texel)) = edit
            && let Some(layer) = &mut layers[*nearest]
            && let Some(at) = layer.index(edits.pixel(cell))
        {
            layer.cells[at] = *texel;
        }
    }
}

/// What the water shows at a pixel of the first view: reflection layers over each other, linear light.
pub(super) fn composite(layers: &[Option<Layer>], far_to_near: &[usize], pixel: IVec2) -> Option<[f32; 3]> {
    let [r, g, b, _] = layers[0].as_ref()?.get(pixel)?;
    let mut color = [r, g, b].map(linear_from_srgb);
    for &index in far_to_near {
        if let Some(texel) = layers[index].as_ref().and_then(|layer| layer.get(pixel)) {
            color = lift::over(texel, color);
        }
    }
    Some(color)
}
