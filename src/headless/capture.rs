//! From a rendered texture to pixels, waiting for the GPU.

use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::render_asset::RenderAssets;
use bevy::render::render_resource::{
    BufferDescriptor, BufferUsages, CommandEncoderDescriptor, MapMode, PollType, TexelCopyBufferInfo,
    TexelCopyBufferLayout,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::texture::GpuImage;

use crate::picture::Picture;

/// Reads an `Rgba8UnormSrgb` image as it was rendered by the last update; alpha is dropped.
///
/// # Errors
///
/// This returns a text when the image is not on the GPU or the device fails.
pub fn read(app: &App, image: &Handle<Image>, size: UVec2) -> Result<Picture, String> {
    let world = app.sub_app(RenderApp).world();
    let gpu = world
        .resource::<RenderAssets<GpuImage>>()
        .get(image)
        .ok_or_else(|| "the target is not on the GPU".to_owned())?;
    let (device, queue) = (world.resource::<RenderDevice>(), world.resource::<RenderQueue>());
    let row = size.x as usize * 4;
    // Rows in a buffer start at multiples of 256 bytes.
    let padded = RenderDevice::align_copy_bytes_per_row(row);
    let buffer = device.create_buffer(&BufferDescriptor {
        label: Some("frame"),
        size: (padded * size.y as usize) as u64,
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor { label: Some("frame") });
    let layout =
        TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded as u32), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        gpu.texture.as_image_copy(),
        TexelCopyBufferInfo { buffer: &buffer, layout },
        gpu.texture_descriptor.size,
    );
    queue.submit([encoder.finish()]);
    let slice = buffer.slice(..);
    let (send, receive) = std::sync::mpsc::channel();
    slice.map_async(MapMode::Read, move |result| {
        let _ = send.send(result);
    });
    device.poll(PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
    receive.recv().map_err(|error| error.to_string())?.map_err(|error| error.to_string())?;
    let data = slice.get_mapped_range();
    let pixels = data
        .chunks_exact(padded)
        .flat_map(|line| line[..row].chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2]]))
        .collect();
    Picture::new(size, pixels).map_err(|error| error.to_string())
}
