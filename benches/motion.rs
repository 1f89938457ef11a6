//! What moving costs a frame on the CPU: one step of the demo in a wind, with the boat afloat and sixteen swaying trees.
//!
//! What must hold on one core: at most 2.5 ms. Beside it, in the same run: the step of a still tour, and of 1 and 56 trees
//! without water.
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use std::hint::black_box;
use std::path::Path;

use bevy_picture_tour::assemble::{TourSource, place};
use bevy_picture_tour::motion::{Recordings, Simulation};
use bevy_picture_tour::scene;
use bevy_picture_tour::tour::{Motion, Sea, Tour, TourFile};
use criterion::Criterion;

/// The demo with its conifers `trees` times over.
fn simulation(trees: usize, change: impl FnOnce(&mut TourFile)) -> Simulation {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lake/lake.tour.ron");
    let source = TourSource::open(&path).unwrap_or_else(|problems| panic!("{problems}"));
    let mut plan = place(&source).unwrap().plan;
    let mut file = source.tour.to_file();
    let tree = file.objects.iter().find(|object| matches!(object.motion, Motion::Sway(_))).unwrap().clone();
    let planned = plan.billboards.iter().find(|billboard| billboard.name == tree.name).unwrap().clone();
    file.objects.retain(|object| object.name != tree.name);
    plan.billboards.retain(|billboard| billboard.name != tree.name);
    for number in 0..trees {
        let name = format!("tree {number}");
        file.objects.push(bevy_picture_tour::tour::Object { name: name.clone(), ..tree.clone() });
        plan.billboards.push(scene::BillboardPlan { name, ..planned.clone() });
    }
    // The scene is placed already.
    if let Some(water) = &mut file.water {
        water.pairs.clear();
    }
    change(&mut file);
    let (scene, _) = scene::build(&plan);
    Simulation::new(&Tour::check(file).unwrap(), &scene, None, &Recordings::default()).0
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("step");
    let dry = |file: &mut TourFile| {
        file.waves.sea = Sea::Calm;
        file.waves.ripples = false;
    };
    let mut everything = simulation(16, |_| ());
    // Ripples at rest cost nothing.
    everything.touch(glam::DVec2::new(0.0, -10.0), 0.5, -0.5);
    let tours = [
        ("everything moves", everything),
        (
            "still",
            simulation(16, |file| {
                dry(file);
                file.wind.speed = 0.0;
            }),
        ),
        ("1 tree", simulation(1, dry)),
        ("56 trees", simulation(56, dry)),
    ];
    for (name, mut simulation) in tours {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                simulation.step();
                black_box(simulation.moment().seconds)
            });
        });
    }
    group.finish();
    criterion.final_summary();
}
