//! Where does all of it appear? A window, its software surface, and egui's input and layer.

use std::num::NonZeroU32;
use std::rc::Rc;
use std::time::{Duration, Instant};

use catoptra_tracer::Pool;
use egui::{Context, FullOutput, ViewportId};
use softbuffer::{Rect, Surface};
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event_loop::{ActiveEventLoop, OwnedDisplayHandle};
use winit::window::{Window, WindowAttributes};

use crate::canvas::{self, Canvas, Region};
use crate::egui_paint::EguiLayer;
use crate::icon;
use crate::panel;

/// A wish of egui to be shown again later than this is no wish.
const NEVER: Duration = Duration::from_secs(3600);

/// By what a desktop knows whose window it is: `StartupWMClass` of `catoptra.desktop`.
pub(crate) const CLASS: &str = "catoptra";

#[cfg(target_os = "linux")]
fn named(attributes: WindowAttributes) -> WindowAttributes {
    use winit::platform::x11::WindowAttributesExtX11 as _;
    attributes.with_name(CLASS, CLASS)
}

/// Elsewhere a window is known by its program.
#[cfg(not(target_os = "linux"))]
fn named(attributes: WindowAttributes) -> WindowAttributes {
    attributes
}

/// A surface that has the size of the window.
pub(crate) struct Fitted {
    /// Its size in pixels; neither is zero.
    pub(crate) size: (u32, u32),
    /// Whether it was another before.
    pub(crate) new: bool,
}

/// The window and what is drawn in it.
pub(crate) struct Screen {
    pub(crate) window: Rc<Window>,
    context: softbuffer::Context<OwnedDisplayHandle>,
    surface: Surface<OwnedDisplayHandle, Rc<Window>>,
    /// Pixels that the surface has memory for: it keeps that of its largest size.
    room: usize,
    pub(crate) egui: Context,
    pub(crate) input: egui_winit::State,
    layer: EguiLayer,
    pub(crate) canvas: Canvas,
    /// The size of the surface, in pixels.
    size: (u32, u32),
    /// When egui wants to be shown again.
    pub(crate) due: Option<Instant>,
}

impl Screen {
    /// Opens a window with a content of that size in logical pixels: as many pixels each as the display's scale says.
    ///
    /// # Errors
    /// Why there is none, for people.
    pub(crate) fn open(event_loop: &ActiveEventLoop, (width, height): (u32, u32)) -> Result<Self, String> {
        let attributes = named(Window::default_attributes())
            .with_title("catoptra")
            .with_window_icon(icon::icon())
            // Screen readers must know of it first.
            .with_visible(!cfg!(feature = "screen-reader"))
            .with_inner_size(LogicalSize::new(width, height))
            .with_min_inner_size(PhysicalSize::new(1, 1));
        let window = Rc::new(event_loop.create_window(attributes).map_err(|e| e.to_string())?);
        let context =
            softbuffer::Context::new(event_loop.owned_display_handle()).map_err(|e| e.to_string())?;
        let surface = Surface::new(&context, Rc::clone(&window)).map_err(|e| e.to_string())?;
        let egui = Context::default();
        panel::set_theme(&egui);
        let scale = window.scale_factor() as f32;
        let input = egui_winit::State::new(egui.clone(), ViewportId::ROOT, &window, Some(scale), None, None);
        Ok(Self {
            window,
            context,
            surface,
            room: 0,
            egui,
            input,
            layer: EguiLayer::new(),
            canvas: Canvas::default(),
            size: (0, 0),
            due: None,
        })
    }

    /// Pixels in a point of egui.
    pub(crate) fn pixels_per_point(&self) -> f32 {
        egui_winit::pixels_per_point(&self.egui, &self.window)
    }

    /// Fits the surface to the window; `None` while the window has no pixels.
    ///
    /// # Errors
    /// When the surface refuses the size.
    pub(crate) fn fit(&mut self) -> Result<Option<Fitted>, String> {
        let PhysicalSize { width, height } = self.window.inner_size();
        let (Some(w), Some(h)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else {
            self.size = (0, 0);
            return Ok(None);
        };
        let new = self.size != (width, height);
        if new {
            let pixels = width as usize * height as usize;
            if self.room > canvas::WASTE * pixels {
                self.surface =
                    Surface::new(&self.context, Rc::clone(&self.window)).map_err(|e| e.to_string())?;
                self.room = 0;
            }
            self.room = self.room.max(pixels);
            self.surface.resize(w, h).map_err(|e| e.to_string())?;
            self.size = (width, height);
        }
        Ok(Some(Fitted { size: self.size, new }))
    }

    /// Takes in what egui wants to show. Returns the region that differs from the last time.
    pub(crate) fn take(&mut self, output: FullOutput) -> Region {
        self.input.handle_platform_output(&self.window, output.platform_output);
        let delay = output.viewport_output.get(&ViewportId::ROOT).map_or(NEVER, |v| v.repaint_delay);
        self.due = if delay < NEVER { Some(Instant::now() + delay) } else { None };
        let primitives = self.egui.tessellate(output.shapes, output.pixels_per_point);
        self.layer.paint(self.size, primitives, &output.textures_delta, output.pixels_per_point)
    }

    /// Shows the picture and egui over it; only `changed` is sent to the display.
    ///
    /// # Errors
    /// When the surface cannot be drawn on.
    pub(crate) fn present(&mut self, changed: Region, pool: &Pool) -> Result<(), String> {
        let (width, height) = changed.size();
        let (Some(width), Some(height)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else {
            return Ok(());
        };
        let mut buffer = self.surface.buffer_mut().map_err(|e| e.to_string())?;
        self.canvas.copy_to(&mut buffer, self.size.0, pool);
        self.layer.blend_over(&mut buffer, self.size);
        self.window.pre_present_notify();
        let rect = Rect { x: changed.left, y: changed.top, width, height };
        buffer.present_with_damage(&[rect]).map_err(|e| e.to_string())
    }
}
