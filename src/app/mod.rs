//! Placeholder of the interface: the shape that the page and its tests rely on.

/// What the host (browser or test) tells the app at start.
#[derive(Clone, Default)]
pub struct Host {
    /// The person asked for less motion.
    pub prefers_reduced_motion: bool,
}

/// The interface.
pub struct App {
    host: Host,
    disk: u32,
    time: f32,
}

impl App {
    /// `render_state` is None only when nothing can draw 3D.
    pub fn new(
        _ctx: &egui::Context,
        _render_state: Option<&egui_wgpu::RenderState>,
        host: Host,
    ) -> Self {
        Self {
            host,
            disk: 2,
            time: 0.0,
        }
    }

    /// The whole page.
    pub fn ui(&mut self, ui: &mut egui::Ui) {
        self.time = ui.input(|input| input.time) as f32 % 8.0;
        egui::CentralPanel::default().show(ui, |ui| {
            ui.heading("Centrode");
            ui.add(egui::Slider::new(&mut self.disk, 0..=3).text("Contact disk"));
            let (rect, _) =
                ui.allocate_exact_size(ui.available_size(), egui::Sense::click_and_drag());
            let angle = if self.host.prefers_reduced_motion {
                0.0
            } else {
                self.time
            };
            let tip = rect.center() + 0.4 * rect.height() * egui::Vec2::angled(angle);
            ui.painter().line_segment(
                [rect.center(), tip],
                egui::Stroke::new(8.0, egui::Color32::from_rgb(0, 114, 178)),
            );
        });
        ui.ctx().request_repaint();
    }

    /// State in words, as JSON.
    pub fn report(&self) -> String {
        let state = match (self.disk, self.time) {
            (0, _) => "free",
            (_, t) if t < 5.8 => "free",
            (_, t) if t < 6.279 => "in contact",
            _ => "detected",
        };
        serde_json::json!({
            "state": state,
            "time": self.time,
            "detection_time": (self.disk > 0).then_some(6.279),
            "summary": format!("The segment is {state}."),
        })
        .to_string()
    }
}
