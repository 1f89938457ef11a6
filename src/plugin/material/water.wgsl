// The water: every fragment mirrors its ray and traces it through the components' reflection maps, near to far.
//
// Twin of `trace/mod.rs` (`mirrored`, `mirror_hit`), held to it by tests/integration/gpu_matches_trace.rs.

#define_import_path bevy_picture_tour::water

#import bevy_picture_tour::tour::{
    Component, Ray, TourUniform, component, contains, fragment_ray, meet_plane, mirror, see, see_far, sharp, snap,
    INFINITE,
}

// Less light than this is left behind a layer: half a display code cannot change any more.
const OPAQUE: f32 = 1.0 / 8192.0;
// A mirrored ray climbs at least this steeply.
const LEAST_CLIMB: f32 = 1e-5;

// A reflection map at a picture point; its border is prolonged.
fn sample_map(maps: texture_2d<f32>, filtering: sampler, found: Component, at: vec2<f32>) -> vec4<f32> {
    // Within the map, or those beside it in the atlas would bleed in.
    let last = found.atlas.xy + round(found.layer.zw * found.atlas.z) - 1.0;
    let texel = found.atlas.xy + (snap(at) - found.layer.xy) * found.atlas.z;
    return sharp(maps, filtering, texel, found.atlas.xy, last);
}

struct Hit {
    distance: f32,
    texel: vec4<f32>,
}

// Where a mirrored ray meets a component above the water; a negative distance for a miss.
fn mirror_hit(tour: TourUniform, maps: texture_2d<f32>, filtering: sampler, found: Component, up: Ray) -> Hit {
    let distance = meet_plane(found, up);
    let point = up.origin + distance * up.direction;
    if found.atlas.w < 0.5 || !(distance > 0.0) || !(distance < 1e9) || point.y < 0.0 || !contains(found, point) {
        return Hit(-1.0, vec4(0.0));
    }
    return Hit(distance, sample_map(maps, filtering, found, see(tour, mirror(point))));
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

    var light = Light(vec3(0.0), 1.0);
    let count = i32(textureLoad(records, vec2(5, row), 0).w);
    let ground_index = i32(textureLoad(records, vec2(6, row), 0).w);
    var ground = Hit(-1.0, vec4(0.0));
    if ground_index >= 0 {
        ground = mirror_hit(tour, maps, filtering, component(records, ground_index), up);
    }
    for (var i = 0; i < count; i++) {
        let index = i32(textureLoad(records, vec2(8 + i / 4, row), 0)[i % 4]);
        let hit = mirror_hit(tour, maps, filtering, component(records, index), up);
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
    var at = see_far(tour, mirror(up.direction));
    if last.kind != INFINITE {
        let distance = meet_plane(last, up);
        if distance > 0.0 && distance < 1e9 {
            at = see(tour, mirror(up.origin + distance * up.direction));
        }
    }
    light = behind(light, vec4(sample_map(maps, filtering, last, at).rgb, 1.0));
    return light.color;
}
