// Places a tour's quad and finds the view's row of the records once a vertex.

#define_import_path bevy_picture_tour::vertex

#import bevy_pbr::{mesh_functions, view_transformations::position_world_to_clip}
#import bevy_picture_tour::tour::{TourUniform, component, placed, placement, view_row, WALL}

struct Vertex {
    @builtin(instance_index) instance_index: u32,
    @location(0) position: vec3<f32>,
}

struct TourVertex {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) row: i32,
}

fn place(vertex: Vertex, tour: TourUniform, records: texture_2d<f32>) -> TourVertex {
    var out: TourVertex;
    out.row = view_row(records);
    var local = vertex.position;
#ifndef TOUR_WATER
    let index = i32(tour.eye.w);
    let found = component(records, index);
    if found.kind == WALL {
        local = placed(found, placement(records, out.row, index), local);
    }
#endif
    let world_from_local = mesh_functions::get_world_from_local(vertex.instance_index);
    let world = mesh_functions::mesh_position_local_to_world(world_from_local, vec4(local, 1.0));
    // Infinity fills the view, behind everything (reverse z). No branch: drivers that make a shader anew for each value of
    // a uniform that branches (lavapipe does, and keeps them all) would do so here.
    out.position = select(position_world_to_clip(world.xyz), vec4(vertex.position.xy, 0.0, 1.0), tour.flags.x > 0.5);
    return out;
}
