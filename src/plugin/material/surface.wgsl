// A component seen directly: its texture map read through the picture's own camera.

#import bevy_picture_tour::tour::{TourUniform, component, fragment_ray, meet_plane, see, see_far, snap, INFINITE}
#import bevy_picture_tour::vertex::{TourVertex, Vertex, place}
#import bevy_picture_tour::finish::finish

@group(#{MATERIAL_BIND_GROUP}) @binding(0) var<uniform> tour: TourUniform;
@group(#{MATERIAL_BIND_GROUP}) @binding(1) var records: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(2) var texture_map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(3) var texture_sampler: sampler;

@vertex
fn vertex(vertex: Vertex) -> TourVertex {
    return place(vertex, tour, records);
}

@fragment
fn fragment(in: TourVertex) -> @location(0) vec4<f32> {
    let ray = fragment_ray(records, in.row, in.position.xy);
    let found = component(records, i32(tour.eye.w));
    var at = see_far(tour, ray.direction);
    if found.kind != INFINITE {
        at = see(tour, ray.origin + meet_plane(found, ray) * ray.direction);
    }
    let uv = (snap(at) - tour.layer.xy) / tour.layer.zw;
    let color = textureSampleLevel(texture_map, texture_sampler, uv, 0.0);
    if color.a <= tour.flags.y {
        discard;
    }
    return finish(color);
}
