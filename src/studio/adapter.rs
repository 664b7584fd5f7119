//! The graphics adapter of the window, and what becomes of it: a driver that is updated, a card that is pulled out, one that hangs.
//!
//! Nothing can be drawn on a device that is lost, and the window cannot have another one. So the work is kept, and the window ends with a
//! sentence; what was kept is offered at the next start.

use egui_wgpu::RenderState;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Raised when the adapter is lost.
#[derive(Clone, Debug, Default)]
pub struct Lost(Arc<AtomicBool>);

impl Lost {
    /// Watches the device of a window. `wake` is called when it is lost.
    pub fn watch(&self, state: &RenderState, wake: impl Fn() + Send + Sync + 'static) {
        let wake = Arc::new(wake);
        let (lost, woken) = (self.clone(), wake.clone());
        state.device.set_device_lost_callback(move |reason, words| {
            // Given back at the end, as always.
            if matches!(reason, egui_wgpu::wgpu::DeviceLostReason::Destroyed) {
                return;
            }
            log::error!("the graphics adapter was lost: {words}");
            lost.raise();
            woken();
        });
        // Otherwise a fault of the adapter ends the program at once, with what is not saved.
        let lost = self.clone();
        state.device.on_uncaptured_error(Arc::new(move |error| {
            log::error!("the graphics adapter: {error}");
            if matches!(error, egui_wgpu::wgpu::Error::OutOfMemory { .. }) {
                lost.raise();
                wake();
            }
        }));
    }

    pub fn raise(&self) {
        self.0.store(true, Ordering::SeqCst);
    }

    pub fn is(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
