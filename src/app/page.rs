//! The page: everything in its place.

use super::{App, SEEN};
use crate::app::chain;
use crate::app::charts::{plane, plots};
use crate::app::command::Command;
use crate::app::controls::{self, Inputs};
use crate::app::layout::{self, Layout};
use crate::app::lesson::{self, At};
use crate::app::memo::Refusal;
use crate::app::panels::transport::Track;
use crate::app::stages::stage::Stage;
use crate::app::stages::viewport::{self, subject::Subject};
use crate::app::state::Tab;
use crate::app::widgets::{self, finger};
use crate::app::words::refusal;
use crate::app::words::story::Phase;
use crate::app::{embed, panels, stages, theme, words};
use centrode_core::detect::Method;
use egui::{Rect, Ui, vec2};

impl App {
    pub(super) fn page(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        let theme = theme::Theme::of(ui);
        let page = ui.ctx().content_rect();
        let mut whole = ui.new_child(egui::UiBuilder::new().id_salt("page").max_rect(page));
        whole.set_clip_rect(page);
        let ui = &mut whole;
        ui.painter().rect_filled(page, 0.0, theme.surface);
        let sheet = panels::sheet::place(ui, &self.state, self.prefers_reduced_motion, out);
        // Segments in series are simulated, whatever log is shown of one.
        let banner = self.logs.banner(self.memo.recorded()).filter(|_| self.state.stage != Stage::Chain);
        let above = if banner.is_some() { panels::log::height(page.width()) } else { 0.0 };
        let (top, page) = page.split_top_bottom_at_y(page.top() + above);
        let layout = self.lay_out(ui, Layout::new(page, sheet, self.embed));
        // A stage takes the place of the tabs, and there is no sheet.
        let drawn = self.state.stage.is_run() || layout.controls.is_some();
        let handle = layout.handle.filter(|_| drawn);
        finger::welcome(ui, layout.sheet);
        let (cursor, covered) = (self.cursor(), self.is_covered());
        let otherwise = |method: Method| (method, self.state.otherwise_si(method.threshold_key(), &self.base));
        self.plots.otherwise = Method::ALL.iter().copied().map(otherwise).collect();
        self.plots.marks = self.state.marks;
        let Self {
            state,
            base,
            memo,
            chain,
            pictures,
            notes,
            chip,
            plots,
            view,
            studies,
            tuner,
            comparer,
            stages,
            source,
            sharing,
            embed,
            listener: _,
            logs,
            lesson,
            captions,
            gallery,
            cover,
            prefers_reduced_motion,
        } = self;
        let (state, run) = (&*state, memo.run());
        let shown = memo.placed().at(cursor).and_then(|shown| shown.estimate());
        let several = chain.memo.as_ref().filter(|_| state.stage == Stage::Chain);

        if let Some(banner) = &banner {
            panels::log::banner(ui, top, banner, out);
        }
        if let Some(rect) = layout.title {
            layout::part(ui, "title", |ui| panels::title::title(ui, rect, state, gallery, out));
        }
        if let Some(rect) = layout.views {
            layout::part(ui, "views", |ui| panels::views::views(ui, rect, state.stage, state.paper, out));
        }
        if embed.is_none() {
            layout::part(ui, "tools", |ui| {
                panels::title::tools(ui, layout.tools, state, layout.sheet, out);
                lesson::menu::menu(ui, (layout.tools, layout.sheet), (lesson, state.lesson.is_some()), out);
            });
        }
        panels::sheet::sheet(ui, handle.as_ref(), sheet);
        if let Some(rect) = layout.controls {
            let refusal = memo.refusal().map(|refused| match refused {
                Refusal::Scenario(refused) => refusal::told(refused),
                Refusal::Log(refused) => format!("The log does not fit what is set: {}", refused.without_flags()),
            });
            let log = memo.recorded();
            let inputs = Inputs { state, base, notes, refusal, log, touch: layout.sheet };
            layout::card(ui, "controls", rect, |ui| match several {
                Some(_) => {
                    chain::controls::controls(ui, &chain::controls::Inputs { state, chain, touch: layout.sheet }, out);
                }
                None => controls::controls(ui, &inputs, out),
            });
        }
        let plate = state.lesson == Some(At::Tour(0)) && layout.transport.is_none();
        if let Some(rect) = layout.lesson {
            let panel = layout.controls.is_some();
            let inputs = lesson::card::Inputs { state, base, notes, lesson, panel, touch: layout.sheet };
            layout::card(ui, "lesson", rect, |ui| match state.lesson {
                Some(At::Tour(_)) => lesson::card::card(ui, rect, &inputs, out),
                _ => lesson::challenge::card::card(ui, rect, &inputs, out),
            });
        }
        let robot = state.stage.is_run();
        let whole = layout.stage();
        if let Some(rect) = layout.view.filter(|_| plate) {
            layout::card(ui, "plate", rect, |ui| lesson::plate::view::plate(ui, rect, lesson.plate(), out));
        } else if robot {
            if let Some(rect) = layout.view {
                view.captions = if several.is_some() { Vec::new() } else { captions.at(run, cursor) };
                let (subject, version) = match several {
                    Some(several) => (several.subject(state.chain.segment, cursor), several.version()),
                    None => {
                        let (trace, frozen) = (memo.trace(), state.frozen);
                        (Subject::Single { run, trace, frozen, placed: shown }, memo.version())
                    }
                };
                layout::card(ui, "view", rect, |ui| {
                    viewport::viewport(ui, &subject, (version, cursor), view, out);
                });
                layout::round(ui, rect);
                chip.show(
                    ui,
                    rect.min + vec2(12.0, 12.0),
                    match several {
                        Some(several) => (chain::words::phase(several, cursor), None),
                        None => (Phase::at(run, cursor), memo.contact(cursor)),
                    },
                    *prefers_reduced_motion,
                );
            }
        } else if whole.is_positive() {
            let inputs = stages::Inputs {
                stage: state.stage,
                plan: memo.plan(),
                log: run.is_recorded(),
                base: (&state.preset, base),
                source: source.as_ref(),
                tuner,
                comparer,
                tuning: state.tuning,
            };
            layout::card(ui, "stage", whole, |ui| stages::stage(ui, whole, &inputs, studies, stages, out));
        }
        if let Some(rect) = layout.transport {
            layout::card(ui, "transport", rect, |ui| {
                let track = several.map_or_else(|| Track::of(run), chain::words::track);
                panels::transport::transport(ui, rect, (state, &track, cursor), out);
            });
        }
        if embed.is_some() {
            embed::tools(ui, layout.tools, layout.sheet.then_some(state.sheet), out);
        }
        let mut show = |ui: &mut Ui, tab: Tab, rect: Rect, out: &mut Vec<Command>| match tab {
            Tab::Result => layout::inside(ui, "readout", rect, |ui| {
                let told = match several {
                    Some(several) => chain::words::readout(several, cursor),
                    None => panels::readout::Told::of(run, memo.recorded(), (memo.placed(), cursor)),
                };
                panels::readout::readout(ui, &told);
            }),
            Tab::Plots => layout::inside(ui, "plots", rect.shrink(8.0), |ui| {
                // Where they do not fit above each other they are scrolled.
                let low = rect.width() < 796.0 && rect.height() < 430.0 && !plots.framed;
                let content = |ui: &mut Ui| match several {
                    Some(several) => {
                        chain::plots::plots(ui, (several, &state.chain), cursor, &mut pictures.plots, out);
                    }
                    None => plots::plots(ui, (run, memo.version()), cursor, plots, out),
                };
                if low { panels::sheet::scrolled(ui, content) } else { panels::sheet::still(ui, content) }
            }),
            Tab::Plane => layout::inside(ui, "plane", rect.shrink(8.0), |ui| match several {
                Some(several) => chain::backbone::backbone(ui, several, cursor, &mut pictures.backbone),
                None => plane::plane(ui, run, memo.trace(), (cursor, state.frozen, shown), out),
            }),
        };
        for (tab, rect) in [(Tab::Plane, layout.plane), (Tab::Result, layout.readout), (Tab::Plots, layout.plots)] {
            if let Some(rect) = rect.filter(|rect| robot || !whole.contains_rect(*rect)) {
                layout::card(ui, "card", rect, |_| ());
                show(ui, tab, rect, out);
            }
        }
        if let Some(rect) = layout.tabbed.filter(|rect| robot || !whole.contains_rect(*rect)) {
            layout::card(ui, "tabbed", rect, |_| ());
            let (strip, below) = layout::tab_strip(rect);
            panels::tabs::tabs(ui, strip, (state.tab, several.is_some()), out);
            if below.height() > SEEN {
                show(ui, state.tab, below, out);
            }
        }
        if let Some(handle) = &handle {
            panels::sheet::handle(ui, handle, state.stop, out);
        }
        let by_key = cover.update(ui, covered);
        if state.help && !state.keys {
            words::help::help(ui, (state.sound, by_key), out);
        }
        if state.keys {
            words::keys::keys(ui, by_key, out);
        }
        panels::share::said(ui, layout.tools, sharing.said(ui));
        if let Some(form) = &logs.form {
            panels::columns::columns(ui, form, out);
        }
        if let Some(notice) = &sharing.notice {
            panels::notice::notice(ui, notice, out);
        }
        layout::part(ui, "symbols", |ui| widgets::symbol::links(ui, out));
        widgets::focus::frame(ui);
    }
}
