//! Draws plushies with wgpu inside egui's pass. Knows nothing of panels, tools or designs.

use super::geometry::{Batch, Capsule, Corner, Geometry, Textured, Woolly};
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
    pub geometry: Arc<Geometry>,
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
    linear_target: f32,
    views: HashMap<u64, View>,
}

struct View {
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    corners: wgpu::Buffer,
    textured: wgpu::Buffer,
    felt: wgpu::Buffer,
    capsules: wgpu::Buffer,
    /// What the buffers hold.
    geometry: Arc<Geometry>,
}

/// `View` of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Uniform {
    center: [f32; 2],
    scale: [f32; 2],
    half_size: [f32; 2],
    pixels_per_point: f32,
    linear_target: f32,
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
    attributes: &wgpu::vertex_attr_array![
        0 => Float32x2, 1 => Float32x2, 2 => Float32x2, 3 => Float32x2, 4 => Float32, 5 => Unorm8x4
    ],
};
const CAPSULE: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Capsule>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
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
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("plushie"),
            source: wgpu::ShaderSource::Wgsl(
                (plush::constants() + include_str!("../../../shaders/plushie.wgsl")).into(),
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
        let pipeline =
            |[corners, name]: [&str; 2], bind_group_layouts, buffer: wgpu::VertexBufferLayout<'_>, topology| {
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
                        buffers: &[Some(buffer)],
                        compilation_options: Default::default(),
                    },
                    primitive: wgpu::PrimitiveState { topology, ..Default::default() },
                    depth_stencil: None,
                    multisample: wgpu::MultisampleState { count: samples.max(1), ..Default::default() },
                    fragment: Some(wgpu::FragmentState {
                        module: &module,
                        entry_point: Some(&format!("{name}_fragment")),
                        targets: &[Some(wgpu::ColorTargetState {
                            format,
                            blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                            write_mask: wgpu::ColorWrites::ALL,
                        })],
                        compilation_options: Default::default(),
                    }),
                    multiview_mask: None,
                    cache: None,
                })
            };
        let (list, strip) = (wgpu::PrimitiveTopology::TriangleList, wgpu::PrimitiveTopology::TriangleStrip);
        Self {
            fill: pipeline(["fill"; 2], plain, CORNER, list),
            picture: pipeline(["picture"; 2], &[Some(&layout), Some(&skin.layout)], TEXTURED, list),
            felt: pipeline(["felt"; 2], plain, WOOLLY, list),
            felt_picture: pipeline(["felt", "felt_picture"], &[Some(&layout), Some(&skin.layout)], WOOLLY, list),
            capsule: pipeline(["capsule"; 2], plain, CAPSULE, strip),
            layout,
            skin,
            linear_target: if format.is_srgb() { 1.0 } else { 0.0 },
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
            linear_target: self.linear_target,
        };
        queue.write_buffer(&view.uniform, 0, bytemuck::bytes_of(&uniform));
        if !Arc::ptr_eq(&view.geometry, &call.geometry) {
            upload(device, queue, &mut view.corners, bytemuck::cast_slice(&call.geometry.corners));
            upload(device, queue, &mut view.textured, bytemuck::cast_slice(&call.geometry.textured));
            upload(device, queue, &mut view.felt, bytemuck::cast_slice(&call.geometry.felt));
            upload(device, queue, &mut view.capsules, bytemuck::cast_slice(&call.geometry.capsules));
            view.geometry = call.geometry.clone();
        }
        if let Some(texture) = &call.geometry.texture {
            self.skin.follow(device, queue, texture);
        }
    }

    fn paint(&self, slot: u64, pass: &mut wgpu::RenderPass<'static>) {
        let Some(view) = self.views.get(&slot) else { return };
        pass.set_bind_group(0, &view.bind_group, &[]);
        for batch in &view.geometry.batches {
            match batch {
                Batch::Fill(range) => {
                    pass.set_pipeline(&self.fill);
                    pass.set_vertex_buffer(0, view.corners.slice(..));
                    pass.draw(range.clone(), 0..1);
                }
                Batch::Picture(range) => {
                    let Some(skin) = self.skin.bind_group() else { continue };
                    pass.set_pipeline(&self.picture);
                    pass.set_bind_group(1, skin, &[]);
                    pass.set_vertex_buffer(0, view.textured.slice(..));
                    pass.draw(range.clone(), 0..1);
                }
                Batch::Felt(range, false) => {
                    pass.set_pipeline(&self.felt);
                    pass.set_vertex_buffer(0, view.felt.slice(..));
                    pass.draw(range.clone(), 0..1);
                }
                Batch::Felt(range, true) => {
                    let Some(skin) = self.skin.bind_group() else { continue };
                    pass.set_pipeline(&self.felt_picture);
                    pass.set_bind_group(1, skin, &[]);
                    pass.set_vertex_buffer(0, view.felt.slice(..));
                    pass.draw(range.clone(), 0..1);
                }
                Batch::Capsules(range) => {
                    pass.set_pipeline(&self.capsule);
                    pass.set_vertex_buffer(0, view.capsules.slice(..));
                    pass.draw(0..4, range.clone());
                }
            }
        }
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
        Self {
            uniform,
            bind_group,
            corners: vertex_buffer(device, 0),
            textured: vertex_buffer(device, 0),
            felt: vertex_buffer(device, 0),
            capsules: vertex_buffer(device, 0),
            geometry: Arc::default(),
        }
    }
}

/// Writes `bytes`, into a larger buffer if need be.
fn upload(device: &wgpu::Device, queue: &wgpu::Queue, buffer: &mut wgpu::Buffer, bytes: &[u8]) {
    if buffer.size() < bytes.len() as u64 {
        *buffer = vertex_buffer(device, bytes.len() as u64);
    }
    queue.write_buffer(buffer, 0, bytes);
}

fn vertex_buffer(device: &wgpu::Device, at_least: u64) -> wgpu::Buffer {
    /// Bytes; small scenes never need a second buffer.
    const SMALLEST: u64 = 1 << 16;
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("plushie vertices"),
        size: at_least.max(SMALLEST).next_power_of_two(),
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

#[cfg(test)]
mod tests;
