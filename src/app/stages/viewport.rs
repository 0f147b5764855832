//! The 3D view: the one file that joins egui and the renderer.

mod notes;
pub mod subject;

use std::sync::Arc;

use crate::app::command::Command;
use crate::app::lesson::captions::Caption;
use crate::app::panels::save;
use crate::app::saving::Subject as Saved;
use egui::{Align2, CursorIcon, EventFilter, Key, PointerButton, Rect, Response, Role, Sense, Ui, WidgetInfo, vec2};

use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::icon::{self, Icon, Look};
use crate::render::{Frame, Lost, Pixels, Renderer, Snapshot, ViewId};
use crate::scene::palette::{Palette, Shade};
use crate::scene::{Camera, Scene, Studio};
use subject::Subject;

/// What an arrow key turns or moves, as a drag of so many points; how far a key zooms, as a logarithm.
const TURN: f32 = 20.0;
const ZOOM: f32 = 0.15;
/// What the keys do in the view.
const KEYS: &str = "Arrows turn it, with Shift they move it, plus and minus zoom, Home shows it as at first";

/// Room that the state chip takes at the top left: place and size, points.
const CHIP: (egui::Vec2, egui::Vec2) = (vec2(12.0, 12.0), vec2(212.0, 30.0));

/// What the view remembers.
#[derive(Default)]
pub struct ViewState {
    gpu: Option<egui_wgpu::RenderState>,
    /// Of each kind of subject, where it was moved.
    cameras: [Option<Camera>; 2],
    /// How it was last shown: from where, and how large in points.
    seen: Option<(Camera, egui::Vec2)>,
    /// A picture on its way to a file of this name.
    saved: Option<(String, Snapshot)>,
    shown: Option<Shown>,
    version: u64,
    scene: Arc<Scene>,
    still: bool,
    /// What is said of it, see [`Captions`](crate::app::lesson::captions::Captions).
    pub captions: Vec<Caption>,
    focused: bool,
}

/// All that the scene depends on.
#[derive(Debug, PartialEq)]
struct Shown {
    kind: usize,
    version: u64,
    time: f64,
    shade: Shade,
    settings: Vec<u64>,
}

impl ViewState {
    /// A view that draws with this render state; `still` leaves out what moves for effect.
    #[must_use]
    pub fn new(render_state: Option<&egui_wgpu::RenderState>, still: bool) -> Self {
        if let Some(state) = render_state {
            let renderer = Renderer::new(&state.device, state.target_format);
            state.renderer.write().callback_resources.insert(renderer);
        }
        Self { gpu: render_state.cloned(), still, ..Self::default() }
    }

    /// Draws what is shown once more for a file of this name, two pixels to a point, without background and floor where it is to
    /// be `clear`. False where there is nothing to draw with.
    pub fn save(&mut self, name: String, clear: bool) -> bool {
        let (Some(gpu), Some((camera, size)), Some(shown)) = (&self.gpu, &self.seen, &self.shown) else { return false };
        let mut studio = Palette::of(shown.shade).studio;
        let mut scene = Arc::clone(&self.scene);
        if clear {
            (studio.inner, studio.outer) = (studio.inner.alpha(0.0), studio.outer.alpha(0.0));
            Arc::make_mut(&mut scene).ground = None;
        }
        let frame = Frame {
            view: SAVED,
            size_px: [size.x, size.y].map(|side| (side * PIXELS).round().max(0.0) as u32),
            pixels_per_point: PIXELS,
            scene: &scene,
            scene_version: 0,
            camera,
            studio: &studio,
        };
        let mut renderer = gpu.renderer.write();
        let renderer = renderer.callback_resources.get_mut::<Renderer>();
        let snapshot = renderer.and_then(|renderer| renderer.snapshot(&gpu.device, &gpu.queue, &frame));
        self.saved = snapshot.map(|snapshot| (name, snapshot));
        self.saved.is_some()
    }

    /// Whether it has the keyboard.
    #[must_use]
    pub fn has_focus(&self) -> bool {
        self.focused
    }

    /// The picture asked for, once it is there, and the name of its file.
    pub fn saved(&mut self, ctx: &egui::Context) -> Option<(String, Result<Pixels, Lost>)> {
        let (gpu, (_, snapshot)) = (self.gpu.as_ref()?, self.saved.as_ref()?);
        let pixels = snapshot.take(&gpu.device);
        if pixels.is_none() {
            ctx.request_repaint();
        }
        Some((self.saved.take_if(|_| pixels.is_some())?.0, pixels?))
    }

    /// Builds the scene again when what it depends on has changed.
    fn update(&mut self, subject: &Subject<'_>, shown: Shown) {
        if self.shown.as_ref() == Some(&shown) {
            return;
        }
        let palette = Palette::of(shown.shade);
        let mut scene = subject.scene(shown.time, palette, self.still);
        scene.thicken(palette.weight);
        self.scene = Arc::new(scene);
        self.version += 1;
        self.shown = Some(shown);
    }
}

/// Shows the 3D view at a time (s) in all of `ui`: drag to orbit, with the right button or Shift to move, scroll or pinch to zoom.
/// `version` is another for every other run.
pub fn viewport(
    ui: &mut Ui,
    subject: &Subject<'_>,
    (version, cursor): (u64, f64),
    state: &mut ViewState,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let rect = ui.max_rect();
    if state.gpu.is_none() {
        let text = "The 3D view needs WebGPU or WebGL2.";
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, fonts::regular(13.0), theme.dim);
        return;
    }
    let response = ui.interact(rect, ui.scope_id().with("3d"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "3D view"));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(KEYS));
    finger::claim(ui, rect);
    state.focused = response.has_focus();
    let home = subject.home();
    let mut camera = state.cameras[subject.kind()].take().unwrap_or(home);
    steer(ui, &response, rect, &mut camera);
    let home_asked = steer_by_keys(ui, &response, &mut camera);
    let (kind, settings) = (subject.kind(), subject.settings());
    state.update(subject, Shown { kind, version, time: cursor, shade: theme.shade, settings });

    let size = rect.size() * ui.pixels_per_point();
    let studio = Palette::of(theme.shade).studio;
    let size_px = [size.x.round().max(0.0) as u32, size.y.round().max(0.0) as u32];
    let picture = Picture { scene: state.scene.clone(), version: state.version, camera, studio, size_px };
    ui.painter().add(egui_wgpu::Callback::new_paint_callback(rect, picture));
    let apart = vec2(-finger::at_least(ui, 36.0), 0.0);
    let button = Rect::from_center_size(rect.right_top() + vec2(-24.0, 24.0), vec2(32.0, 32.0));
    let file = button.translate(apart);
    let chip = Rect::from_min_size(rect.min + CHIP.0, CHIP.1);
    let mut taken = vec![button, file, chip];
    if let Some(frozen) = subject.compared() {
        let compare = file.translate(apart);
        taken.push(compare);
        let look = if frozen { Look::Lit } else { Look::Plain };
        if icon::button(ui, compare, Icon::Compare, "Compare with a clamp", look).clicked() {
            out.push(Command::ToggleFrozen);
        }
    }
    notes::notes(ui, rect, &camera, subject, (&state.scene, &state.captions), taken);
    state.seen = Some((camera, rect.size()));
    save::menu(ui, file, Saved::View, out);
    let reset = icon::button(ui, button, Icon::Reset, "Reset view", Look::Plain).clicked()
        || response.double_clicked()
        || home_asked;
    // A camera is kept only when it was moved: until then it follows the robot's size.
    state.cameras[kind] = (!reset && camera != home).then_some(camera);
}

/// Moves the camera as the pointer and the fingers say.
fn steer(ui: &Ui, response: &Response, rect: Rect, camera: &mut Camera) {
    let size = glam(rect.size());
    let (shift, zoom, scroll, touch) =
        ui.input(|input| (input.modifiers.shift, input.zoom_delta(), input.smooth_scroll_delta(), input.multi_touch()));
    let drag = glam(response.drag_delta());
    if let Some(touch) = touch.filter(|touch| rect.contains(touch.center_pos)) {
        camera.pan(glam(touch.translation_delta), size);
        camera.zoom_at(touch.zoom_delta, glam(touch.center_pos - rect.min), size);
    } else if response.dragged_by(PointerButton::Primary) && !shift {
        camera.orbit(drag);
    } else if response.dragged() {
        camera.pan(drag, size);
    } else if let Some(at) = response.hover_pos() {
        // egui takes Ctrl and scroll, and a pinch on a touchpad, as zoom already.
        let factor = zoom * (scroll.y / 240.0).exp();
        if factor != 1.0 {
            camera.zoom_at(factor, glam(at - rect.min), size);
        }
    }
    if response.dragged() {
        ui.set_cursor_icon(CursorIcon::Grabbing);
    } else if response.hovered() {
        ui.set_cursor_icon(CursorIcon::Grab);
    }
}

/// Moves the camera as the keys say while the view has the focus; returns whether they ask for the view as it was at first.
fn steer_by_keys(ui: &Ui, response: &Response, camera: &mut Camera) -> bool {
    if !response.has_focus() {
        return false;
    }
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let size = glam(response.rect.size());
    ui.input(|input| {
        let presses = |key| input.num_presses(key) as f32;
        let along = |more, less| TURN * (presses(more) - presses(less));
        let way = glam::vec2(along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowDown, Key::ArrowUp));
        if way != glam::Vec2::ZERO {
            if input.modifiers.shift { camera.pan(way, size) } else { camera.orbit(way) }
        }
        let nearer = presses(Key::Plus) + presses(Key::Equals) + presses(Key::PageUp);
        let zoom = nearer - presses(Key::Minus) - presses(Key::PageDown);
        if zoom != 0.0 {
            camera.zoom_at((ZOOM * zoom).exp(), 0.5 * size, size);
        }
        input.key_pressed(Key::Home) || input.key_pressed(Key::Num0)
    })
}

fn glam(v: egui::Vec2) -> glam::Vec2 {
    glam::Vec2::new(v.x, v.y)
}

/// One picture on its way to the GPU.
struct Picture {
    scene: Arc<Scene>,
    version: u64,
    camera: Camera,
    studio: Studio,
    size_px: [u32; 2],
}

/// The page has one 3D view, and one picture of it on its way to a file.
const VIEW: ViewId = ViewId(0);
const SAVED: ViewId = ViewId(1);
/// Pixels to a point in a file.
const PIXELS: f32 = crate::show::paper::PIXELS as f32;

impl egui_wgpu::CallbackTrait for Picture {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        screen: &egui_wgpu::ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut egui_wgpu::CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(renderer) = resources.get_mut::<Renderer>() {
            let frame = Frame {
                view: VIEW,
                size_px: self.size_px,
                pixels_per_point: screen.pixels_per_point,
                scene: &self.scene,
                scene_version: self.version,
                camera: &self.camera,
                studio: &self.studio,
            };
            renderer.prepare(device, queue, encoder, &frame);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &egui_wgpu::CallbackResources,
    ) {
        if let Some(renderer) = resources.get::<Renderer>() {
            renderer.paint(pass, VIEW);
        }
    }
}
