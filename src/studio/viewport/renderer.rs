//! Draws plushies with wgpu inside egui's pass. Knows nothing of panels, tools or designs.

use super::geometry::{Batch, Capsule, Cloth, Corner, Cut, Geometry, Textured, Woolly};
use super::skin::Skin;
use crate::picture::plush;
use crate::studio::canvas::Camera;
use bytemuck::{Pod, Zeroable};
use egui_wgpu::wgpu;
use egui_wgpu::{CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use std::collections::HashMap;
use std::sync::Arc;

/// Puts what is needed into the window's renderer. `samples` is that of the pass we draw in.
pub fn install(state: &RenderState, samples: u32) {
    let renderer = Renderer::new(&state.device, state.target_format, samples);
    state.renderer.write().callback_resources.insert(renderer);
}

/// One view to draw this frame.
pub struct ViewCallback {
    /// Which view: each keeps buffers of its own.
    pub slot: u64,
    pub camera: Camera,
    /// Size of the view, logical pixels.
    pub size: eframe::egui::Vec2,
    /// In painting order.
    pub parts: Vec<Arc<Geometry>>,
}

/// Pipelines and the buffers of every view.
struct Renderer {
    fill: wgpu::RenderPipeline,
    picture: wgpu::RenderPipeline,
    felt: wgpu::RenderPipeline,
    felt_picture: wgpu::RenderPipeline,
    capsule: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    skin: Skin,
    views: HashMap<u64, View>,
}

struct View {
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    parts: Vec<Part>,
}

/// A part of a view, and the buffers that hold it.
#[derive(Default)]
struct Part {
    geometry: Arc<Geometry>,
    corners: Option<wgpu::Buffer>,
    textured: Option<wgpu::Buffer>,
    felt: Option<wgpu::Buffer>,
    cut: Option<wgpu::Buffer>,
    felt_corners: Option<wgpu::Buffer>,
    capsules: Option<wgpu::Buffer>,
}

/// A capsule is drawn as one triangle around it, not as an instance of two: software rasterisers begin anew at every instance, one triangle is
/// a quarter fewer bytes than two, and a mesh has ten thousand fibres.
const CAPSULE_CORNERS: u32 = 3;

/// `View` of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Uniform {
    center: [f32; 2],
    scale: [f32; 2],
    half_size: [f32; 2],
    pixels_per_point: f32,
    /// WGSL rounds the size up to the alignment.
    padding: f32,
}

/// Corners and capsules as the shaders read them.
const CORNER: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Corner>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Float32, 3 => Unorm8x4],
};
const TEXTURED: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Textured>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2],
};
const WOOLLY: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Woolly>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x2, 2 => Float32x2],
};
const CUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Cut>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![1 => Float32x2, 3 => Float32x2, 4 => Float32, 5 => Unorm8x4],
};
const CAPSULE: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Capsule>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![
        0 => Float32x2, 1 => Float32x2, 2 => Float32, 3 => Float32, 4 => Unorm8x4
    ],
};

impl CallbackTrait for ViewCallback {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        screen: &ScreenDescriptor,
        _encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(renderer) = resources.get_mut::<Renderer>() {
            renderer.prepare(device, queue, self, screen.pixels_per_point);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _info: eframe::egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(renderer) = resources.get::<Renderer>() {
            renderer.paint(self.slot, pass);
        }
    }
}

impl Renderer {
    fn new(device: &wgpu::Device, format: wgpu::TextureFormat, samples: u32) -> Self {
        let linear = format!("const LINEAR_TARGET = {};\n", format.is_srgb());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("plushie"),
            source: wgpu::ShaderSource::Wgsl(
                (plush::constants() + &linear + include_str!("../../../shaders/plushie.wgsl")).into(),
            ),
        });
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("plushie view"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let skin = Skin::new(device);
        let plain = &[Some(&layout)][..];
        let pipeline = |[corners, name]: [&str; 2],
                        bind_group_layouts,
                        buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
                        blend: Option<wgpu::BlendState>| {
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(name),
                bind_group_layouts,
                immediate_size: 0,
            });
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(name),
                layout: Some(&pipeline_layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(&format!("{corners}_vertex")),
                    buffers,
                    compilation_options: Default::default(),
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState { count: samples.max(1), ..Default::default() },
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(&format!("{name}_fragment")),
                    targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
                    compilation_options: Default::default(),
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let over = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let skinned = &[Some(&layout), Some(&skin.layout)][..];
        Self {
            fill: pipeline(["fill"; 2], plain, &[Some(CORNER)], over),
            picture: pipeline(["picture"; 2], skinned, &[Some(TEXTURED)], over),
            // Opaque, and most of what is drawn.
            felt: pipeline(["felt"; 2], plain, &[Some(WOOLLY), Some(CUT)], None),
            felt_picture: pipeline(["felt", "felt_picture"], skinned, &[Some(WOOLLY), Some(CUT)], None),
            capsule: pipeline(["capsule"; 2], plain, &[Some(CAPSULE)], over),
            layout,
            skin,
            views: HashMap::new(),
        }
    }

    fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, call: &ViewCallback, pixels_per_point: f32) {
        let layout = &self.layout;
        let view = self.views.entry(call.slot).or_insert_with(|| View::new(device, layout));
        let half_size = call.size.max(eframe::egui::Vec2::splat(1.0)) / 2.0;
        let uniform = Uniform {
            center: [call.camera.center[0] as f32, call.camera.center[1] as f32],
            scale: [call.camera.scale / half_size.x, call.camera.scale / half_size.y],
            half_size: [half_size.x * pixels_per_point, half_size.y * pixels_per_point],
            pixels_per_point,
            padding: 0.0,
        };
        queue.write_buffer(&view.uniform, 0, bytemuck::bytes_of(&uniform));
        view.parts.resize_with(call.parts.len(), Part::default);
        for (part, geometry) in view.parts.iter_mut().zip(&call.parts) {
            part.take(device, queue, geometry);
            if let Some(texture) = &geometry.texture {
                self.skin.follow(device, queue, texture);
            }
        }
    }

    fn paint(&self, slot: u64, pass: &mut wgpu::RenderPass<'static>) {
        let Some(view) = self.views.get(&slot) else { return };
        pass.set_bind_group(0, &view.bind_group, &[]);
        for part in &view.parts {
            for batch in &part.geometry.batches {
                self.paint_batch(part, batch, pass);
            }
        }
    }

    fn paint_batch(&self, part: &Part, batch: &Batch, pass: &mut wgpu::RenderPass<'static>) {
        let (pipeline, buffer, skinned) = match batch {
            Batch::Fill(_) => (&self.fill, &part.corners, false),
            Batch::Picture(_) => (&self.picture, &part.textured, true),
            Batch::Felt(false) => (&self.felt, &part.felt, false),
            Batch::Felt(true) => (&self.felt_picture, &part.felt, true),
            Batch::Capsules(_) => (&self.capsule, &part.capsules, false),
        };
        let Some(buffer) = buffer else { return };
        if skinned {
            let Some(skin) = self.skin.bind_group() else { return };
            pass.set_bind_group(1, skin, &[]);
        }
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, buffer.slice(..));
        match batch {
            Batch::Fill(range) | Batch::Picture(range) => pass.draw(range.clone(), 0..1),
            Batch::Capsules(range) => {
                pass.draw(CAPSULE_CORNERS * range.start..CAPSULE_CORNERS * range.end, 0..1);
            }
            Batch::Felt(_) => {
                let (Some(cloth), Some(cut), Some(corners)) = (&part.geometry.cloth, &part.cut, &part.felt_corners)
                else {
                    return;
                };
                pass.set_vertex_buffer(1, cut.slice(..));
                pass.set_index_buffer(corners.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..cloth.corners.len() as u32, 0, 0..1);
            }
        }
    }
}

impl Part {
    /// Takes a geometry in the place of the one before, unless it is the same; cloth that is the same is there already.
    fn take(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, geometry: &Arc<Geometry>) {
        if Arc::ptr_eq(&self.geometry, geometry) {
            return;
        }
        let upload = |buffer: &mut Option<wgpu::Buffer>, bytes: &[u8]| {
            if !bytes.is_empty() {
                upload(device, queue, buffer, bytes);
            }
        };
        upload(&mut self.corners, bytemuck::cast_slice(&geometry.corners));
        upload(&mut self.textured, bytemuck::cast_slice(&geometry.textured));
        upload(&mut self.felt, bytemuck::cast_slice(&geometry.felt));
        upload_capsules(device, queue, &mut self.capsules, &geometry.capsules);
        let known = |cloth: &Arc<Cloth>| self.geometry.cloth.as_ref().is_some_and(|known| Arc::ptr_eq(known, cloth));
        if let Some(cloth) = geometry.cloth.as_ref().filter(|cloth| !known(cloth)) {
            upload(&mut self.cut, bytemuck::cast_slice(&cloth.points));
            upload(&mut self.felt_corners, bytemuck::cast_slice(&cloth.corners));
        }
        self.geometry = geometry.clone();
    }
}

impl View {
    fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> Self {
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("plushie view"),
            size: size_of::<Uniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("plushie view"),
            layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        Self { uniform, bind_group, parts: Vec::new() }
    }
}

/// Writes `bytes`, into a larger buffer if need be.
fn upload(device: &wgpu::Device, queue: &wgpu::Queue, buffer: &mut Option<wgpu::Buffer>, bytes: &[u8]) {
    queue.write_buffer(reserve(device, buffer, bytes.len()), 0, bytes);
}

/// Writes the corners of each capsule, all with the whole of it, into a larger buffer if need be.
fn upload_capsules(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    buffer: &mut Option<wgpu::Buffer>,
    capsules: &[Capsule],
) {
    /// Copied to the adapter's memory together, from the processor's nearest.
    const TOGETHER: usize = 64;
    type Corners = [Capsule; CAPSULE_CORNERS as usize];
    const BYTES: usize = size_of::<Corners>();
    let Some(bytes) = wgpu::BufferSize::new((BYTES * capsules.len()) as u64) else { return };
    let buffer = reserve(device, buffer, BYTES * capsules.len());
    let Some(mut view) = queue.write_buffer_with(buffer, 0, bytes) else { return };
    let mut corners = [Corners::zeroed(); TOGETHER];
    for (k, capsules) in capsules.chunks(TOGETHER).enumerate() {
        let corners = &mut corners[..capsules.len()];
        corners.iter_mut().zip(capsules).for_each(|(corners, capsule)| *corners = [*capsule; CAPSULE_CORNERS as usize]);
        let at = BYTES * TOGETHER * k;
        view.slice(at..at + BYTES * capsules.len()).copy_from_slice(bytemuck::cast_slice(corners));
    }
}

/// The buffer, or a larger one in its place, for at least so many bytes.
fn reserve<'b>(device: &wgpu::Device, buffer: &'b mut Option<wgpu::Buffer>, bytes: usize) -> &'b wgpu::Buffer {
    let large_enough = buffer.take().filter(|buffer| buffer.size() >= bytes as u64);
    buffer.insert(large_enough.unwrap_or_else(|| vertex_buffer(device, bytes as u64)))
}

fn vertex_buffer(device: &wgpu::Device, at_least: u64) -> wgpu::Buffer {
    /// Bytes; small parts never need a second buffer.
    const SMALLEST: u64 = 1 << 12;
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("plushie vertices"),
        size: at_least.max(SMALLEST).next_power_of_two(),
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

#[cfg(test)]
mod tests;
