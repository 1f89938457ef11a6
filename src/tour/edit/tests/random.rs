//! Random drafts and edits, sound ones and others, from a seed.

use glam::{DVec2, DVec3, UVec2};

use super::*;
use crate::tour::{
    Background, BackgroundPlace, Band, CameraPath, Course, Crop, Drift, Easing, Floating, FocalLength,
    GroundArea, Jonswap, Keyframe, Medium, Method, Octaves, Recorded, Sea, Sky, Sway, SwayKind, WaterArea,
    Waves, Waypoint,
};

const NAMES: [&str; 6] = ["boat", "tree", "shore", "hill", "background", "ghost"];
const MASKS: [&str; 3] = ["masks/a.png", "masks/b.png", "masks/c.png"];

/// Splitmix64.
pub(super) struct Random(pub(super) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn yes(&mut self) -> bool {
        self.below(2) == 0
    }

    /// Seldom no number at all.
    fn number(&mut self) -> f64 {
        match self.below(150) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            _ => self.below(1000) as f64 / 8.0,
        }
    }

    fn maybe<T>(&mut self, value: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.yes().then(|| value(self))
    }

    fn list<T>(&mut self, most: usize, mut value: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.below(most + 1)).map(|_| value(self)).collect()
    }

    fn point(&mut self) -> PicturePoint {
        PicturePoint::new(self.number(), self.number())
    }

    fn name(&mut self) -> String {
        NAMES[self.below(NAMES.len())].into()
    }

    fn mask_name(&mut self) -> String {
        MASKS[self.below(MASKS.len())].into()
    }

    fn region(&mut self) -> Region<String> {
        if self.below(4) == 0 {
            Region::Mask(self.mask_name())
        } else {
            Region::Polygon(self.list(5, Self::point))
        }
    }

    fn place(&mut self) -> BackgroundPlace {
        match self.below(3) {
            0 => BackgroundPlace::Distance(self.number()),
            1 => BackgroundPlace::Contact(self.list(4, Self::point)),
            _ => BackgroundPlace::Infinity,
        }
    }

    fn pair(&mut self) -> ReflectionPair {
        let (point, reflection) = (self.point(), self.point());
        ReflectionPair { point, reflection, on: self.maybe(Self::name), name: self.maybe(Self::name) }
    }

    fn band(&mut self) -> Band<String> {
        Band { name: self.name(), region: self.maybe(Self::region), place: self.place() }
    }

    fn drift(&mut self) -> Drift {
        Drift { speed: self.number(), direction_deg: self.number() }
    }

    fn sky(&mut self) -> Sky<String> {
        Sky { region: self.maybe(Self::region), drift: self.maybe(Self::drift) }
    }

    fn water(&mut self) -> WaterArea<String> {
        WaterArea { region: self.region(), pairs: self.list(3, Self::pair) }
    }

    fn ground(&mut self) -> GroundArea<String> {
        GroundArea { region: self.region(), height_above_water: self.number() }
    }

    fn motion(&mut self) -> Motion<String> {
        match self.below(5) {
            0 => Motion::Static,
            1 => Motion::Sway(Sway {
                kind: SwayKind::Reed,
                root: self.maybe(Self::point),
                tip: self.maybe(Self::point),
                frequency_hz: self.maybe(Self::number),
                damping: None,
                amplitude: None,
                period_seconds: None,
                seed: self.maybe(Self::next),
            }),
            2 => Motion::Floating(Floating {
                draft: self.number(),
                length: self.maybe(Self::number),
                beam: None,
                mass: None,
                heave_damping: None,
                roll_damping: None,
                heave_period_seconds: None,
                roll_period_seconds: self.maybe(Self::number),
            }),
            3 => Motion::Course(Course {
                waypoints: self.list(4, |random| Waypoint(DVec2::new(random.number(), random.number()))),
                speed: self.number(),
                draft: self.number(),
                length: self.maybe(Self::number),
                closed: self.yes(),
            }),
            _ => {
                let poses = if self.yes() { "poses.json" } else { "../poses.json" };
                Motion::Recorded(Recorded { poses: poses.into(), looped: self.yes() })
            }
        }
    }

    fn object(&mut self) -> Object<String> {
        Object {
            name: self.name(),
            support: if self.yes() { Support::Water } else { Support::Ground },
            outline: self.region(),
            contact: [self.point(), self.point()],
            turns_to_camera: self.yes(),
            motion: self.motion(),
        }
    }

    pub(super) fn keyframe(&mut self) -> Keyframe {
        Keyframe {
            position: DVec3::new(self.number(), self.number(), self.number()),
            yaw_deg: self.number(),
            pitch_deg: 0.0,
            roll_deg: 0.0,
            seconds: self.number(),
            hold: self.number(),
            easing: Easing::Linear,
        }
    }

    fn scale(&mut self) -> Scale {
        if self.yes() {
            return Scale::HeightAboveWater(self.number());
        }
        Scale::Length { on: self.name(), from: self.point(), to: self.point(), meters: self.number() }
    }

    fn packed(&mut self) -> PackedMask {
        PackedMask::new(&mask(self.below(256) as u8))
    }

    /// A draft, not always a sound one: names may be double or mean nothing; but numbers are finite, so that it equals
    /// itself.
    pub(super) fn draft(&mut self) -> Draft {
        loop {
            let mut draft = Draft::new(TourFile::new("lake.png".into()));
            let tour = &mut draft.tour;
            tour.camera.horizon = self.maybe(|random| [random.point(), random.point()]);
            tour.camera.scale = self.maybe(Self::scale);
            tour.water = self.maybe(Self::water);
            tour.ground = self.maybe(Self::ground);
            tour.background = Background { place: self.maybe(Self::place), bands: self.list(2, Self::band) };
            tour.sky = self.maybe(Self::sky);
            tour.objects = self.list(3, Self::object);
            tour.path =
                self.maybe(|random| CameraPath { keyframes: random.list(2, Self::keyframe), looped: true });
            for name in MASKS {
                if self.yes() {
                    draft.masks.load(name, mask(self.below(256) as u8));
                }
            }
            if draft == draft.clone() {
                return draft;
            }
        }
    }

    fn change<T>(&mut self, length: usize, value: impl FnOnce(&mut Self) -> T) -> ListEdit<T> {
        // One beyond the end now and then.
        let (a, b) = (self.below(length + 1), self.below(length + 1));
        match self.below(5) {
            0 | 1 => ListEdit::Insert(a, value(self)),
            2 => ListEdit::Remove(a),
            3 => ListEdit::Replace(a, value(self)),
            _ => ListEdit::Move { from: a, to: b },
        }
    }

    fn region_at(&mut self) -> RegionAt {
        match self.below(6) {
            0 => RegionAt::Water,
            1 => RegionAt::Ground,
            2 => RegionAt::Sky,
            3 => RegionAt::Band(self.below(3)),
            _ => RegionAt::Object(self.below(4)),
        }
    }

    fn place_at(&mut self) -> PlaceAt {
        if self.yes() { PlaceAt::Background } else { PlaceAt::Band(self.below(3)) }
    }

    fn line(&mut self) -> LineAt {
        if self.yes() { LineAt::Region(self.region_at()) } else { LineAt::Place(self.place_at()) }
    }

    fn point_at(&mut self) -> PointAt {
        let index = self.below(4);
        match self.below(9) {
            0 => PointAt::Horizon(index),
            1 => PointAt::PrincipalPoint,
            2 => PointAt::Scale(index),
            3 => PointAt::Pair(index),
            4 => PointAt::Reflection(index),
            5 => PointAt::On(self.line(), index),
            6 => PointAt::Foot(index, self.below(3)),
            7 => PointAt::SwayRoot(index),
            _ => PointAt::SwayTip(index),
        }
    }

    fn patch(&mut self) -> MaskPatch {
        let min = UVec2::new(self.below(16) as u32, self.below(8) as u32);
        let size = UVec2::new(1 + self.below(4) as u32, 1 + self.below(3) as u32);
        let values: Vec<u8> = (0..size.element_product()).map(|_| self.next() as u8).collect();
        MaskPatch::new(PixelRect { min, max: min + size }, &values).unwrap()
    }

    /// Any kind of edit.
    pub(super) fn edit(&mut self, draft: &Draft) -> Edit {
        let tour = &draft.tour;
        let object = self.below(tour.objects.len() + 1);
        match self.below(36) {
            0 => Edit::Picture(TourFile::new(if self.yes() { "sea.png" } else { "/sea.png" }.into()).picture),
            1 => Edit::Medium(Medium::Print),
            2 => Edit::Crop(self.maybe(|random| Crop {
                left: 0,
                top: 0,
                width: 1,
                height: random.below(9) as u32,
            })),
            3 => Edit::Horizon(self.maybe(|random| [random.point(), random.point()])),
            4 => Edit::PrincipalPoint(self.maybe(Self::point)),
            5 => Edit::FocalLength(FocalLength::Between(self.number(), self.number())),
            6 => Edit::Scale(self.maybe(Self::scale)),
            7 => Edit::Method(Method::Paper),
            8 | 9 => Edit::Region { at: self.region_at(), region: self.maybe(Self::region) },
            10 | 11 => Edit::MovePoint { at: self.point_at(), to: self.point() },
            12 => Edit::InsertPoint { line: self.line(), index: self.below(4), point: self.point() },
            13 => Edit::RemovePoint { line: self.line(), index: self.below(4) },
            14 => Edit::Water(self.maybe(Self::water)),
            15 | 16 => {
                let length = tour.water.as_ref().map_or(0, |water| water.pairs.len());
                Edit::Pairs(self.change(length, Self::pair))
            }
            17 => Edit::PairOn { pair: self.below(3), on: self.maybe(Self::name) },
            18 => Edit::Ground(self.maybe(Self::ground)),
            19 => Edit::GroundHeight(self.number()),
            20 => Edit::Place { at: self.place_at(), place: self.maybe(Self::place) },
            21 => Edit::Bands(self.change(tour.background.bands.len(), Self::band)),
            22 => Edit::Sky(self.maybe(Self::sky)),
            23 => Edit::Drift(self.maybe(Self::drift)),
            24 | 25 => Edit::Objects(self.change(tour.objects.len(), Self::object)),
            26 => {
                let what = if self.yes() { Named::Object(object) } else { Named::Band(self.below(2)) };
                Edit::Rename { what, to: self.name() }
            }
            27 => Edit::Support { object, support: Support::Ground },
            28 => Edit::Contact { object, contact: [self.point(), self.point()] },
            29 => Edit::TurnsToCamera { object, turns: self.yes() },
            30 => Edit::Motion { object, motion: self.motion() },
            31 => Edit::Wind(Wind { speed: self.number(), ..Wind::default() }),
            32 => {
                let octaves = Octaves { wavelength: self.maybe(Self::number), ..Octaves::default() };
                let jonswap = Jonswap { depth: self.number(), ..Jonswap::default() };
                let sea = if self.yes() { Sea::Octaves(octaves) } else { Sea::Jonswap(jonswap) };
                Edit::Waves(Waves { sea, ripples: self.yes() })
            }
            33 => {
                let length = tour.path.as_ref().map_or(0, |path| path.keyframes.len());
                Edit::Keyframes(self.change(length, Self::keyframe))
            }
            34 => match self.below(4) {
                0 => Edit::LoopPath(self.yes()),
                1 => Edit::Path(None),
                2 => Edit::Mask { name: self.mask_name(), mask: self.maybe(Self::packed) },
                _ => Edit::Paint { name: self.mask_name(), patch: self.patch() },
            },
            _ => Edit::Many((0..3).map(|_| self.edit(draft)).collect()),
        }
    }
}
