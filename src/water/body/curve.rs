//! A smooth curve through points of the water, by way along it.
//!
//! A centripetal Catmull-Rom spline: it passes every point and makes no loops of its own, however uneven the points lie.

use std::f64::consts::PI;

use glam::DVec2;

use super::wrapped;

/// Steps of the table in each segment.
const STEPS: usize = 64;

/// A curve with a table from way to place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    segments: Vec<Segment>,
    /// Way at each step, meters, from 0; one more than there are steps.
    ways: Vec<f64>,
    /// Heading at each step, radians, without jumps, and its integral along the way.
    headings: Vec<f64>,
    heading_sums: Vec<f64>,
    /// Way over which headings are averaged, meters.
    window: f64,
    closed: bool,
}

/// A cubic from one point to the next (Hermite's form).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment {
    ends: [DVec2; 2],
    tangents: [DVec2; 2],
}

impl Segment {
    fn at(&self, u: f64) -> DVec2 {
        let v = 1.0 - u;
        let [from, to] = self.ends;
        let [leaving, arriving] = self.tangents;
        (1.0 + 2.0 * u) * v * v * from + u * u * (3.0 - 2.0 * u) * to + u * v * (v * leaving - u * arriving)
    }

    fn derivative(&self, u: f64) -> DVec2 {
        let v = 1.0 - u;
        let [from, to] = self.ends;
        let [leaving, arriving] = self.tangents;
        6.0 * u * v * (to - from) + v * (1.0 - 3.0 * u) * leaving + u * (3.0 * u - 2.0) * arriving
    }

    /// Length of a piece, by Gauss's three points.
    fn length(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let apart = 0.6_f64.sqrt() * half;
        let speed = |u| self.derivative(u).length();
        half / 9.0 * (5.0 * speed(middle - apart) + 8.0 * speed(middle) + 5.0 * speed(middle + apart))
    }
}

impl Curve {
    /// A curve through at least two finite points, of which no two neighbors are the same (nor the last and the first, if
    /// `closed`). Headings are averaged over `hull` meters: a hull does not turn in less than its length.
    pub(super) fn new(points: &[DVec2], closed: bool, hull: f64) -> Self {
        let count = points.len();
        // Beyond an open end the curve goes straight on.
        let point = |i: isize| match usize::try_from(i) {
            Ok(i) if i < count => points[i],
            Ok(i) if closed => points[i % count],
            Ok(_) => 2.0 * points[count - 1] - points[count - 2],
            Err(_) if closed => points[count - 1],
            Err(_) => 2.0 * points[0] - points[1],
        };
        let segments: Vec<Segment> = (0..count - usize::from(!closed))
            .map(|i| {
                let [a, b, c, d] = std::array::from_fn(|k| point((i + k) as isize - 1));
                let [ab, bc, cd] = [(a, b), (b, c), (c, d)].map(|(p, q)| p.distance(q).sqrt());
                let leaving = (b - a) / ab - (c - a) / (ab + bc) + (c - b) / bc;
                let arriving = (c - b) / bc - (d - b) / (bc + cd) + (d - c) / cd;
                Segment { ends: [b, c], tangents: [leaving * bc, arriving * bc] }
            })
            .collect();
        let mut ways = vec![0.0];
        let mut headings = vec![];
        let mut way = 0.0;
        for segment in &segments {
            for step in 0..STEPS {
                let [from, to] = [step, step + 1].map(|step| step as f64 / STEPS as f64);
                way += segment.length(from, to);
                ways.push(way);
                turn_to(&mut headings, segment.derivative(from));
            }
        }
        turn_to(&mut headings, segments[segments.len() - 1].derivative(1.0));
        let mut heading_sums = vec![0.0];
        let mut sum = 0.0;
        for step in 1..ways.len() {
            sum += 0.5 * (headings[step - 1] + headings[step]) * (ways[step] - ways[step - 1]);
            heading_sums.push(sum);
        }
        Self { segments, ways, headings, heading_sums, window: hull.min(0.25 * way), closed }
    }

    /// Its length, meters.
    pub(super) fn length(&self) -> f64 {
        self.ways[self.ways.len() - 1]
    }

    /// Place (x, z) and heading (radians) at a way from 0 to the length.
    pub(super) fn at(&self, way: f64) -> (DVec2, f64) {
        let step = self.step_of(way);
        let length = self.ways[step + 1] - self.ways[step];
        let part = (way - self.ways[step]) / length;
        let segment = &self.segments[step / STEPS];
        // Newton's step from the linear guess makes the way right to the fourth order.
        let from = (step % STEPS) as f64 / STEPS as f64;
        let guess = from + part / STEPS as f64;
        let speed = segment.derivative(guess).length();
        let missing = way - self.ways[step] - segment.length(from, guess);
        // At a cusp the curve stands still, and the guess must do.
        let u = if speed > 1e-6 {
            guess + (missing / speed).clamp(-0.5 / STEPS as f64, 0.5 / STEPS as f64)
        } else {
            guess
        };
        (segment.at(u), self.heading(way))
    }

    /// The step in whose part of the way `way` lies.
    fn step_of(&self, way: f64) -> usize {
        self.ways.partition_point(|&start| start <= way).clamp(1, self.ways.len() - 1) - 1
    }

    /// The heading at a way, averaged over the window around it.
    fn heading(&self, way: f64) -> f64 {
        let half = 0.5 * self.window;
        (self.heading_sum(way + half) - self.heading_sum(way - half)) / self.window
    }

    /// The integral of the heading from 0 to a way; beyond the ends the heading goes on around a closed curve, or stays.
    fn heading_sum(&self, way: f64) -> f64 {
        let length = self.length();
        let last = self.headings.len() - 1;
        let rounds = if self.closed { (way / length).floor() } else { 0.0 };
        let within = (way - rounds * length).clamp(0.0, length);
        let step = self.step_of(within);
        let part = (within - self.ways[step]) / (self.ways[step + 1] - self.ways[step]);
        let [from, to] = [self.headings[step], self.headings[step + 1]];
        let here = from + part * (to - from);
        let sum = self.heading_sums[step] + 0.5 * (from + here) * (within - self.ways[step]);
        if self.closed {
            let around = self.headings[last] - self.headings[0];
            rounds * (self.heading_sums[last] + around * (0.5 * length * (rounds - 1.0) + within)) + sum
        } else {
            sum + here * (way - within)
        }
    }
}

/// Adds the heading of a direction (x, z) to a list, the shorter way round from the last one.
fn turn_to(headings: &mut Vec<f64>, direction: DVec2) {
    let last = headings.last().copied();
    // Where the curve stands still, the heading stays.
    let heading =
        if direction.length() > 1e-9 { (-direction.y).atan2(direction.x) } else { last.unwrap_or(0.0) };
    let turned = last.map_or(heading, |last| {
        let turn = wrapped(heading - last);
        // Straight back is a turn to the left.
        last + if turn == -PI { PI } else { turn }
    });
    headings.push(turned);
}
