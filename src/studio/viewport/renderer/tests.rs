//! Draws off screen and looks at the pixels. Where there is no graphics adapter, not even a software rasteriser, nothing can be shown.

use super::*;
use crate::picture::{Color, Item, Scene, Texture};
use eframe::egui::vec2;
use image::{Rgba, RgbaImage};
use std::pin::pin;
use std::task::{Context, Poll, Waker};

/// Side of the picture, pixels: a row is as long as copies from the card must be.
const SIDE: u32 = 64;
const FELT: Color = Color(0, 120, 0, 255);

/// The future of an adapter or a device, which is ready at once or after a little asking.
fn finish<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(done) = future.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return done;
        }
        std::thread::yield_now();
    }
}

/// What a view of `geometry` shows, 1 mm a pixel, its middle in the origin.
fn drawn(geometry: Geometry) -> Option<RgbaImage> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = finish(instance.request_adapter(&Default::default())).ok()?;
    let (device, queue) = finish(adapter.request_device(&Default::default())).ok()?;
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let mut renderer = Renderer::new(&device, format, 1);
    let camera = Camera { center: [0.0; 2], scale: 1.0 };
    let size = vec2(SIDE as f32, SIDE as f32);
    renderer.prepare(&device, &queue, &ViewCallback { slot: 0, camera, size, geometry: Arc::new(geometry) }, 1.0);
    let extent = wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 };
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: extent,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let bytes = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(4 * SIDE * SIDE),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &target.create_view(&Default::default()),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    });
    renderer.paint(0, &mut pass.forget_lifetime());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIDE), rows_per_image: None };
    let copy = wgpu::TexelCopyBufferInfo { buffer: &bytes, layout };
    encoder.copy_texture_to_buffer(target.as_image_copy(), copy, extent);
    queue.submit([encoder.finish()]);
    bytes.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
    let pixels = bytes.get_mapped_range(..).ok()?.to_vec();
    RgbaImage::from_raw(SIDE, SIDE, pixels)
}

#[test]
fn a_texture_is_mapped_by_its_places_over_the_felt() {
    // Red, blue, and clear from left to right, three times as large as it is drawn.
    let picture = RgbaImage::from_fn(120, 120, |x, _| match x {
        0..40 => Rgba([200, 0, 0, 255]),
        40..80 => Rgba([0, 0, 220, 255]),
        _ => Rgba([255, 255, 255, 0]),
    });
    // 40 mm wide, leant to the right by as much as it is high; its right quarter lies outside of the texture.
    let points = vec![[-30.0, -10.0], [10.0, -10.0], [30.0, 10.0], [-10.0, 10.0]];
    let places = vec![[0.0, 1.0], [4.0 / 3.0, 1.0], [4.0 / 3.0, 0.0], [0.0, 0.0]];
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    let felt = Item::Mesh { points: points.clone(), triangles: triangles.clone(), color: FELT };
    let texture = Arc::new(Texture::of(picture));
    let scene = Scene { items: vec![felt, Item::Picture { points, places, triangles, texture }] };
    let Some(shown) = drawn(Geometry::of(&scene)) else {
        eprintln!("no graphics adapter: nothing was drawn");
        return;
    };
    // Pixels from the left rim of the parallelogram, in its middle and near its top and bottom.
    for y in [-8_i32, 0, 8] {
        let at = |along: i32| *shown.get_pixel((32 - 20 + y + along) as u32, (32 - y) as u32);
        for (along, expected) in [(5, [200, 0, 0]), (15, [0, 0, 220]), (25, [0, 120, 0]), (35, [0, 120, 0])] {
            let Rgba([r, g, b, _]) = at(along);
            let near = [r, g, b].iter().zip(expected).all(|(found, wanted)| found.abs_diff(wanted) <= 2);
            assert!(near, "{:?} at {along}, {y}, not {expected:?}", at(along));
        }
    }
    assert_eq!(shown.get_pixel(2, 2).0, [0, 0, 0, 255]);
}
