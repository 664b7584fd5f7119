//! Draws off screen and looks at the pixels. Where there is no graphics adapter, not even a software rasteriser, nothing can be shown.

use super::*;
use crate::picture::{Color, Item, Scene, Texture};
use crate::studio::offscreen::finish;
use eframe::egui::vec2;
use image::{Rgba, RgbaImage};

/// Side of the picture, pixels: a row is as long as copies from the card must be.
const SIDE: u32 = 64;
const FELT: Color = Color(0, 120, 0, 255);

/// What a view of `geometry` shows, 1 mm a pixel, its middle in the origin.
fn drawn(geometry: Geometry) -> Option<RgbaImage> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = finish(instance.request_adapter(&Default::default())).ok()?;
    let (device, queue) = finish(adapter.request_device(&Default::default())).ok()?;
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let mut renderer = Renderer::new(&device, format, 1);
    let camera = Camera { center: [0.0; 2], scale: 1.0 };
    let size = vec2(SIDE as f32, SIDE as f32);
    renderer.prepare(&device, &queue, &ViewCallback { slot: 0, camera, size, parts: vec![Arc::new(geometry)] }, 1.0);
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

#[test]
fn felt_is_lit_as_the_formula_says() {
    use crate::design::Design;
    use crate::mesh::Mesh;
    use crate::outline::Outline;
    use crate::picture::Silhouette;
    use crate::picture::plush::{Felt, shade};
    let ring = (0..40).map(|i| std::f64::consts::TAU * f64::from(i) / 40.0).map(|a| [28.0 * a.cos(), 28.0 * a.sin()]);
    let outline = Outline { outer: ring.collect(), holes: Vec::new() };
    let mesh = crate::mesh::generate(&outline, 60).unwrap();
    let silhouette = Arc::new(Silhouette::of(&Design::new("disc", outline, mesh)));
    // A quarter of a picture on it, the rest is bare.
    let texture = Arc::new(Texture::of(RgbaImage::from_pixel(8, 8, Rgba([40, 60, 200, 255]))));
    let frame = [[0.0, 28.0], [28.0, 0.0]];
    let points = silhouette.rest.clone();
    let felt = Felt::of(silhouette.clone(), points.clone(), Color(200, 170, 120, 255), Some((texture, frame)));
    let scene = |felt: &Felt| Scene { items: vec![Item::Plush(felt.clone())] };
    let geometry = Geometry::of(&scene(&felt));
    // In another pose the cloth is the same, and not cut again; in another colour it is.
    let moved = points.iter().map(|p| [p[0] + 1.0, p[1]]).collect();
    let moved = Felt::of(silhouette.clone(), moved, felt.color, felt.texture.clone());
    let posed = Geometry::after(&scene(&moved), &geometry);
    let same = |a: &Geometry, b: &Geometry| matches!((&a.cloth, &b.cloth), (Some(a), Some(b)) if Arc::ptr_eq(a, b));
    assert!(same(&posed, &geometry) && posed.felt != geometry.felt);
    assert!(!same(&Geometry::after(&scene(&Felt { color: FELT, ..felt.clone() }), &geometry), &geometry));
    let Some(shown) = drawn(geometry) else {
        eprintln!("no graphics adapter: nothing was drawn");
        return;
    };
    let cells = Mesh::from((&*silhouette, points));
    for (x, y) in [(32, 32), (20, 25), (44, 40), (32, 10), (12, 40), (50, 20), (40, 25)] {
        let p = [f64::from(x) + 0.5 - 32.0, 32.0 - f64::from(y) - 0.5];
        let at = cells.locate(p, &cells.nodes).unwrap();
        let corners = cells.triangles[at.triangle];
        let mean =
            |of: &dyn Fn(usize) -> f32| -> f32 { corners.iter().zip(at.weights).map(|(&n, w)| w as f32 * of(n)).sum() };
        let slope = [0, 1].map(|k| mean(&|n| felt.slopes[n][k]));
        let height = mean(&|n| silhouette.heights[n] as f32);
        let covered = p[0] > 0.0 && p[1] > 0.0;
        let base = if covered { [40.0, 60.0, 200.0] } else { [200.0, 170.0, 120.0] }.map(|c: f32| c / 255.0);
        let expected = shade(base, slope, height, p.map(|v| v as f32), 1.0).map(|c| 255.0 * c);
        let found = shown.get_pixel(x, y).0;
        let far = expected.iter().zip(found).map(|(e, f)| (e - f32::from(f)).abs()).fold(0.0, f32::max);
        assert!(far < 4.0, "{x} {y}: {found:?}, not {expected:?}");
    }
}
