// The water: every fragment mirrors its ray and traces it through the components' reflection maps, near to far.
//
// Twin of `trace/mirrored.rs`, held to it by tests/integration/gpu_matches_trace.rs.

#define_import_path bevy_picture_tour::water

#import bevy_pbr::mesh_view_bindings::view
#import bevy_picture_tour::tour::{
    Component, Ray, TourUniform, cloud_copy, component, cross_faded, eye_of, inside, level_of, meet, mirror, see, see_far,
    sharp, snap, INFINITE, MIP_LEVELS,
}
#import bevy_picture_tour::waves::surface

// Less light than this is left behind a layer: half a display code cannot change any more.
const OPAQUE: f32 = 1.0 / 8192.0;
// A mirrored ray climbs at least this steeply.
const LEAST_CLIMB: f32 = 1e-5;
// Upright blur: looks above and below the middle one, how far they are apart in standard deviations, texels of a mip level
// for each deviation, and deviations that count, texels.
const LOOKS: i32 = 2;
const APART: f32 = 0.85;
const BLUR_TEXELS: f32 = 0.6;
const LEAST_BLUR: f32 = 0.1;
const MOST_BLUR: f32 = 24.0;
// The same across, where grazing waves hardly blur.
const ACROSS_TEXELS: f32 = 1.5;

// A reflection map at a picture point; its border is prolonged.
fn sample_map(maps: texture_2d<f32>, filtering: sampler, found: Component, at: vec2<f32>, level: f32) -> vec4<f32> {
    // Within the map, or those beside it in the atlas would bleed in.
    let last = found.atlas.xy + round(found.layer.zw * found.atlas.z) - 1.0;
    let texel = found.atlas.xy + (snap(at) - found.layer.xy) * found.atlas.z;
    return sharp(maps, filtering, texel, found.atlas.xy, last, level);
}

// How unresolved waves blur what lies behind them.
struct Blur {
    // Mip level.
    level: f32,
    // Standard deviation upwards and downwards, picture pixels; 0 for none.
    upright: f32,
}

// A reflection map at a picture point, blurred upright: looks one above the other, each weighing as much as it covers.
fn sample_blurred(maps: texture_2d<f32>, filtering: sampler, found: Component, at: vec2<f32>, blur: Blur) -> vec4<f32> {
    let looks = select(0, LOOKS, blur.upright > 0.0);
    var sum = vec4(0.0);
    var weights = 0.0;
    for (var i = -looks; i <= looks; i++) {
        let away = APART * f32(i);
        let weight = exp(-0.5 * away * away);
        let texel = sample_map(maps, filtering, found, at + vec2(0.0, away * blur.upright), blur.level);
        sum += weight * vec4(texel.a * texel.rgb, texel.a);
        weights += weight;
    }
    return vec4(sum.rgb / max(sum.a, 1e-6), sum.a / weights);
}

// Schlick's reflectance of water seen at a grazing angle of this sine. Twin of `fresnel` in `maps/tint.rs`.
fn fresnel(grazing: f32) -> f32 {
    return 0.02 + 0.98 * pow(1.0 - clamp(grazing, 0.0, 1.0), 5.0);
}

// A texel seen in the water, up from which `was` goes to the picture's camera, for another grazing angle (its sine).
// Twin of `Tint::at_angle`.
fn at_angle(tour: TourUniform, texel: vec4<f32>, was: vec3<f32>, grazing: f32) -> vec4<f32> {
    let change = fresnel(grazing) / fresnel(was.y / length(was));
    let ratio = clamp(pow(change, tour.water.w), 0.5, 2.0);
    return vec4(max(tour.water.rgb + ratio * (texel.rgb - tour.water.rgb), vec3(0.0)), texel.a);
}

struct Hit {
    distance: f32,
    texel: vec4<f32>,
}

// What every look at a reflection map needs.
struct Look {
    row: i32,
    eye: vec3<f32>,
    // Sine of the angle between the camera's ray and the surface.
    grazing: f32,
    // Meters from the camera to the water.
    to_water: f32,
    // Standard deviation of the slopes that the pixel does not resolve.
    blur: f32,
}

// How what lies behind the water by this share of the way is blurred, where pixels see it at a mip level anyway.
fn blur_of(tour: TourUniform, look: Look, share: f32, scale: f32, seen: f32) -> Blur {
    let deviation = min(2.0 * tour.flags.w * look.blur * share * scale, MOST_BLUR);
    if deviation < LEAST_BLUR {
        return Blur(seen, 0.0);
    }
    let texels = max(BLUR_TEXELS, ACROSS_TEXELS * look.grazing) * deviation;
    // From a deviation of one texel on the coarser levels are read, which cost one fetch each.
    let level = max(log2(max(texels, 1.0)), min(deviation, 1.0));
    return Blur(min(max(seen, level), MIP_LEVELS), deviation / scale);
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
    if !(met.distance > 0.0) || !(met.distance < 1e9) || met.point.y < 0.0 || !inside(found, met.place) {
        return Hit(-1.0, vec4(0.0));
    }
    let image = mirror(met.rest);
    let away = mirror(met.point) - look.eye;
    let seen = see(tour, image);
    let share = met.distance / (met.distance + look.to_water);
    let level = level_of(tour, records, look.row, away, seen.z, found.atlas.z);
    let blur = blur_of(tour, look, share, found.atlas.z, level);
    var texel = sample_blurred(maps, filtering, found, seen.xy, blur);
#ifdef TOUR_RETURNS
    // One more look for the boats that come back, none for all else.
    if met.mirrored > 0.0 {
        let copy = see(tour, mirror(met.copy));
        texel = cross_faded(texel, sample_blurred(maps, filtering, found, copy.xy, blur), met.mirrored);
    }
#endif
    return Hit(met.distance, at_angle(tour, texel, tour.eye.xyz - image, look.grazing));
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
    waves: texture_2d<f32>,
    row: i32,
    ray: Ray,
) -> vec3<f32> {
    var to_water = -ray.origin.y / ray.direction.y;
    let focal = 0.5 * view.main_pass_viewport.w * view.clip_from_view[1][1];
    // Along the view a pixel covers this many meters of the water.
    let footprint = to_water / (focal * max(-ray.direction.y, 1e-6));
    var at = ray.origin + to_water * ray.direction;
    var water = surface(records, waves, at.xz, footprint);
    if water.height != 0.0 {
        // One step towards where the ray meets the displaced surface.
        to_water = (min(water.height, 0.5 * ray.origin.y) - ray.origin.y) / ray.direction.y;
        at = ray.origin + to_water * ray.direction;
        water = surface(records, waves, at.xz, footprint);
    } else {
        at.y = 0.0;
    }
    let normal = normalize(vec3(-water.slope.x, 1.0, -water.slope.y));
    let grazing = -dot(ray.direction, normal);
    var direction = ray.direction + 2.0 * grazing * normal;
    direction.y = max(direction.y, LEAST_CLIMB);
    let up = Ray(at, direction);
    // The picture's own ripples are in its maps already.
    let blur = sqrt(max(water.roughness - tour.ripples.x * tour.ripples.x, 0.0));

    let look = Look(row, eye_of(records, row), grazing, to_water, blur);
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
    var share = 1.0;
    var seen = see_far(tour, away);
    if last.kind != INFINITE {
        let met = meet(records, row, 0, last, up);
        if met.distance > 0.0 && met.distance < 1e9 {
            let image = mirror(met.rest);
            seen = see(tour, image);
            was = tour.eye.xyz - image;
            away = mirror(met.point) - look.eye;
            share = met.distance / (met.distance + to_water);
        }
    }
    let level = level_of(tour, records, row, away, seen.z, last.atlas.z);
    let soft = blur_of(tour, look, share, last.atlas.z, level);
#ifdef TOUR_DRIFTS
    // In the water clouds that rise sink.
    let first = cloud_copy(records, 0);
    let second = cloud_copy(records, 1);
    let down = vec2(1.0, -1.0);
    let sky = first.z * sample_blurred(maps, filtering, last, seen.xy - first.xy * down, soft)
        + second.z * sample_blurred(maps, filtering, last, seen.xy - second.xy * down, soft);
#else
    let sky = sample_blurred(maps, filtering, last, seen.xy, soft);
#endif
    light = behind(light, vec4(at_angle(tour, sky, was, grazing).rgb, 1.0));
    return light.color;
}
