//! Live plots over one time axis: what each detector judges, and the tangent angle.
//!
//! The core lays them out as it does every chart; what a person moves lies over that and is painted anew in each frame.
//! Thresholds are lines that can be dragged, typed and switched off; the playback position is scrubbed anywhere else.

mod axis;
mod between;
mod frame;
mod marks;
mod panels;
mod threshold;

pub use axis::{Axis, Steps};

use crate::app::charts::paint::{Picture, Place, page};
use crate::app::command::Command;
use crate::app::panels::save;
use crate::app::saving::Subject;
use crate::app::theme::Theme;
use centrode_core::chart::layout::Page;
use centrode_core::chart::{Chart, Series};
use centrode_core::detect::Method;
use centrode_core::run::Run;
use centrode_core::study::course;
use egui::{Painter, Rect, Ui, Vec2, pos2, vec2};
use frame::{Frame, GUTTER, RIGHT, SMALL};
use std::collections::BTreeMap;

/// From this width on the plots stand side by side.
const SIDE_BY_SIDE: f32 = 780.0;
/// In a frame, where scrolling is the host page's, from this width on before they would have to be scrolled.
const FRAMED_SIDE_BY_SIDE: f32 = 480.0;
/// Plots: one for each detector, and the tangent angle.
const COUNT: usize = Method::ALL.len() + 1;
/// Least heights of the plots when stacked, in points: of the first, of the others, and of the last.
const LEAST: [f32; 3] = [128.0, 112.0, 84.0];
/// Least height of the plots side by side.
const LEAST_ROW: f32 = 120.0;
/// Space between plots.
const GAP: f32 = 10.0;

/// What the plots remember between frames; nothing of it is an input of the experiment.
#[derive(Default)]
pub struct PlotState {
    /// Whether they stand in the frame of another page.
    pub(crate) framed: bool,
    /// Time under the pointer, s: shown in all plots.
    hover: Option<f64>,
    /// Thresholds as they are when switched on again, SI; the page remembers them, not the plots.
    pub otherwise: BTreeMap<Method, f64>,
    /// Tops of the detectors' plots, SI, held while a threshold is being moved.
    held: BTreeMap<Method, f64>,
    /// How high the detectors' plots reach, SI, and for which run and threshold.
    tops: BTreeMap<Method, ((u64, u64), f64)>,
    /// The plots as they were last laid out.
    pictures: [Option<Picture<Key>>; COUNT],
    /// Distance from the pointer to what it holds when a drag starts, points.
    grip: f32,
    /// The times A and B, s; the page remembers them, not the plots.
    pub marks: [Option<f64>; 2],
    /// In which plot A and B are being set with the pointer, and where that began, points.
    measured: Option<(usize, f32)>,
    /// What a touch that began on a plot turned out to be.
    touch: Touch,
}

impl PlotState {
    /// Of plots that stand in the frame of another page, or in a page of their own.
    #[must_use]
    pub fn new(framed: bool) -> Self {
        Self { framed, ..Self::default() }
    }
}

/// What a plot is made of: the run's version, its top, and whether its times have no numbers.
type Key = (u64, Option<u64>, bool);

/// A touch may scrub, or scroll the page.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Touch {
    #[default]
    Undecided,
    Scrubs,
    Scrolls,
}

/// Shows the plots in the space that is left. `version` is another for every other run; `cursor` is the playback position, s.
pub fn plots(ui: &mut Ui, (run, version): (&Run, u64), cursor: f64, state: &mut PlotState, out: &mut Vec<Command>) {
    let space = ui.available_size();
    let beside = space.x >= SIDE_BY_SIDE && !(space.y.is_finite() && space.y > 0.9 * space.x);
    let stacked = least().iter().sum::<f32>() + (COUNT - 1) as f32 * GAP;
    let beside = beside || state.framed && space.x >= FRAMED_SIDE_BY_SIDE && space.y < stacked;
    let least = if beside { LEAST_ROW } else { stacked };
    let size = vec2(space.x.max(200.0), if space.y.is_finite() { space.y.max(least) } else { 1.2 * least });
    if space.y < least {
        let area = egui::ScrollArea::vertical().id_salt("plots").auto_shrink(false);
        area.show(ui, |ui| in_place(ui, size, beside, (run, version), cursor, state, out));
    } else {
        in_place(ui, size, beside, (run, version), cursor, state, out);
    }
}

fn in_place(
    ui: &mut Ui,
    size: Vec2,
    beside: bool,
    (run, version): (&Run, u64),
    cursor: f64,
    state: &mut PlotState,
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let (_, area) = ui.allocate_space(size);
    if !ui.is_rect_visible(area) {
        return;
    }
    let hovered = state.hover.take();
    let cursor = cursor.clamp(0.0, course::end(run));
    let methods = Method::ALL.iter().copied().map(Some).chain([None]);
    for ((which, rect), method) in layout(area, beside).into_iter().enumerate().zip(methods) {
        let top = method.map(|method| top(state, (run, version), method));
        let bare = !beside && which + 1 < COUNT;
        let make = || {
            let mut panel = match (method, top) {
                (Some(method), Some(top)) => course::statistic(run, method, top),
                _ => course::angle(run),
            };
            panel.x.bare = bare;
            Chart { panels: vec![panel], ..Chart::default() }
        };
        let key = (version, top.map(f64::to_bits), bare);
        let mut kept = state.pictures[which].take();
        let picture = Picture::keep(&mut kept, ui.ctx(), &theme, (key, false), make);
        let sides = Some([GUTTER, RIGHT].map(f64::from));
        let page = Page { sides, pixel: f64::from(1.0 / ui.pixels_per_point()), ..page(SMALL) };
        let places = picture.show(ui.painter(), &theme, Frame::below_title(rect), page);
        if let Some(place) = places.into_iter().next() {
            let mut frame = Frame::new(
                rect,
                &place,
                method.map_or(180.0 / std::f64::consts::PI, |m| course::measure(m).scale),
                theme,
            );
            // In the corner of the card.
            if which == if beside { COUNT - 1 } else { 0 } {
                let corner = pos2(rect.right() - 0.5 * save::BUTTON, rect.top() + 9.0);
                let button = Rect::from_center_size(corner, Vec2::splat(save::BUTTON - 2.0));
                save::menu_with(ui, button, Subject::Plots, state.marks.iter().all(Option::is_some), out);
                frame.tool = save::BUTTON - RIGHT;
            }
            let (state, out) = (&mut *state, &mut *out);
            let marks = state.marks;
            let mut view = View { run, cursor, marks, hovered, frame, place, picture, which, top, state, out };
            match method {
                Some(method) => panels::judging(ui, &mut view, method),
                None => panels::angle(ui, &mut view),
            }
        }
        state.pictures[which] = kept;
    }
}

/// How high the plot of a detector reaches, SI: as it did while its threshold is being moved.
fn top(state: &mut PlotState, (run, version): (&Run, u64), method: Method) -> f64 {
    if let Some(&held) = state.held.get(&method) {
        return held;
    }
    let otherwise = state.otherwise.get(&method).copied().unwrap_or(0.0);
    let threshold = panels::threshold(method, run.plan.scenario(), otherwise);
    let key = (version, threshold.to_bits());
    match state.tops.get(&method) {
        Some((of, top)) if *of == key => *top,
        _ => {
            let top = course::top(run, method, threshold);
            state.tops.insert(method, (key, top));
            top
        }
    }
}

/// One plot being shown.
struct View<'a> {
    run: &'a Run,
    cursor: f64,
    /// The times A and B, s.
    marks: [Option<f64>; 2],
    /// Time under the pointer in the frame before, s.
    hovered: Option<f64>,
    frame: Frame,
    place: Place,
    picture: &'a Picture<Key>,
    /// Its place among the plots.
    which: usize,
    /// How high it reaches, SI, where it is a detector's.
    top: Option<f64>,
    state: &'a mut PlotState,
    out: &'a mut Vec<Command>,
}

impl View<'_> {
    /// The threshold of a detector when it is switched on again, SI.
    fn otherwise(&self, method: Method) -> f64 {
        self.state.otherwise.get(&method).copied().unwrap_or(0.0)
    }

    /// Keeps the plot of a detector as high as it is, or no longer.
    fn hold(&mut self, method: Method, moving: bool) {
        match self.top.filter(|_| moving) {
            Some(top) => drop(self.state.held.insert(method, top)),
            None => drop(self.state.held.remove(&method)),
        }
    }

    /// Whether the last curve, or what of it stands back, has any value.
    fn has_values(&self) -> bool {
        let panel = self.picture.chart().panels.first();
        let mut last = panel.into_iter().flat_map(|panel| panel.series.iter().rev().take(2));
        last.any(|series| series.points.iter().any(|[_, value]| value.is_finite()))
    }

    /// Paints marks over the plot.
    fn over(&self, painter: &Painter, series: &[Series]) {
        self.picture.over(painter, &self.frame.theme, (0, &self.place), series);
    }
}

/// Least heights of the plots when stacked, points.
fn least() -> [f32; COUNT] {
    std::array::from_fn(|k| LEAST[if k == 0 { 0 } else { 1 + usize::from(k + 1 == COUNT) }])
}

/// Places of the plots: a row, or a column in which the first is highest.
fn layout(area: Rect, beside: bool) -> [Rect; COUNT] {
    let gaps = (COUNT - 1) as f32 * GAP;
    if beside {
        let width = (area.width() - gaps) / COUNT as f32;
        std::array::from_fn(|i| {
            Rect::from_min_size(pos2(area.left() + i as f32 * (width + GAP), area.top()), vec2(width, area.height()))
        })
    } else {
        let total: f32 = least().iter().sum();
        let usable = area.height() - gaps;
        let mut top = area.top();
        least().map(|least| {
            let height = usable * least / total;
            let rect = Rect::from_min_size(pos2(area.left(), top), vec2(area.width(), height));
            top += height + GAP;
            rect
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plots_share_their_edges_and_do_not_overlap() {
        let area = Rect::from_min_size(pos2(10.0, 20.0), vec2(390.0, 500.0));
        for beside in [false, true] {
            let rects = layout(area, beside);
            assert!(rects.iter().all(|rect| area.expand(0.01).contains_rect(*rect)));
            assert!(!rects[0].intersects(rects[1]) && !rects[1].intersects(rects[2]));
            if beside {
                assert!(rects.iter().all(|rect| rect.y_range() == area.y_range()));
            } else {
                assert!(rects.iter().all(|rect| rect.x_range() == area.x_range()));
                assert!(rects[0].height() > rects[2].height());
            }
        }
    }
}
