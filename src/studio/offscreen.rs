//! A screen that nobody sees: the window's own renderer on whatever graphics adapter there is.

use eframe::egui::{self, FullOutput};
use egui_wgpu::wgpu;
use egui_wgpu::{RenderState, RendererOptions, ScreenDescriptor, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use image::RgbaImage;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};

/// An adapter, what it draws with, and the picture it draws into.
pub struct Screen {
    pub state: RenderState,
    target: wgpu::Texture,
    /// Where the adapter can tell times.
    stamps: Option<Stamps>,
    descriptor: ScreenDescriptor,
}

/// The begin and the end of a pass, as the adapter tells them.
struct Stamps {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
}

/// Bytes of two times.
const STAMPS: u64 = 16;
/// Rows of a picture are copied in multiples of this, bytes.
const ROW: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

impl Screen {
    /// One of a size in pixels.
    ///
    /// # Errors
    /// Why there is no adapter, in a sentence.
    pub fn new(size: [u32; 2], pixels_per_point: f32) -> Result<Self, String> {
        let mut setup = WgpuSetupCreateNew::without_display_handle();
        let described = setup.device_descriptor.clone();
        setup.device_descriptor = Arc::new(move |adapter| {
            let mut descriptor = described(adapter);
            descriptor.required_features |= adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
            descriptor
        });
        let config = WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..Default::default() };
        let instance = finish(config.wgpu_setup.new_instance());
        let options = RendererOptions { msaa_samples: 1, dithering: false, ..Default::default() };
        let state =
            finish(RenderState::create(&config, &instance, None, options)).map_err(|error| error.to_string())?;
        let target = state.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("off screen"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: state.target_format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let stamps = state.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let stamps = stamps.then(|| Stamps::new(&state.device));
        Ok(Self { target, stamps, descriptor: ScreenDescriptor { size_in_pixels: size, pixels_per_point }, state })
    }

    /// Which adapter it is, and by which interface it is used.
    pub fn adapter(&self) -> String {
        let info = self.state.adapter.get_info();
        format!("{} ({:?}, {})", info.name, info.backend, info.driver_info)
    }

    pub fn pixels_per_point(&self) -> f32 {
        self.descriptor.pixels_per_point
    }

    /// The area in logical pixels.
    pub fn rect(&self) -> egui::Rect {
        let size = self.descriptor.size_in_pixels.map(|pixels| pixels as f32 / self.descriptor.pixels_per_point);
        egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(size[0], size[1]))
    }

    /// Hands what a frame of egui draws over to the adapter, which draws on by itself.
    pub fn draw(&mut self, ctx: &egui::Context, output: FullOutput, background: [f32; 4]) {
        let FullOutput { shapes, pixels_per_point, mut textures_delta, .. } = output;
        let jobs = ctx.tessellate(shapes, pixels_per_point);
        let (device, queue) = (&self.state.device, &self.state.queue);
        let mut renderer = self.state.renderer.write();
        for (id, delta) in &textures_delta.set {
            for part in delta {
                renderer.update_texture(device, queue, *id, part);
            }
        }
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut commands = renderer.update_buffers(device, queue, &mut encoder, &jobs, &self.descriptor);
        let [r, g, b, a] = background.map(f64::from);
        let stamped = self.stamps.as_ref().map(|stamps| wgpu::RenderPassTimestampWrites {
            query_set: &stamps.set,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        });
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("off screen"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.target.create_view(&Default::default()),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            timestamp_writes: stamped,
            ..Default::default()
        });
        renderer.render(&mut pass.forget_lifetime(), &jobs, &self.descriptor);
        if let Some(stamps) = &self.stamps {
            encoder.resolve_query_set(&stamps.set, 0..2, &stamps.resolved, 0);
            encoder.copy_buffer_to_buffer(&stamps.resolved, 0, &stamps.read, 0, STAMPS);
        }
        commands.push(encoder.finish());
        queue.submit(commands);
        textures_delta.free.iter().for_each(|id| renderer.free_texture(id));
        textures_delta.clear();
    }

    /// Waits until all is drawn.
    ///
    /// # Errors
    /// What the adapter says where it is lost.
    pub fn wait(&self) -> Result<(), String> {
        self.state.device.poll(wgpu::PollType::wait_indefinitely()).map(|_| ()).map_err(|error| error.to_string())
    }

    /// What the last frame took on the adapter, ms; nothing where it tells no times.
    pub fn drawn_ms(&self) -> Option<f64> {
        let stamps = self.stamps.as_ref()?;
        stamps.read.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait().ok()?;
        let times = stamps.read.get_mapped_range(..).ok().map(|bytes| {
            let time =
                |k: usize| bytes.get(8 * k..8 * k + 8).and_then(|b| b.try_into().ok()).map_or(0, u64::from_le_bytes);
            time(1).wrapping_sub(time(0))
        });
        stamps.read.unmap();
        Some(times? as f64 * f64::from(self.state.queue.get_timestamp_period()) * 1e-6)
    }

    /// What is on it.
    ///
    /// # Errors
    /// What the adapter says where it is lost.
    pub fn picture(&self) -> Result<RgbaImage, String> {
        let [width, height] = self.descriptor.size_in_pixels;
        let row = (4 * width).next_multiple_of(ROW);
        let bytes = self.state.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(row * height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.state.device.create_command_encoder(&Default::default());
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        let copy = wgpu::TexelCopyBufferInfo { buffer: &bytes, layout };
        encoder.copy_texture_to_buffer(self.target.as_image_copy(), copy, self.target.size());
        self.state.queue.submit([encoder.finish()]);
        bytes.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let rows = bytes.get_mapped_range(..).map_err(|error| error.to_string())?;
        let pixels = rows.chunks_exact(row as usize).flat_map(|r| r[..4 * width as usize].to_vec()).collect();
        RgbaImage::from_raw(width, height, pixels).ok_or_else(|| "the picture is not whole".to_owned())
    }
}

impl Stamps {
    fn new(device: &wgpu::Device) -> Self {
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("times"),
                size: STAMPS,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        Self {
            set: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            read: buffer(wgpu::BufferUsages::MAP_READ),
        }
    }
}

/// The future of an adapter or a device, which is ready at once or after a little asking.
pub fn finish<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(done) = future.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return done;
        }
        std::thread::yield_now();
    }
}
