// The moving water: waves of the wind and the ripples over them, as a pixel sees them.
//
// Twin of `water/surface.rs`, `water/sea/tile.rs` and `water/ripples/sample.rs`.

#define_import_path bevy_picture_tour::waves

#import bevy_picture_tour::tour::WATER_ROW

// The texture: ripples above; below them two tiles of the sea side by side, their mip levels under each other.
const RIPPLES: i32 = 256;
const TILE: i32 = 128;
const COARSEST: f32 = 7.0;

struct WaterPoint {
    // Meters above the resting water.
    height: f32,
    // Change of the height along x and z.
    slope: vec2<f32>,
    // Variance, in any one direction, of the slopes that a pixel does not resolve.
    roughness: f32,
}

fn tile_texel(waves: texture_2d<f32>, tile: i32, level: i32, place: vec2<i32>) -> vec4<f32> {
    let last = (TILE >> u32(level)) - 1;
    let start = 2 * TILE - ((2 * TILE) >> u32(level));
    // A tile repeats; its side is a power of two.
    return textureLoad(waves, vec2(tile * TILE + (place.x & last), RIPPLES + start + (place.y & last)), 0);
}

fn tile_mean(waves: texture_2d<f32>, tile: i32, level: i32, turns: vec2<f32>) -> vec4<f32> {
    let count = f32(TILE >> u32(level));
    let place = fract(turns) * count + 0.5 / exp2(f32(level)) - 0.5;
    let corner = floor(place);
    let part = place - corner;
    let at = vec2<i32>(corner);
    let upper = mix(
        tile_texel(waves, tile, level, at),
        tile_texel(waves, tile, level, at + vec2(1, 0)),
        part.x,
    );
    let lower = mix(
        tile_texel(waves, tile, level, at + vec2(0, 1)),
        tile_texel(waves, tile, level, at + vec2(1, 1)),
        part.x,
    );
    return mix(upper, lower, part.y);
}

// A tile of the sea between two mip levels.
fn sea_mean(waves: texture_2d<f32>, tile: i32, turns: vec2<f32>, level: f32) -> vec4<f32> {
    let low = i32(level);
    let fine = tile_mean(waves, tile, low, turns);
    if level == f32(low) {
        return fine;
    }
    return mix(fine, tile_mean(waves, tile, low + 1, turns), level - f32(low));
}

// What a mip level of a tile has lost of the slopes' variance.
fn lost(records: texture_2d<f32>, tile: i32, level: i32) -> f32 {
    return textureLoad(records, vec2(2 + 2 * tile + level / 4, WATER_ROW), 0)[level % 4];
}

fn ripple_mean(waves: texture_2d<f32>, place: vec2<f32>) -> vec4<f32> {
    let corner = floor(place);
    let part = place - corner;
    let at = vec2<i32>(corner);
    let upper = mix(textureLoad(waves, at, 0), textureLoad(waves, at + vec2(1, 0), 0), part.x);
    let lower = mix(textureLoad(waves, at + vec2(0, 1), 0), textureLoad(waves, at + vec2(1, 1), 0), part.x);
    return mix(upper, lower, part.y);
}

// The surface at (x, z) for a pixel that covers `footprint` meters of it.
fn surface(records: texture_2d<f32>, waves: texture_2d<f32>, xz: vec2<f32>, footprint: f32) -> WaterPoint {
    var found = WaterPoint(0.0, vec2(0.0), 0.0);
    // Sizes of both tiles along x and z, 0 without a sea; where the ripples' cells begin and how large they are, 0 without.
    let tiles = textureLoad(records, vec2(0, WATER_ROW), 0);
    let grid = textureLoad(records, vec2(1, WATER_ROW), 0);
    if tiles.x > 0.0 {
        found.roughness = grid.w;
        for (var tile = 0; tile < 2; tile++) {
            let size = select(tiles.zw, tiles.xy, tile == 0);
            let level = clamp(log2(footprint * f32(TILE) / min(size.x, size.y)), 0.0, COARSEST);
            let mean = sea_mean(waves, tile, xz / size, level);
            found.height += mean.x;
            found.slope += mean.yz;
            let low = lost(records, tile, i32(level));
            let high = lost(records, tile, i32(ceil(level)));
            found.roughness += mix(low, high, fract(level));
        }
    }
    if grid.z > 0.0 {
        let place = (xz - grid.xy) / grid.z - 0.5;
        if all(place >= vec2(0.0)) && all(place < vec2(f32(RIPPLES - 1))) {
            let mean = ripple_mean(waves, place);
            found.height += mean.x;
            found.slope += mean.yz;
        }
    }
    return found;
}
