//! `TourUniform` reaches the shader unmoved: every field is sent with numbers of its own and read back where WGSL has it.
//!
//! `tour.wgsl` imports Bevy's shaders, so naga is given the struct's text alone.

use bevy::render::render_resource::ShaderType;
use bevy::render::render_resource::encase::UniformBuffer;

use super::*;

/// The text of a struct of a shader file, from `struct` to the closing brace.
fn struct_text<'a>(source: &'a str, name: &str) -> &'a str {
    let start = source.find(&format!("struct {name} {{")).expect("the struct should be in the file");
    let length = source[start..].find('}').expect("the struct should end") + 1;
    &source[start..start + length]
}

/// Byte offset of each member of a WGSL struct, and the size of the whole.
fn wgsl_layout(text: &str, name: &str) -> (Vec<(String, usize)>, u64) {
    let module = naga::front::wgsl::parse_str(text).expect("the struct should parse");
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let (_, ty) = found.expect("the struct should be a type");
    let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is not a struct") };
    let members = members
        .iter()
        .map(|member| (member.name.clone().unwrap_or_default(), member.offset as usize))
        .collect();
    (members, u64::from(*span))
}

#[test]
fn the_tour_uniform_reaches_the_shader_unmoved() {
    let field = |number: f32| Vec4::new(number, number + 0.25, number + 0.5, number + 0.75);
    let sent = TourUniform {
        picture_from_x: field(1.0),
        picture_from_y: field(2.0),
        picture_from_z: field(3.0),
        eye: field(4.0),
        layer: field(5.0),
        flags: field(6.0),
        water: field(7.0),
        ripples: field(8.0),
    };
    let mut buffer = UniformBuffer::new(Vec::<u8>::new());
    buffer.write(&sent).unwrap();
    let bytes = buffer.into_inner();

    let text = struct_text(include_str!("tour.wgsl"), "TourUniform");
    let (members, size) = wgsl_layout(text, "TourUniform");

    assert_eq!(size, TourUniform::min_size().get(), "bytes in WGSL and in Rust");
    let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let read: Vec<(&str, [f32; 4])> = members
        .iter()
        .map(|(name, at)| (name.as_str(), [0, 4, 8, 12].map(|more| number(at + more))))
        .collect();
    let names =
        ["picture_from_x", "picture_from_y", "picture_from_z", "eye", "layer", "flags", "water", "ripples"];
    let expected: Vec<(&str, [f32; 4])> =
        names.into_iter().zip(1_u8..).map(|(name, i)| (name, field(f32::from(i)).to_array())).collect();
    assert_eq!(read, expected, "what WGSL reads is not what Rust sends");
}

#[test]
fn the_shader_binds_what_the_material_sends() {
    // The bindings of `AsBindGroup`: 0 the uniform, 1 the records, 2 and 3 a texture and its sampler, 4 the waves.
    let source = include_str!("part.wgsl");
    let bindings = [
        "var<uniform> tour: TourUniform",
        "var records: texture_2d<f32>",
        "texture_2d<f32>",
        "sampler",
        "var waves: texture_2d<f32>",
    ];
    for (number, what) in bindings.into_iter().enumerate() {
        let binding = format!("@binding({number}) ");
        let line = source.lines().find(|line| line.contains(&binding));
        let line = line.unwrap_or_else(|| panic!("part.wgsl has no {binding}"));
        assert!(line.contains(what), "binding {number} is not {what:?}: {line}");
    }
}
