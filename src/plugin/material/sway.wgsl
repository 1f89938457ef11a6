// How a plant is bent at one moment, and where a point of it rests.
//
// Twin of `wind/sway.rs`: same names, same steps. Everything happens in the component's own plane: x meters to the right
// along it, y meters up.

#define_import_path bevy_picture_tour::sway

const FORESHORTENING: f32 = 0.5714285714;
const ROUNDNESS: f32 = 0.5;
const UPDATES: i32 = 3;
const FIRST_WAVE: vec2<f32> = vec2<f32>(0.8, 0.6);
const SECOND_WAVE: vec2<f32> = vec2<f32>(-0.6, 0.8);
const SECOND_SEED: f32 = 2.4;

struct SwayMode {
    // Complex way of the tip, meters (xy); phase per meter to the right and up (zw), radians.
    motion: vec4<f32>,
    // Phase noise: amplitude of each of its two waves, radians; wave number, radians per meter; phase, radians.
    noise: vec4<f32>,
}

struct SwayRecord {
    // Root; unit vector from root to tip.
    stem: vec4<f32>,
    // Length, half the crown's width (meters), 1 if the plant moves.
    size: vec4<f32>,
    bending: SwayMode,
    branches: SwayMode,
    leaves: SwayMode,
}

// A mode's complex way at a place, meters, for a mode shape of 1.
fn mode_motion(mode: SwayMode, from_root: vec2<f32>) -> vec2<f32> {
    let motion = mode.motion;
    let noise = mode.noise;
    let phase = dot(motion.zw, from_root)
        + noise.x
            * (sin(noise.y * dot(from_root, FIRST_WAVE) + noise.z)
                + sin(noise.y * dot(from_root, SECOND_WAVE) + SECOND_SEED * noise.z));
    let sine = sin(phase);
    let cosine = cos(phase);
    return vec2(motion.x * cosine + motion.y * sine, motion.y * cosine - motion.x * sine);
}

// How far the point that rests at `rest` is moved, meters.
fn displacement(record: SwayRecord, rest: vec2<f32>) -> vec2<f32> {
    let from_root = rest - record.stem.xy;
    let axis = record.stem.zw;
    let side = vec2(axis.y, -axis.x);
    let q = clamp(dot(from_root, axis) / record.size.x, 0.0, 1.0);
    let off = dot(from_root, side);

    // A uniformly loaded cantilever (notes §6.1).
    let bend = q * q * (q * q - 4.0 * q + 6.0) / 3.0;
    let crown = q * q * (1.0 + 0.5 * off * off / (off * off + record.size.y * record.size.y));

    let bent = bend * mode_motion(record.bending, from_root).x;
    let swung = crown * (mode_motion(record.branches, from_root) + mode_motion(record.leaves, from_root));
    return side * (bent + swung.x) + axis * (ROUNDNESS * swung.y - FORESHORTENING * bent * bent / record.size.x);
}

// The rest point of what is seen at `moved`: the point whose displacement leads there.
fn rest_point(record: SwayRecord, moved: vec2<f32>) -> vec2<f32> {
    if record.size.z == 0.0 {
        return moved;
    }
    var rest = moved;
    for (var i = 0; i < UPDATES; i++) {
        rest = moved - displacement(record, rest);
    }
    return rest;
}
