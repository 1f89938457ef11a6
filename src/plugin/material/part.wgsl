// A tour's part: a component's texture map read through the picture's own camera, or the water.

#import bevy_picture_tour::tour::{
    TourUniform, cloud_copy, component, cross_faded, eye_of, fragment_ray, level_of, meet, see, see_far, sharp, snap, INFINITE,
}
#import bevy_picture_tour::vertex::{TourVertex, Vertex, place}
#import bevy_picture_tour::finish::finish
#ifdef TOUR_WATER
#import bevy_picture_tour::water::mirrored
#endif

@group(#{MATERIAL_BIND_GROUP}) @binding(0) var<uniform> tour: TourUniform;
@group(#{MATERIAL_BIND_GROUP}) @binding(1) var records: texture_2d<f32>;
// The component's texture map, or all reflection maps in one.
@group(#{MATERIAL_BIND_GROUP}) @binding(2) var map: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(3) var map_sampler: sampler;
// Waves of the wind and ripples.
@group(#{MATERIAL_BIND_GROUP}) @binding(4) var waves: texture_2d<f32>;

@vertex
fn vertex(vertex: Vertex) -> TourVertex {
    return place(vertex, tour, records);
}

// Coverage up to this is dropped in a depth pass.
const SOLID: f32 = 0.5;

#ifndef TOUR_WATER
// The texture map at a picture point.
fn texel(at: vec2<f32>, level: f32) -> vec4<f32> {
    let scale = tour.flags.z;
    let place = (snap(at) - tour.layer.xy) * scale;
    return sharp(map, map_sampler, place, vec2(0.0), round(tour.layer.zw * scale) - 1.0, level);
}
#endif

@fragment
fn fragment(in: TourVertex) -> @location(0) vec4<f32> {
#ifdef TOUR_WATER
#ifdef TOUR_DEPTH_ONLY
    // Water is opaque, its color does not matter.
    return vec4(1.0);
#else
    let ray = fragment_ray(records, in.row, in.position.xy);
    return finish(vec4(mirrored(tour, records, map, map_sampler, waves, in.row, ray), 1.0));
#endif
#else
    let ray = fragment_ray(records, in.row, in.position.xy);
    let found = component(records, i32(tour.eye.w));
    var away = ray.direction;
    var seen = see_far(tour, away);
#ifdef TOUR_DRIFTS
    let level = level_of(tour, records, in.row, away, seen.z, tour.flags.z);
    let first = cloud_copy(records, 0);
    let second = cloud_copy(records, 1);
    let color = first.z * texel(seen.xy - first.xy, level) + second.z * texel(seen.xy - second.xy, level);
#else
    var mirrored = vec4(0.0);
    if found.kind != INFINITE {
        let met = meet(records, in.row, i32(tour.eye.w), found, ray);
        seen = see(tour, met.rest);
        away = met.point - eye_of(records, in.row);
        mirrored = vec4(met.copy, met.mirrored);
    }
    let level = level_of(tour, records, in.row, away, seen.z, tour.flags.z);
    var color = texel(seen.xy, level);
#ifdef TOUR_RETURNS
    color = cross_faded(color, texel(see(tour, mirrored.xyz).xy, level), mirrored.w);
#endif
#endif
#ifdef TOUR_DEPTH_ONLY
    if color.a <= SOLID {
        discard;
    }
#endif
    return finish(color);
#endif
}
