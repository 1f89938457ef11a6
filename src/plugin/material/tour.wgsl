// What the tour's shaders share: records, rays, and where the picture's camera sees a point.
//
// Points are found by intersecting rays in tour space; nothing is interpolated over a quad (architecture.md,
// decision 2). `see` and `level_of` are twins of `trace/`, `snap`,
// `sharp` and `mip_level` of `maps/grid.rs` and `maps/mipmaps.rs`, `meet` of `scene/arrangement.rs`.

#define_import_path bevy_picture_tour::tour

#import bevy_pbr::mesh_view_bindings::view
#import bevy_picture_tour::sway::{SwayMode, SwayRecord, rest_point}

const VIEW_ROWS: i32 = 8;
const COMPONENT_ROW: i32 = 8;
const SWAY_ROW: i32 = 9;
const WATER_ROW: i32 = 10;
const CLOUDS: i32 = 6;
const TEXELS_PER_SWAY: i32 = 8;
const TEXELS_PER_COMPONENT: i32 = 5;
const FIRST_PLACEMENT: i32 = 24;
const TEXELS_PER_PLACEMENT: i32 = 3;
const MIP_LEVELS: f32 = 4.0;
const LEAST_DEPTH: f32 = 1e-3;

const WALL: f32 = 0.0;
const LEVEL: f32 = 1.0;
const INFINITE: f32 = 2.0;

struct TourUniform {
    // Columns of the matrix from a tour-space direction to homogeneous picture pixels.
    picture_from_x: vec4<f32>,
    picture_from_y: vec4<f32>,
    picture_from_z: vec4<f32>,
    // The picture's camera (tour space); w: the component's index.
    eye: vec4<f32>,
    // The texture map's first pixel and its size, picture pixels.
    layer: vec4<f32>,
    // x: 1 where the mesh stands for infinity, y: most coverage that is dropped (0.5 in depth passes, else below 0),
    // z: texels per picture pixel, w: the picture's focal length in its pixels.
    flags: vec4<f32>,
    // The water's own color (linear light), and how closely its reflectance follows Fresnel's law, 0 to 1.
    water: vec4<f32>,
    // x: root mean square slope of the ripples in the picture itself.
    ripples: vec4<f32>,
}

struct Component {
    kind: f32,
    // Level: its height.
    height: f32,
    // Wall: x and z of its foot, and of the unit vector along it, at rest.
    line: vec4<f32>,
    // Wall: low and high along from the foot, low and high y. Level: low and high x, low and high z.
    extent: vec4<f32>,
    // The reflection map's first pixel and size, picture pixels.
    layer: vec4<f32>,
    // Its place in the atlas (xy, texels), its scale (z, texels per picture pixel), 1 if there is one (w).
    atlas: vec4<f32>,
}

// Where a wall is for a view: what is `s` along and `y` high lies at origin + s · along + y · up.
struct Placement {
    origin: vec3<f32>,
    along: vec3<f32>,
    up: vec3<f32>,
    // Share of the mirrored copy in what it shows, 0 to 1.
    mirrored: f32,
}

// Where a ray meets a component.
struct Meeting {
    // Along the ray; negative for a miss.
    distance: f32,
    point: vec3<f32>,
    // Where that is on the component: along and up a wall, x and z of a level.
    place: vec2<f32>,
    // The point that is there when nothing moves.
    rest: vec3<f32>,
    // The point that the mirrored copy shows there, and its share in what is shown.
    copy: vec3<f32>,
    mirrored: f32,
}

struct Ray {
    origin: vec3<f32>,
    direction: vec3<f32>,
}

// The row of the records that belongs to the view being drawn: the one whose world_from_view is nearest to it.
fn view_row(records: texture_2d<f32>) -> i32 {
    var best = 0;
    var least = 1e30;
    for (var row = 0; row < VIEW_ROWS; row++) {
        // Unused rows are marked by a negative count.
        if textureLoad(records, vec2(5, row), 0).w < 0.0 {
            continue;
        }
        var difference = 0.0;
        for (var column = 0; column < 4; column++) {
            let apart = textureLoad(records, vec2(column, row), 0).xyz - view.world_from_view[column].xyz;
            difference += dot(apart, apart);
        }
        if difference < least {
            least = difference;
            best = row;
        }
    }
    return best;
}

// The ray of tour space through a fragment.
fn fragment_ray(records: texture_2d<f32>, row: i32, fragment: vec2<f32>) -> Ray {
    let viewport = view.main_pass_viewport;
    let ndc = (fragment - viewport.xy) / viewport.zw * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    let near = view.view_from_clip * vec4(ndc, 1.0, 1.0);
    let in_view = near.xyz / near.w;
    let direction = textureLoad(records, vec2(4, row), 0).xyz * in_view.x
        + textureLoad(records, vec2(5, row), 0).xyz * in_view.y
        + textureLoad(records, vec2(6, row), 0).xyz * in_view.z;
    return Ray(textureLoad(records, vec2(7, row), 0).xyz, normalize(direction));
}

fn component(records: texture_2d<f32>, index: i32) -> Component {
    let first = index * TEXELS_PER_COMPONENT;
    let kind = textureLoad(records, vec2(first, COMPONENT_ROW), 0);
    return Component(
        kind.x,
        kind.y,
        textureLoad(records, vec2(first + 1, COMPONENT_ROW), 0),
        textureLoad(records, vec2(first + 2, COMPONENT_ROW), 0),
        textureLoad(records, vec2(first + 3, COMPONENT_ROW), 0),
        textureLoad(records, vec2(first + 4, COMPONENT_ROW), 0),
    );
}

fn placement(records: texture_2d<f32>, row: i32, index: i32) -> Placement {
    let first = FIRST_PLACEMENT + index * TEXELS_PER_PLACEMENT;
    let origin = textureLoad(records, vec2(first, row), 0);
    return Placement(
        origin.xyz,
        textureLoad(records, vec2(first + 1, row), 0).xyz,
        textureLoad(records, vec2(first + 2, row), 0).xyz,
        origin.w,
    );
}

// Where a resting point of a wall is for a view.
fn placed(found: Component, at: Placement, rest: vec3<f32>) -> vec3<f32> {
    return at.origin + dot(rest.xz - found.line.xy, found.line.zw) * at.along + rest.y * at.up;
}

#ifdef TOUR_SWAYS
// Which point of a wall, along and up, is seen at a place of it when its plant sways.
fn unbent(records: texture_2d<f32>, index: i32, place: vec2<f32>) -> vec2<f32> {
    let first = index * TEXELS_PER_SWAY;
    let size = textureLoad(records, vec2(first + 1, SWAY_ROW), 0);
    if size.z == 0.0 {
        return place;
    }
    var rows: array<vec4<f32>, 6>;
    for (var i = 0; i < 6; i++) {
        rows[i] = textureLoad(records, vec2(first + 2 + i, SWAY_ROW), 0);
    }
    let sway = SwayRecord(
        textureLoad(records, vec2(first, SWAY_ROW), 0),
        size,
        SwayMode(rows[0], rows[1]),
        SwayMode(rows[2], rows[3]),
        SwayMode(rows[4], rows[5]),
    );
    return rest_point(sway, place);
}
#endif

// Where a ray meets the component's unbounded plane; `inside` tells whether that is in its rectangle.
fn meet(records: texture_2d<f32>, row: i32, index: i32, found: Component, ray: Ray) -> Meeting {
    if found.kind == LEVEL {
        let distance = (found.height - ray.origin.y) / ray.direction.y;
        let point = ray.origin + distance * ray.direction;
        return Meeting(distance, point, point.xz, point, point, 0.0);
    }
    let at = placement(records, row, index);
    let normal = cross(at.along, at.up);
    let distance = dot(normal, at.origin - ray.origin) / dot(normal, ray.direction);
    let point = ray.origin + distance * ray.direction;
    let place = vec2(dot(point - at.origin, at.along), dot(point - at.origin, at.up));
#ifdef TOUR_SWAYS
    let rest = unbent(records, index, place);
#else
    let rest = place;
#endif
    let line = found.line.xy + rest.x * found.line.zw;
    let copy = found.line.xy - rest.x * found.line.zw;
    return Meeting(
        distance, point, place, vec3(line.x, rest.y, line.y), vec3(copy.x, rest.y, copy.y), at.mirrored,
    );
}

fn inside(found: Component, place: vec2<f32>) -> bool {
    return all(place >= found.extent.xz) && all(place <= found.extent.yw);
}

// Where a direction from the picture's camera is in the picture, pixels; and the view depth of the direction itself.
fn see_far(tour: TourUniform, direction: vec3<f32>) -> vec3<f32> {
    let seen = tour.picture_from_x.xyz * direction.x
        + tour.picture_from_y.xyz * direction.y
        + tour.picture_from_z.xyz * direction.z;
    let depth = max(seen.z, LEAST_DEPTH);
    return vec3(seen.xy / depth, depth);
}

// Where a point is in the picture, pixels; and its view depth there, meters.
fn see(tour: TourUniform, point: vec3<f32>) -> vec3<f32> {
    return see_far(tour, point - tour.eye.xyz);
}

fn mip_level(texels: f32) -> f32 {
    let octaves = log2(texels);
    return clamp(select(1.25 * (octaves - 0.2), octaves, octaves >= 1.0), 0.0, MIP_LEVELS);
}

// The mip level for what lies `away` from a view's camera and `depth` meters before the picture's, in a map of `scale`
// texels per picture pixel. Maps and screen are both made by pinholes, so a pixel covers about as many texels across as
// up and down.
fn level_of(
    tour: TourUniform,
    records: texture_2d<f32>,
    row: i32,
    away: vec3<f32>,
    depth: f32,
    scale: f32,
) -> f32 {
    let forward = -textureLoad(records, vec2(6, row), 0).xyz;
    let focal = 0.5 * view.main_pass_viewport.w * view.clip_from_view[1][1];
    return mip_level(scale * tour.flags.w * max(dot(forward, away), 0.0) / (focal * depth));
}

// Where a view's camera is.
fn eye_of(records: texture_2d<f32>, row: i32) -> vec3<f32> {
    return textureLoad(records, vec2(7, row), 0).xyz;
}

// Brings a point within 1/32 pixel of a pixel center to that center.
fn snap(point: vec2<f32>) -> vec2<f32> {
    let center = floor(point) + 0.5;
    return select(point, center, abs(point - center) < vec2(1.0 / 32.0));
}

// Catmull and Rom's weights of the four texels around a place `t` between the middle two.
fn cubic(t: f32) -> vec4<f32> {
    return vec4(
        t * (-0.5 + t * (1.0 - 0.5 * t)),
        1.0 + t * t * (-2.5 + 1.5 * t),
        t * (0.5 + t * (2.0 - 1.5 * t)),
        t * t * (-0.5 + 0.5 * t),
    );
}

// A map at `at`, in texels, kept within the block of texels from `low` to `high` (the last one), at a mip level. The
// block's border is prolonged.
fn sharp(
    map: texture_2d<f32>,
    filtering: sampler,
    at: vec2<f32>,
    low: vec2<f32>,
    high: vec2<f32>,
    level: f32,
) -> vec4<f32> {
    // Written once: where branches are not skipped (software GPUs), every copy would be paid for.
    var fine = vec4(0.0);
    if level < 1.0 {
        fine = sharpest(map, filtering, at, low, high);
    }
    if level <= 0.0 {
        return fine;
    }
    // Half a texel of the coarsest level that is read stays between the place and the block's border.
    let step = exp2(ceil(level));
    let limit = low + ceil((high - low + 1.0) / step) * step;
    let place = clamp(at, low + 0.5 * step, limit - 0.5 * step) / vec2<f32>(textureDimensions(map));
    // Levels are premultiplied.
    let coarse = textureSampleLevel(map, filtering, place, max(level, 1.0));
    let mixed = mix(vec4(fine.a * fine.rgb, fine.a), coarse, min(level, 1.0));
    return vec4(min(mixed.rgb / max(mixed.a, 1e-6), vec3(1.0)), mixed.a);
}

// The same at its finest level: cubic, and within what the four nearest texels span, so that nothing rings. Texels weigh as
// much as they cover: what the lift made bright to show through hardly anything would shine beside them.
fn sharpest(
    map: texture_2d<f32>,
    filtering: sampler,
    at: vec2<f32>,
    low: vec2<f32>,
    high: vec2<f32>,
) -> vec4<f32> {
    let inside = clamp(at, low + 0.5, high + 0.5);
    let corner = floor(inside - 0.5);
    let part = inside - 0.5 - corner;
    if all(part == vec2(0.0)) {
        return textureLoad(map, vec2<i32>(corner), 0);
    }
    let linear = textureSampleLevel(map, filtering, inside / vec2<f32>(textureDimensions(map)), 0.0);
    if linear.a <= 0.0 {
        return vec4(0.0);
    }
    let across = cubic(part.x);
    let down = cubic(part.y);
    var sum = vec4(0.0);
    var least = vec4(1.0);
    var most = vec4(0.0);
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let place = clamp(corner + vec2(f32(x - 1), f32(y - 1)), low, high);
            let texel = textureLoad(map, vec2<i32>(place), 0);
            sum += across[x] * down[y] * vec4(texel.a * texel.rgb, texel.a);
            if (x == 1 || x == 2) && (y == 1 || y == 2) {
                least = min(least, texel);
                most = max(most, texel);
            }
        }
    }
    return clamp(vec4(sum.rgb / max(sum.a, 1e-4), sum.a), least, most);
}

// A texel with coverage and the one that takes its place, by a share. Twin of `cross_faded` in `trace/`.
fn cross_faded(texel: vec4<f32>, other: vec4<f32>, share: f32) -> vec4<f32> {
    let coverage = mix(texel.a, other.a, share);
    let light = mix(texel.a * texel.rgb, other.a * other.rgb, share);
    return vec4(light / max(coverage, 1e-6), coverage);
}

// A copy of the clouds: how far it is moved, picture pixels (xy), and its share (z).
fn cloud_copy(records: texture_2d<f32>, copy: i32) -> vec3<f32> {
    return textureLoad(records, vec2(CLOUDS + copy, WATER_ROW), 0).xyz;
}

fn mirror(point: vec3<f32>) -> vec3<f32> {
    return vec3(point.x, -point.y, point.z);
}
