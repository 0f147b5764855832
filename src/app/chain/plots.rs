//! Plots over time of several segments: everything of the chosen one, or one thing of every segment beside each other.

use crate::app::chain::apply::Wish;
use crate::app::chain::memo::Memo;
use crate::app::chain::{ChainState, chosen};
use crate::app::charts::notation::{job, number};
use crate::app::charts::paint::{self, Picture, page};
use crate::app::charts::plots::frame::{Frame, GUTTER, Pointed, RIGHT, ReadOut, SMALL};
use crate::app::charts::plots::{Touch, layout};
use crate::app::command::Command;
use crate::app::panels::save;
use crate::app::saving::Subject;
use crate::app::theme::Theme;
use crate::app::widgets::finger;
use crate::app::widgets::segmented::{Segment, segments};
use centrode_core::chart::layout::{Ink, Page};
use centrode_core::chart::{Chart, Style};
use centrode_core::study::chain::ChainRun;
use centrode_core::study::chain::course::Shown;
use egui::{Rect, Role, Ui, Vec2, pos2, vec2};

/// From this width of each on the plots stand side by side.
const SIDE_BY_SIDE: f32 = 200.0;
/// Least height of a plot.
const LEAST: f32 = 104.0;
/// Space between plots.
const GAP: f32 = 10.0;

/// What a plot is made of: the run's version, the segment, what is shown, and whether its times have no numbers.
type Key = (u64, usize, Shown, bool);

/// What the plots remember between frames.
#[derive(Default)]
pub struct PlotsState {
    /// Time under the pointer, s.
    hover: Option<f64>,
    /// The plots as they were last laid out.
    pictures: Vec<Option<Picture<Key>>>,
    /// What a touch that began on a plot turned out to be.
    touch: Touch,
    /// Ends of what is shown, by run.
    ranges: Vec<(u64, Shown, [f64; 2])>,
}

impl PlotsState {
    fn range(&mut self, (run, version): (&ChainRun, u64), shown: Shown) -> [f64; 2] {
        self.ranges.retain(|(of, ..)| *of == version);
        if let Some((.., range)) = self.ranges.iter().find(|(_, of, _)| *of == shown) {
            return *range;
        }
        let range = shown.range(run);
        self.ranges.push((version, shown, range));
        range
    }
}

/// What is shown in one plot.
#[derive(Debug, Clone, Copy, PartialEq)]
struct One {
    segment: usize,
    shown: Shown,
    /// Whether the segment is what tells it from the others.
    by_segment: bool,
}

/// Shows the plots in the space that is left; `cursor` is the playback position, s.
pub fn plots(
    ui: &mut Ui,
    (memo, set): (&Memo, &ChainState),
    cursor: f64,
    state: &mut PlotsState,
    out: &mut Vec<Command>,
) {
    let all = Shown::all(memo.run());
    let theme = Theme::of(ui);
    let high = finger::at_least(ui, 26.0);
    let (strip, _) = ui.allocate_exact_size(vec2(ui.available_width(), high), egui::Sense::hover());
    choices(ui, strip, (memo, set), &all, out);
    ui.add_space(6.0);
    let segment = set.segment.min(memo.run().recording.segments() - 1);
    let ones: Vec<One> = if set.all {
        let shown = chosen(set, &all);
        let each = shown.is_of_each();
        shown.segments(memo.run()).map(|segment| One { segment, shown, by_segment: each }).collect()
    } else {
        // Of the whole robot, whichever is chosen.
        let of = |shown: &Shown| if shown.is_of_each() { shown.segments(memo.run()).contains(&segment) } else { true };
        all.iter().filter(|shown| of(shown)).map(|shown| One { segment, shown: *shown, by_segment: false }).collect()
    };
    let space = ui.available_size();
    let wide = space.x >= SIDE_BY_SIDE * ones.len() as f32;
    let least = if wide { LEAST } else { (LEAST + GAP) * ones.len() as f32 - GAP };
    let tall = if space.y.is_finite() { space.y.max(least) } else { 1.1 * least };
    let size = vec2(space.x.max(160.0), tall);
    let mut content = |ui: &mut Ui| {
        let (_, area) = ui.allocate_space(size);
        if ui.is_rect_visible(area) {
            in_place(ui, (area, wide), &ones, (memo, cursor), (state, &theme), out);
        }
    };
    if space.y < least {
        egui::ScrollArea::vertical().id_salt("chain plots").auto_shrink(false).show(ui, content);
    } else {
        content(ui);
    }
}

/// Which plots are shown: of the chosen segment, or of all, and then what of them.
fn choices(ui: &mut Ui, strip: Rect, (memo, set): (&Memo, &ChainState), all: &[Shown], out: &mut Vec<Command>) {
    let side = save::side(ui);
    let own = format!("Segment {}", set.segment.min(memo.run().recording.segments() - 1) + 1);
    let narrow = strip.width() < 560.0;
    let of = [
        Segment {
            text: if narrow { "All" } else { "All segments" },
            name: "All segments",
            hint: "One plot for every segment",
        },
        Segment { text: &own, name: &own, hint: "Everything of the chosen segment" },
    ];
    let width = if narrow { 0.36 * strip.width() } else { 220.0 };
    let left = strip.with_max_x(strip.left() + width);
    if let Some(picked) = segments(ui, left, ("Plots", Role::RadioButton), &of, usize::from(!set.all)) {
        out.push(Command::Chain(Wish::PlotAll(picked == 0)));
    }
    let right =
        Rect::from_min_max(pos2(left.right() + 8.0, strip.top()), pos2(strip.right() - side - 4.0, strip.bottom()));
    if set.all && right.width() > 60.0 {
        let measures: Vec<_> = all.iter().map(|shown| shown.measure()).collect();
        let options: Vec<Segment<'_>> = measures
            .iter()
            .map(|measure| Segment {
                text: if right.width() < 110.0 * measures.len() as f32 {
                    letter(measure.name)
                } else {
                    short(measure.name)
                },
                name: measure.name,
                hint: measure.name,
            })
            .collect();
        let at = set.shown.min(all.len() - 1);
        if let Some(picked) = segments(ui, right, ("Shown of every segment", Role::RadioButton), &options, at) {
            out.push(Command::Chain(Wish::Plot(picked)));
        }
    }
    let corner = pos2(strip.right() - 0.5 * side, strip.center().y);
    save::menu(ui, Rect::from_center_size(corner, Vec2::splat(side - 2.0)), Subject::Chain, out);
}

/// A name that fits on a switch.
fn short(name: &'static str) -> &'static str {
    match name {
        "Centrode deviation" => "Centrode",
        "Consistent centrode deviation" => "Consistent",
        "Velocity deviation" => "Velocity",
        "Log likelihood ratio" => "Likelihood",
        "Screw axis distance" => "Axis distance",
        "Screw axis angle" => "Axis angle",
        "Tangent angle" => "θL",
        "Stability margin" => "Margin",
        "Bending direction" => "δ",
        other => other,
    }
}

/// What stands for it where there is room for a letter only.
fn letter(name: &'static str) -> &'static str {
    match name {
        "Centrode deviation" => "c",
        "Consistent centrode deviation" => "c′",
        "Velocity deviation" => "v",
        "Log likelihood ratio" => "g",
        "Screw axis distance" => "f",
        "Screw axis angle" => "α",
        "Stability margin" => "m",
        other => short(other),
    }
}

fn in_place(
    ui: &mut Ui,
    (area, beside): (Rect, bool),
    ones: &[One],
    (memo, cursor): (&Memo, f64),
    (state, theme): (&mut PlotsState, &Theme),
    out: &mut Vec<Command>,
) {
    let (run, version) = (memo.run(), memo.version());
    let hovered = state.hover.take();
    state.pictures.resize_with(ones.len(), || None);
    let last = run.recording.times.len() - 1;
    let sample = |time: f64| run.recording.times.partition_point(|at| *at <= time).saturating_sub(1).min(last);
    for (which, (one, rect)) in ones.iter().zip(layout(area, beside, ones.len())).enumerate() {
        let range = state.range((run, version), one.shown);
        let measure = one.shown.measure();
        let bare = !beside && which + 1 < ones.len();
        let make = || {
            let mut panel = one.shown.panel(run, one.segment, range);
            panel.x.bare = bare;
            Chart { panels: vec![panel], ..Chart::default() }
        };
        let mut kept = state.pictures[which].take();
        let key = (version, one.segment, one.shown, bare);
        let picture = Picture::keep(&mut kept, ui.ctx(), theme, (key, false), make);
        let sides = Some([GUTTER, RIGHT].map(f64::from));
        let page = Page { sides, pixel: f64::from(1.0 / ui.pixels_per_point()), ..page(SMALL) };
        let places = picture.show(ui.painter(), theme, Frame::below_title(rect), page);
        if let Some(place) = places.into_iter().next() {
            let frame = Frame::new(rect, &place, measure.scale, *theme);
            let value = |time: f64| one.shown.value(run, one.segment, sample(time)) * measure.scale;
            let color = paint::color(Ink::Role(measure.role), theme);
            let painter = ui.painter().clone();
            let behind = if measure.unit.is_empty() { String::new() } else { format!(" ({})", measure.unit) };
            let short = if one.by_segment {
                format!("Segment {} {}{behind}", one.segment + 1, measure.symbol)
            } else {
                format!("{}{behind}", measure.symbol)
            };
            let long = match one.by_segment {
                true => {
                    format!("Segment {}: {} {}{behind}", one.segment + 1, measure.name.to_lowercase(), measure.symbol)
                }
                false if !one.shown.is_of_each() => measure.name.to_owned(),
                false => format!("{} {short}", measure.name),
            };
            let label = if one.shown.is_of_each() {
                format!("Plot of segment {}: {} over time", one.segment + 1, measure.name.to_lowercase())
            } else {
                format!("Plot of the {} over time", measure.name.to_lowercase())
            };
            let readout =
                ReadOut { name: "", value: number(value(cursor), measure.decimals), color, style: Style::Line };
            frame.title(&painter, &long, &short, &[readout]);
            let response = frame.sense(ui, which, &label);
            let Pointed { hover, seek } = frame.point(ui, &response, &mut state.touch);
            state.hover = hover.or(state.hover);
            out.extend(seek.filter(|to| *to != cursor).map(Command::Seek));
            frame.cursor(&painter, cursor, &[(value(cursor), color)]);
            if let Some(time) = hovered {
                let text = format!("{} {} {}", measure.symbol, number(value(time), measure.decimals), measure.unit);
                frame.hover(&painter, time, [job(text.trim_end(), SMALL + 1.0, color)]);
            }
        }
        state.pictures[which] = kept;
    }
}
