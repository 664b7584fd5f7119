//! The texture on the graphics card.

use crate::picture::{Level, Texture};
use egui_wgpu::wgpu;
use std::sync::Arc;

/// One texture at a time: both views show the same plushie.
pub struct Skin {
    pub layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    loaded: Option<(Arc<Texture>, wgpu::BindGroup)>,
}

impl Skin {
    pub fn new(device: &wgpu::Device) -> Self {
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let picture = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("plushie texture"),
            entries: &[entry(0, picture), entry(1, sampler)],
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("plushie texture"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self { layout, sampler, loaded: None }
    }

    pub fn bind_group(&self) -> Option<&wgpu::BindGroup> {
        self.loaded.as_ref().map(|(_, group)| group)
    }

    /// Uploads the texture, unless it is there.
    pub fn follow(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, texture: &Arc<Texture>) {
        if self.loaded.as_ref().is_some_and(|(loaded, _)| Arc::ptr_eq(loaded, texture)) {
            return;
        }
        let most = device.limits().max_texture_dimension_2d;
        // A card that takes less gets the picture at half its size, or less again.
        let fits = |level: &Level| level.width.max(level.height) <= most;
        let levels = &texture.levels()[texture.levels().iter().position(fits).unwrap_or(0)..];
        let size =
            |level: &Level| wgpu::Extent3d { width: level.width, height: level.height, depth_or_array_layers: 1 };
        let picture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("plushie texture"),
            size: size(&levels[0]),
            mip_level_count: levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            // As the colours are; the shader knows what light the target wants.
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (k, level) in levels.iter().enumerate() {
            queue.write_texture(
                wgpu::TexelCopyTextureInfo { mip_level: k as u32, ..picture.as_image_copy() },
                &level.pixels,
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * level.width), rows_per_image: None },
                size(level),
            );
        }
        let view = picture.create_view(&Default::default());
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("plushie texture"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        });
        self.loaded = Some((texture.clone(), group));
    }
}
