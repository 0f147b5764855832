//! Live plots over one time axis: what each detector judges, and the tangent angle.
//!
//! The core lays them out as it does every chart; what a person moves lies over that and is painted anew in each frame.
//! Thresholds are lines that can be dragged, typed and switched off; the playback position is scrubbed anywhere else.

mod axis;
mod between;
pub mod frame;
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
use std::f64::consts::PI;

/// From this width of each on the plots stand side by side.
const SIDE_BY_SIDE: f32 = 260.0;
/// In a frame, where scrolling is the host page's, from this width of each on before they would have to be scrolled.
const FRAMED_SIDE_BY_SIDE: f32 = 160.0;
/// Least heights of the plots when stacked, in points: of the first, of the others, and of the last.
const LEAST: [f32; 3] = [128.0, 112.0, 84.0];
/// Least height of the plots side by side.
const LEAST_ROW: f32 = 120.0;
/// Space between plots.
const GAP: f32 = 10.0;
/// Stacked plots may be so much lower or higher, that what is seen ends where a plot does.
const LOWEST: f32 = 0.85;
const HIGHEST: f32 = 1.3;

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
    pictures: Vec<Option<Picture<Key>>>,
    /// The detectors that have plots, plot by plot, and in which version of the run.
    judging: Option<(u64, Vec<Vec<Method>>)>,
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
pub enum Touch {
    /// It has not moved yet.
    #[default]
    Undecided,
    /// It moves along the time.
    Scrubs,
    /// It moves up or down.
    Scrolls,
}

/// Shows the plots in the space that is left. `version` is another for every other run; `cursor` is the playback position, s.
pub fn plots(ui: &mut Ui, (run, version): (&Run, u64), cursor: f64, state: &mut PlotState, out: &mut Vec<Command>) {
    let space = ui.available_size();
    let judging = match state.judging.take() {
        Some((of, judging)) if of == version => judging,
        _ => shown(run),
    };
    // Behind the detectors' plots, that of the tangent angle.
    let count = judging.len() + 1;
    let wide = |least: f32| space.x >= least * count as f32;
    let beside = wide(SIDE_BY_SIDE) && !(space.y.is_finite() && space.y > 0.9 * space.x);
    let stacked = least(count).iter().sum::<f32>() + (count - 1) as f32 * GAP;
    let beside = beside || state.framed && wide(FRAMED_SIDE_BY_SIDE) && space.y < stacked;
    let least = if beside { LEAST_ROW } else { whole(stacked, count, space.y) };
    let size = vec2(space.x.max(200.0), if space.y.is_finite() { space.y.max(least) } else { 1.2 * least });
    if space.y < least {
        let area = egui::ScrollArea::vertical().id_salt("plots").auto_shrink(false);
        area.show(ui, |ui| in_place(ui, (size, beside), &judging, (run, version), cursor, state, out));
    } else {
        in_place(ui, (size, beside), &judging, (run, version), cursor, state, out);
    }
    state.judging = Some((version, judging));
}

/// The detectors that have plots in a run, plot by plot.
fn shown(run: &Run) -> Vec<Vec<Method>> {
    let mut plots = course::plots(run.judged.settings.thresholds.detectors);
    plots.iter_mut().for_each(|methods| methods.retain(|&method| course::has_plot(run, method)));
    plots.retain(|methods| !methods.is_empty());
    plots
}

fn in_place(
    ui: &mut Ui,
    (size, beside): (Vec2, bool),
    judging: &[Vec<Method>],
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
    let count = judging.len() + 1;
    state.pictures.resize_with(count, || None);
    for (which, rect) in layout(area, beside, count).into_iter().enumerate() {
        let methods = judging.get(which).map(Vec::as_slice);
        let top = methods.map(|methods| top(state, (run, version), methods));
        let bare = !beside && which + 1 < count;
        let make = || {
            let mut panel = match (methods, top) {
                (Some(methods), Some(top)) => course::statistic(run, methods, top),
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
                methods.and_then(|methods| methods.first()).map_or(180.0 / PI, |&m| course::measure(m).scale),
                theme,
            );
            // In the corner of the card.
            if which == if beside { count - 1 } else { 0 } {
                let side = save::side(ui);
                let corner = pos2(rect.right() - 0.5 * side, rect.top() + 9.0);
                let button = Rect::from_center_size(corner, Vec2::splat(side - 2.0));
                save::menu_with(ui, button, Subject::Plots, state.marks.iter().all(Option::is_some), out);
                frame.tool = side - RIGHT;
            }
            let (state, out) = (&mut *state, &mut *out);
            let marks = state.marks;
            let mut view = View { run, cursor, marks, hovered, frame, place, picture, which, top, state, out };
            match methods {
                Some(methods) => panels::judging(ui, &mut view, methods),
                None => panels::angle(ui, &mut view),
            }
        }
        state.pictures[which] = kept;
    }
}

/// How high the plot of some detectors reaches, SI: as it did while a threshold of theirs is being moved.
fn top(state: &mut PlotState, (run, version): (&Run, u64), methods: &[Method]) -> f64 {
    if let Some(&held) = methods.iter().find_map(|method| state.held.get(method)) {
        return held;
    }
    let one = |&method: &Method| {
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
    };
    methods.iter().map(one).fold(0.0, f64::max)
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

    /// Whether the last curves, or what of them stands back, have any value.
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

/// Least heights of so many plots when stacked, points.
fn least(count: usize) -> Vec<f32> {
    let kind = |k: usize| if k + 1 == count { 2 } else { usize::from(k > 0) };
    (0..count).map(|k| LEAST[kind(k)]).collect()
}

/// How high so many plots are that are `stacked` high, where so much of them is seen: a little lower or higher, so that none is cut where that is
/// possible.
fn whole(stacked: f32, count: usize, seen: f32) -> f32 {
    let least = least(count);
    let high = |plots: usize| least[..plots].iter().sum::<f32>();
    let gaps = |plots: usize| plots.saturating_sub(1) as f32 * GAP;
    let fits = (1..=count).rev().find(|&plots| seen >= LOWEST * high(plots) + gaps(plots));
    let Some(plots) = fits.filter(|_| seen < stacked) else { return stacked };
    let share = (seen - gaps(plots)) / high(plots);
    if share > HIGHEST { stacked } else { share * high(count) + gaps(count) }
}

/// Places of so many plots: a row, or a column in which the first is highest.
pub fn layout(area: Rect, beside: bool, count: usize) -> Vec<Rect> {
    let gaps = count.saturating_sub(1) as f32 * GAP;
    if beside {
        let width = (area.width() - gaps) / count as f32;
        let place = |k: usize| pos2(area.left() + k as f32 * (width + GAP), area.top());
        (0..count).map(|k| Rect::from_min_size(place(k), vec2(width, area.height()))).collect()
    } else {
        let least = least(count);
        let total: f32 = least.iter().sum();
        let usable = area.height() - gaps;
        let mut top = area.top();
        let place = |least: f32| {
            let height = usable * least / total;
            let rect = Rect::from_min_size(pos2(area.left(), top), vec2(area.width(), height));
            top += height + GAP;
            rect
        };
        least.into_iter().map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_plot_is_cut_where_one_has_room() {
        for (count, seen, plots) in
            [(2, 112.0, 1), (3, 128.0, 1), (3, 164.0, 1), (3, 246.0, 2), (3, 300.0, 3), (6, 124.0, 1)]
        {
            let stacked = least(count).iter().sum::<f32>() + (count - 1) as f32 * GAP;
            let area = Rect::from_min_size(pos2(0.0, 0.0), vec2(390.0, whole(stacked, count, seen)));
            let last = layout(area, false, count)[plots - 1];
            assert!((last.bottom() - seen).abs() < 0.01, "{count} plots, {seen} seen: {last:?}");
            // Who has room for all is shown all; where one has too little, none is squeezed; and none is blown up.
            assert_eq!([900.0, 100.0, 190.0].map(|seen| whole(stacked, count, seen)), [stacked; 3]);
        }
    }

    #[test]
    fn plots_share_their_edges_and_do_not_overlap() {
        let area = Rect::from_min_size(pos2(10.0, 20.0), vec2(390.0, 500.0));
        for (beside, count) in [(false, 1), (true, 1), (false, 3), (true, 3), (false, 6), (true, 6)] {
            let rects = layout(area, beside, count);
            assert!(rects.len() == count && rects.iter().all(|rect| area.expand(0.01).contains_rect(*rect)));
            assert!(rects.windows(2).all(|two| !two[0].intersects(two[1])));
            if beside {
                assert!(rects.iter().all(|rect| rect.y_range() == area.y_range()));
            } else {
                assert!(rects.iter().all(|rect| rect.x_range() == area.x_range()));
                assert!(count == 1 || rects[0].height() > rects[count - 1].height());
            }
        }
    }
}
