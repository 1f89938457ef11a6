// The water: every fragment mirrors its ray and traces it through the components' reflection maps, near to far.
//
// Twin of `trace/mod.rs` (`mirrored`, `mirror_hit`), held to it by tests/integration/gpu_matches_trace.rs.

#define_import_path bevy_picture_tour::water

#import bevy_picture_tour::tour::{
    Component, Ray, TourUniform, component, eye_of, inside, level_of, meet, mirror, see, see_far, sharp, snap, INFINITE,
}

// Less light than this is left behind a layer: half a display code cannot change any more.
const OPAQUE: f32 = 1.0 / 8192.0;
// A mirrored ray climbs at least this steeply.
const LEAST_CLIMB: f32 = 1e-5;

// A reflection map at a picture point; its border is prolonged.
fn sample_map(maps: texture_2d<f32>, filtering: sampler, found: Component, at: vec2<f32>, level: f32) -> vec4<f32> {
    // Within the map, or those beside it in the atlas would bleed in.
    let last = found.atlas.xy + round(found.layer.zw * found.atlas.z) - 1.0;
    let texel = found.atlas.xy + (snap(at) - found.layer.xy) * found.atlas.z;
    return sharp(maps, filtering, texel, found.atlas.xy, last, level);
}

// Schlick's reflectance of water seen at a grazing angle of this sine. Twin of `fresnel` in `maps/tint.rs`.
fn fresnel(grazing: f32) -> f32 {
    return 0.02 + 0.98 * pow(1.0 - clamp(grazing, 0.0, 1.0), 5.0);
}

// A texel seen in the water, up from which `was` goes to the picture's camera, for a view's camera to which `is` goes.
// Twin of `Tint::at_angle`.
fn at_angle(tour: TourUniform, texel: vec4<f32>, was: vec3<f32>, is: vec3<f32>) -> vec4<f32> {
    if tour.water.w <= 0.0 {
        return texel;
    }
    let change = fresnel(is.y / length(is)) / fresnel(was.y / length(was));
    let ratio = clamp(pow(change, tour.water.w), 0.5, 2.0);
    return vec4(max(tour.water.rgb + ratio * (texel.rgb - tour.water.rgb), vec3(0.0)), texel.a);
}

struct Hit {
    distance: f32,
    texel: vec4<f32>,
}

// The water's view: what every look at a reflection map needs.
struct Look {
    row: i32,
    eye: vec3<f32>,
}

// Where a mirrored ray meets a component above the water; a negative distance for a miss.
fn mirror_hit(
    tour: TourUniform,
    records: texture_2d<f32>,
    maps: texture_2d<f32>,
    filtering: sampler,
    look: Look,
    index: i32,
    up: Ray,
) -> Hit {
    let found = component(records, index);
    if found.atlas.w < 0.5 {
        return Hit(-1.0, vec4(0.0));
    }
    let met = meet(records, look.row, index, found, up);
    if !(met.distance > 0.0) || !(met.distance < 1e9) || met.point.y < 0.0 || !inside(found, met.rest) {
        return Hit(-1.0, vec4(0.0));
    }
    let image = mirror(met.rest);
    let away = mirror(met.point) - look.eye;
    let seen = see(tour, image);
    let level = level_of(tour, records, look.row, away, seen.z, found.atlas.z);
    let texel = sample_map(maps, filtering, found, seen.xy, level);
    return Hit(met.distance, at_angle(tour, texel, tour.eye.xyz - image, -away));
}

struct Light {
    color: vec3<f32>,
    left: f32,
}

// Adds a straight-alpha texel behind what is there.
fn behind(light: Light, texel: vec4<f32>) -> Light {
    let weight = light.left * texel.a;
    return Light(light.color + weight * texel.rgb, light.left - weight);
}

// What the water shows along a ray that goes down to it.
fn mirrored(
    tour: TourUniform,
    records: texture_2d<f32>,
    maps: texture_2d<f32>,
    filtering: sampler,
    row: i32,
    ray: Ray,
) -> vec3<f32> {
    let water = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
    let up = Ray(
        vec3(water.x, 0.0, water.z),
        vec3(ray.direction.x, max(-ray.direction.y, LEAST_CLIMB), ray.direction.z),
    );

    let look = Look(row, eye_of(records, row));
    var light = Light(vec3(0.0), 1.0);
    let count = i32(textureLoad(records, vec2(5, row), 0).w);
    let ground_index = i32(textureLoad(records, vec2(6, row), 0).w);
    var ground = Hit(-1.0, vec4(0.0));
    if ground_index >= 0 {
        ground = mirror_hit(tour, records, maps, filtering, look, ground_index, up);
    }
    for (var i = 0; i < count; i++) {
        let index = i32(textureLoad(records, vec2(8 + i / 4, row), 0)[i % 4]);
        let hit = mirror_hit(tour, records, maps, filtering, look, index, up);
        if hit.distance < 0.0 {
            continue;
        }
        if ground.distance >= 0.0 && ground.distance < hit.distance {
            light = behind(light, ground.texel);
            ground.distance = -1.0;
        }
        light = behind(light, hit.texel);
        if light.left < OPAQUE {
            return light.color;
        }
    }
    if ground.distance >= 0.0 {
        light = behind(light, ground.texel);
    }
    let last = component(records, 0);
    var away = mirror(up.direction);
    var was = up.direction;
    var seen = see_far(tour, away);
    if last.kind != INFINITE {
        let met = meet(records, row, 0, last, up);
        if met.distance > 0.0 && met.distance < 1e9 {
            let image = mirror(met.rest);
            seen = see(tour, image);
            was = tour.eye.xyz - image;
            away = mirror(met.point) - look.eye;
        }
    }
    let level = level_of(tour, records, row, away, seen.z, last.atlas.z);
    let texel = at_angle(tour, sample_map(maps, filtering, last, seen.xy, level), was, -away);
    light = behind(light, vec4(texel.rgb, 1.0));
    return light.color;
}
