//! Live plots over one time axis: the centrode deviation, the joint force deviation, the tangent angle.
//!
//! Thresholds are lines that can be dragged, typed and switched off; the playback position is scrubbed anywhere else.

mod axis;
mod frame;
mod marks;
mod panels;
mod range;
mod threshold;

pub use axis::{Axis, Steps, Tick};

use crate::app::command::Command;
use crate::app::theme::Theme;
use centrode_core::run::Run;
use egui::{Rect, Ui, Vec2, pos2, vec2};
use frame::Frame;

/// From this width on the plots stand side by side.
const SIDE_BY_SIDE: f32 = 780.0;
/// Least heights of the three plots when stacked, in points.
const LEAST: [f32; 3] = [128.0, 112.0, 84.0];
/// Least height of the plots side by side.
const LEAST_ROW: f32 = 120.0;
/// Space between plots.
const GAP: f32 = 10.0;

/// What the plots remember between frames; nothing of it is an input of the experiment.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlotState {
    /// Time under the pointer, s: shown in all plots.
    hover: Option<f64>,
    /// ξ2 (m) and ξ1 (N·m) as they are when switched on again; the page remembers them, not the plots.
    pub otherwise: [f64; 2],
    /// Tops of the deviation plots, held while a threshold is being moved.
    held: [Option<f64>; 2],
    /// Distance from the pointer to what it holds when a drag starts, points.
    grip: f32,
    /// What a touch that began on a plot turned out to be.
    touch: Touch,
}

/// A touch may scrub, or scroll the page.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Touch {
    #[default]
    Undecided,
    Scrubs,
    Scrolls,
}

/// Shows the plots in the space that is left; `cursor` is the playback position, s.
pub fn plots(ui: &mut Ui, run: &Run, cursor: f64, state: &mut PlotState, out: &mut Vec<Command>) {
    let space = ui.available_size();
    let beside = space.x >= SIDE_BY_SIDE && !(space.y.is_finite() && space.y > 0.9 * space.x);
    let least = if beside { LEAST_ROW } else { LEAST.iter().sum::<f32>() + 2.0 * GAP };
    let size = vec2(space.x.max(200.0), if space.y.is_finite() { space.y.max(least) } else { 1.2 * least });
    if space.y < least {
        let area = egui::ScrollArea::vertical().id_salt("plots").auto_shrink(false);
        area.show(ui, |ui| in_place(ui, size, beside, run, cursor, state, out));
    } else {
        in_place(ui, size, beside, run, cursor, state, out);
    }
}

fn in_place(
    ui: &mut Ui,
    size: Vec2,
    beside: bool,
    run: &Run,
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
    let cursor = cursor.clamp(0.0, end(run));
    for (which, rect) in layout(area, beside).into_iter().enumerate() {
        let frame = Frame::new(rect, run, beside || which == 2, theme, ui.pixels_per_point());
        let mut view = View { run, cursor, hovered, frame, which, state: &mut *state, out: &mut *out };
        match which {
            0 => panels::deviation(ui, &mut view),
            1 => panels::force(ui, &mut view),
            _ => panels::angle(ui, &mut view),
        }
    }
}

/// One plot being shown.
struct View<'a> {
    run: &'a Run,
    cursor: f64,
    /// Time under the pointer in the frame before, s.
    hovered: Option<f64>,
    frame: Frame,
    /// 0 deviation, 1 force, 2 angle.
    which: usize,
    state: &'a mut PlotState,
    out: &'a mut Vec<Command>,
}

/// Time of the last sample, s.
fn end(run: &Run) -> f64 {
    run.sample(run.len() - 1).time
}

/// Places of the three plots: a row, or a column in which the first is highest.
fn layout(area: Rect, beside: bool) -> [Rect; 3] {
    if beside {
        let width = (area.width() - 2.0 * GAP) / 3.0;
        std::array::from_fn(|i| {
            Rect::from_min_size(pos2(area.left() + i as f32 * (width + GAP), area.top()), vec2(width, area.height()))
        })
    } else {
        let total: f32 = LEAST.iter().sum();
        let usable = area.height() - 2.0 * GAP;
        let mut top = area.top();
        LEAST.map(|least| {
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
