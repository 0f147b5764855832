//! The bending plane, seen flat: true and unconstrained backbone, the beam, and the three centrode loci (Fig. 4).

mod flat;
mod paint;
pub mod thumb;
mod track;

use crate::app::charts::legend::{Entry, Form, ROW, arrow, legend, mark, placed as placed_entry};
use crate::app::charts::notation::{job, note, number};
use crate::app::charts::plots::{Axis, Steps};
use crate::app::command::Command;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use crate::show::track::{Trace, standing};
use crate::show::{band, obstacle};
use centrode_core::detect::calibration::marginal::Estimate;
use centrode_core::detect::{Method, Standing};
use centrode_core::run::Run;
use egui::{Align2, Color32, CursorIcon, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2};
use flat::{Flat, Mark};
use paint::{label, place, shaded, strip};
use track::{Loci, Outline, Track};

/// Least size of the whole view, points.
const LEAST: Vec2 = vec2(160.0, 120.0);
/// Width of the legend beside the data.
const LEGEND: f32 = 122.0;
const TITLE: f32 = 22.0;
const TEXT: f32 = 12.5;
const SMALL: f32 = 10.5;
const GUTTER: f32 = 30.0;
const TICKS: f32 = 18.0;
/// Points per mm below which marks and lines become smaller.
const USUAL: f32 = 6.5;
/// A mark can be pointed at from this far, points.
const REACH: f32 = 10.0;

/// Shows the plane at the playback position `cursor` (s) in the space that is left, with the `frozen` shape of the paper's model if
/// that is wished, and with where the calibration filter places the contact, as far as that is known.
pub fn plane(
    ui: &mut Ui,
    run: &Run,
    trace: &Trace,
    (cursor, frozen, placed): (f64, bool, Option<&Estimate>),
    out: &mut Vec<Command>,
) {
    let theme = Theme::of(ui);
    let space = ui.available_size();
    let height = if space.y.is_finite() { space.y } else { 0.95 * space.x };
    let (_, area) = ui.allocate_space(vec2(space.x, height).max(LEAST));
    if !ui.is_rect_visible(area) {
        return;
    }
    let painter = ui.painter().clone();
    let track = Track::new(run, trace);
    let loci = track.loci(cursor);
    let title = painter.layout_job(job("Bending plane x_1–z_1 (mm)", TEXT, theme.ink));
    symbol::galley(&painter, pos2(area.left() + 2.0, area.top() + 1.0), title, theme.ink);
    let entries = entries(run, &theme, frozen);
    // The data is about as wide as high: what a low view has to spare is at its side.
    let aside = area.width() > 1.15 * area.height();
    let mut data = Rect::from_min_max(
        pos2(area.left() + GUTTER, area.top() + TITLE),
        pos2(area.right() - 2.0, area.bottom() - TICKS),
    );
    if aside {
        data.max.x -= LEGEND;
        // From the top of all, and closer where the view is low: none is cut.
        let row = (area.height() / entries.len() as f32).min(ROW);
        for (k, entry) in entries.iter().enumerate() {
            let at = pos2(data.right() + 8.0, area.top() + row * k as f32 - 0.5 * (ROW - row));
            legend(&painter, &theme, at, 0.0, std::slice::from_ref(entry));
        }
    } else {
        let at = pos2(area.left(), data.top());
        data.min.y += legend(&painter, &theme, at, area.width(), &entries) + 5.0;
    }
    let axes = Axes::fit(track.bounds(&loci), data);
    let size = (axes.scale / USUAL).clamp(0.6, 1.0);
    let view = View { run, track, theme, cursor, frozen, placed, axes, data, loci, size };

    let response = ui.interact(data, ui.scope_id().with("bending plane"), Sense::CLICK);
    let deviation = run.sample_at(cursor).judgement.deviation * 1e3;
    response.widget_info(|| {
        let text = format!("Bending plane at {cursor:.3} s; centrode deviation {} mm", number(deviation, 2));
        egui::WidgetInfo::labeled(egui::Role::Figure, ui.is_enabled(), text)
    });
    view.grid(&painter);
    let clipped = painter.with_clip_rect(data.intersect(painter.clip_rect()));
    view.robot(&clipped);
    view.band(&clipped);
    view.marks(&clipped);
    let named = view.force(&clipped);
    view.now(&clipped, named);
    view.estimate(&clipped);
    if let Some((mark, name, color, at)) = response.hover_pos().and_then(|pos| view.near(pos)) {
        ui.set_cursor_icon(CursorIcon::PointingHand);
        painter.circle_stroke(at, 7.0, Stroke::new(1.5, color));
        let text = format!("{name} at {:.3} s", mark.time);
        let place = format!("x_1 {}, z_1 {} mm", number(mark.at[0], 2), number(mark.at[1], 2));
        let lines = vec![job(&text, TEXT - 1.0, theme.ink), job(&place, TEXT - 1.0, theme.dim)];
        note(&painter, &theme, at, area, lines);
    }
    if response.clicked()
        && let Some((mark, ..)) = response.interact_pointer_pos().and_then(|pos| view.near(pos))
    {
        out.push(Command::Seek(mark.time));
    }
}

/// What the legend names: all that the run will show, so that it does not move during playback.
fn entries(run: &Run, theme: &Theme, frozen: bool) -> Vec<Entry> {
    let entry = |form, color, text| Entry { form, color, text };
    let mut entries = vec![
        entry(Form::Triangle, theme.model, "c_m model"),
        entry(Form::Dot, theme.sensor, "c_s sensor"),
        entry(Form::Solid, theme.robot, if run.is_recorded() { "as commanded" } else { "true shape" }),
    ];
    if run.contact_time().is_some() {
        entries.insert(1, entry(Form::Circle, theme.constrained, "c_c constrained"));
        entries.push(entry(Form::Ghost, theme.model, "if unconstrained"));
        if obstacle::only_touches(run) {
            entries.extend(frozen.then(|| entry(Form::Ghost, theme.constrained, "if clamped")));
            entries.push(entry(Form::Arrow, theme.force, "contact force"));
        }
    }
    if run.plan.contact().is_some() {
        entries.push(entry(Form::Beam, theme.obstacle, "beam"));
    }
    if run.detection().is_some() {
        entries.push(entry(Form::Diamond, theme.detection, "estimate, Eq. 24"));
    }
    entries.extend(placed_entry(run, theme));
    entries
}

/// Two axes of one scale.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Axes {
    x: Axis,
    z: Axis,
    /// Points per mm.
    scale: f32,
}

impl Axes {
    /// Fits bounds (mm) into a rectangle with some margin, centred.
    fn fit([low, high]: [Flat; 2], data: Rect) -> Self {
        let span = |i: usize| (high[i] - low[i]).max(1e-3) * 1.08;
        let scale = (f64::from(data.width()) / span(0)).min(f64::from(data.height()) / span(1)).max(1e-9);
        let range = |i: usize, points: f32| {
            let half = 0.5 * f64::from(points.max(1.0)) / scale;
            let middle = 0.5 * (low[i] + high[i]);
            [middle - half, middle + half]
        };
        Self {
            x: Axis::new(range(0, data.width()), [data.left(), data.right()]),
            z: Axis::new(range(1, data.height()), [data.bottom(), data.top()]),
            scale: scale as f32,
        }
    }

    fn at(&self, [x, z]: Flat) -> Pos2 {
        pos2(self.x.at(x), self.z.at(z))
    }

    fn holds(&self, [x, z]: Flat) -> bool {
        self.x.holds(x) && self.z.holds(z)
    }
}

struct View<'a> {
    run: &'a Run,
    track: Track<'a>,
    theme: Theme,
    cursor: f64,
    frozen: bool,
    placed: Option<&'a Estimate>,
    axes: Axes,
    data: Rect,
    loci: Loci,
    /// Size of marks and lines against the usual.
    size: f32,
}

impl View<'_> {
    fn line(&self, points: &[Flat]) -> Vec<Pos2> {
        points.iter().map(|&at| self.axes.at(at)).collect()
    }

    fn grid(&self, painter: &Painter) {
        let (data, theme) = (self.data, &self.theme);
        painter.rect_filled(data, 2.0, theme.panel);
        let font = FontId::proportional(SMALL);
        for tick in self.axes.x.ticks(44.0, Steps::Decimal) {
            let x = painter.round_to_pixel_center(self.axes.x.at(tick.value));
            painter.vline(x, data.y_range(), theme.line(1.0, theme.faint));
            if x > data.left() + 6.0 && x < data.right() - 8.0 {
                painter.text(pos2(x, data.bottom() + 4.0), Align2::CENTER_TOP, tick.text, font.clone(), theme.dim);
            }
        }
        for tick in self.axes.z.ticks(44.0, Steps::Decimal) {
            let y = painter.round_to_pixel_center(self.axes.z.at(tick.value));
            painter.hline(data.x_range(), y, theme.line(1.0, theme.faint));
            painter.text(pos2(data.left() - 5.0, y), Align2::RIGHT_CENTER, tick.text, font.clone(), theme.dim);
        }
    }

    /// The beam, the true robot, and its ghost.
    fn robot(&self, painter: &Painter) {
        let theme = &self.theme;
        let opacity = if self.track.let_go(self.cursor) { 0.3 } else { 1.0 };
        let (fill, edge) = (theme.obstacle.gamma_multiply(opacity), theme.ink.gamma_multiply(0.5 * opacity));
        let edge = self.theme.line(1.5, edge);
        for piece in self.track.beam() {
            match piece {
                Outline::Round(center, radius) => {
                    painter.circle(self.axes.at(center), radius as f32 * self.axes.scale, fill, edge);
                }
                Outline::Bar(corners) => {
                    painter.add(Shape::convex_polygon(self.line(&corners), fill, edge));
                }
            }
        }
        let frozen = if self.frozen { self.track.frozen(self.cursor) } else { None };
        for (ghost, color) in [(self.track.ghost(self.cursor), theme.model), (frozen, theme.constrained)] {
            let stroke = self.theme.line(1.6, color.gamma_multiply(0.75));
            painter.extend(Shape::dashed_line(&self.line(&ghost.unwrap_or_default()), stroke, 5.0, 4.0));
        }
        let robot = self.track.robot(&self.track.truth(self.cursor));
        let sides = robot.sides.each_ref().map(|side| self.line(side));
        strip(painter, [&sides[0], &sides[1]], theme.robot.gamma_multiply(0.13));
        for side in sides {
            painter.line(side, theme.line(1.0, theme.robot.gamma_multiply(0.55)));
        }
        for ends in &robot.disks {
            painter.line_segment(
                ends.map(|end| self.axes.at(end)),
                theme.line(3.0 * self.size, theme.robot.gamma_multiply(0.8)),
            );
        }
        painter.line(self.line(&robot.backbone), theme.line(3.0 * self.size, theme.robot));
    }

    /// The loci over the whole motion; the sensor's up to now.
    fn marks(&self, painter: &Painter) {
        for (shown, form, color) in self.shown() {
            let later = if shown.time > self.cursor { 0.45 } else { 1.0 };
            let at = self.axes.at(shown.at);
            let size = if form == Form::Dot { 0.8 } else { 0.95 };
            mark(painter, at, form, size * self.size, color.gamma_multiply(later), &self.theme);
        }
    }

    /// Every locus mark that can be seen.
    fn shown(&self) -> impl Iterator<Item = (&Mark, Form, Color32)> {
        let theme = &self.theme;
        fn of(marks: &[Mark], form: Form, color: Color32) -> impl Iterator<Item = (&Mark, Form, Color32)> {
            marks.iter().map(move |mark| (mark, form, color))
        }
        of(&self.loci.sensor, Form::Dot, theme.sensor)
            .chain(of(&self.loci.constrained, Form::Circle, theme.constrained))
            .chain(of(&self.loci.model, Form::Triangle, theme.model))
            .filter(|(mark, ..)| self.axes.holds(mark.at))
    }

    /// The mark nearest to the pointer.
    fn near(&self, pos: Pos2) -> Option<(Mark, &'static str, Color32, Pos2)> {
        let (mark, form, color) = self
            .shown()
            .map(|shown| (shown, self.axes.at(shown.0.at).distance(pos)))
            .filter(|(_, away)| *away <= REACH)
            .min_by(|a, b| a.1.total_cmp(&b.1))?
            .0;
        let name = match form {
            Form::Triangle => "Model c_m",
            Form::Circle => "Constrained c_c",
            _ => "Sensor c_s",
        };
        Some((*mark, name, color, self.axes.at(mark.at)))
    }

    /// The centrodes now, and the deviation between model and sensor; another label may have `taken` a place.
    fn now(&self, painter: &Painter, taken: Option<Rect>) {
        let theme = &self.theme;
        let sample = self.run.sample_at(self.cursor);
        let (model, sensor) = (self.track.model(&sample), self.track.sensed(&sample));
        let armed = standing(self.run, &sample) == Standing::Counts;
        if let Some(held) = self.track.constrained(self.cursor) {
            mark(painter, self.axes.at(held), Form::Circle, 1.6 * self.size, theme.constrained, theme);
        }
        if let (Some(model), Some(sensor), true) = (model, sensor, armed) {
            let settings = &self.run.plan.scenario().detection;
            let over = settings.judges(Method::Fcd)
                && settings.xi2.value().is_some_and(|xi2| sample.judgement.deviation > xi2);
            let color = if over { theme.detection } else { theme.sensor };
            let ends = [self.axes.at(model), self.axes.at(sensor)];
            painter.line_segment(ends, self.theme.line(2.0, color));
            let text = format!("{} mm", number(sample.judgement.deviation * 1e3, 2));
            self.value(painter, ends[0] + 0.5 * (ends[1] - ends[0]), ends, (&text, color), taken);
        }
        if let Some(model) = model {
            mark(painter, self.axes.at(model), Form::Triangle, 1.7 * self.size, theme.model, theme);
        }
        if let Some(sensor) = sensor {
            let color = theme.sensor.gamma_multiply(if armed { 1.0 } else { 0.45 });
            mark(painter, self.axes.at(sensor), Form::Dot, 2.2 * self.size, color, theme);
        }
    }

    /// A value beside `at`, clear of what is drawn, of the line that it belongs to and of a place that is taken; gives its own.
    fn value(
        &self,
        painter: &Painter,
        at: Pos2,
        ends: [Pos2; 2],
        (text, color): (&str, Color32),
        taken: Option<Rect>,
    ) -> Rect {
        let galley = painter.layout_job(job(text, TEXT - 1.0, self.theme.ink));
        let along = |[a, b]: [Pos2; 2]| (0_u8..=8).map(move |k| a + (b - a) * (f32::from(k) / 8.0));
        let mut in_the_way: Vec<Pos2> = self.shown().map(|(mark, ..)| self.axes.at(mark.at)).collect();
        let shape = self.track.truth(self.cursor);
        let robot = self.track.robot(&shape);
        in_the_way.extend(self.line(&robot.backbone));
        in_the_way.extend(robot.disks.iter().flatten().map(|&at| self.axes.at(at)));
        in_the_way.extend(along(ends));
        if let Some(force) = self.track.force(&shape) {
            in_the_way.extend(along(force.arrow.map(|at| self.axes.at(at))));
        }
        if let Some(Outline::Round(center, _)) = self.track.beam().first() {
            in_the_way.push(self.axes.at(*center));
        }
        if let Some(taken) = taken {
            in_the_way.extend(along([taken.left_top(), taken.right_top()]));
            in_the_way.extend(along([taken.left_bottom(), taken.right_bottom()]));
        }
        let at = self.data.shrink(8.0).clamp(at);
        let rect = place(at, galley.size() + vec2(10.0, 4.0), self.data.shrink(2.0), &in_the_way);
        label(painter, rect, galley, color, &self.theme);
        rect
    }

    /// The force of a beam that only touches, with its size beside its tail; gives the place of that.
    fn force(&self, painter: &Painter) -> Option<Rect> {
        let force = self.track.force(&self.track.truth(self.cursor))?;
        let ends = force.arrow.map(|at| self.axes.at(at));
        arrow(painter, ends, self.theme.line(2.4, self.theme.force));
        Some(self.value(painter, ends[0], ends, (&force.words, self.theme.force), None))
    }

    /// Where the calibration filter places the contact, along the true backbone.
    fn band(&self, painter: &Painter) {
        let Some(placed) = self.placed else { return };
        let steps = band::steps(placed);
        let shape = self.track.truth(self.cursor);
        let across = |s: f64| self.axes.at(self.track.place(&shape, s));
        let color = self.theme.constrained;
        for step in steps {
            let ends = [step.at - step.half, step.at + step.half].map(across);
            let side = (ends[1] - ends[0]).normalized().rot90() * ((3.0 + 6.0 * step.strength) * self.size);
            let corners = [ends[0] - side, ends[0] + side, ends[1] + side, ends[1] - side];
            shaded(painter, corners, color.gamma_multiply(step.opacity));
        }
        // The ends of the interval, so that a narrow one is seen.
        for (end, inward) in [(placed.place.low, 1e-4), (placed.place.high, -1e-4)] {
            let [at, beside] = [end, end + inward].map(across);
            let side = (beside - at).normalized().rot90() * (13.0 * self.size);
            painter.line_segment([at - side, at + side], self.theme.line(1.5, color));
        }
    }

    /// After an alarm: the places of the contact that the paper and the calibration filter give it on the backbone, against the true one.
    fn estimate(&self, painter: &Painter) {
        let theme = &self.theme;
        let detection = self.run.detection().filter(|detection| detection.time <= self.cursor);
        if detection.is_none() && self.placed.is_none() {
            return;
        }
        let shape = self.track.truth(self.cursor);
        if let Some(contact) = self.run.plan.contact() {
            let truth = self.axes.at(self.track.place(&shape, contact.arc_length));
            painter.circle(truth, 4.5 * self.size, theme.obstacle, Stroke::new(1.5, theme.panel));
        }
        let mut lines = Vec::new();
        if let Some(detection) = detection {
            let at = self.axes.at(self.track.place(&shape, detection.location));
            mark(painter, at, Form::Diamond, 1.6 * self.size, theme.detection, theme);
            lines.push(format!("estimate {} mm", number(detection.location * 1e3, 1)));
        }
        lines.extend(self.placed.map(|placed| format!("95 %: {}", band::interval(placed))));
        if let Some(contact) = self.run.plan.contact().filter(|_| self.run.contact_time().is_some()) {
            lines.push(format!("true {} mm", number(contact.arc_length * 1e3, 1)));
        }
        // In the corner that is free: beside the backbone it would cover what it points at.
        let galley = painter.layout_job(job(&lines.join("\n"), TEXT - 1.0, theme.ink));
        if self.data.width() < 2.0 * galley.size().x || self.data.height() < 4.0 * galley.size().y {
            return;
        }
        let size = galley.size() + vec2(12.0, 6.0);
        let rect = Rect::from_min_size(self.data.right_bottom() - size - vec2(6.0, 6.0), size);
        let edge = if detection.is_some() { theme.detection } else { theme.constrained };
        label(painter, rect, galley, edge, theme);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_axes_have_one_scale_and_hold_the_bounds() {
        for size in [vec2(300.0, 200.0), vec2(120.0, 500.0)] {
            let data = Rect::from_min_size(pos2(7.0, 9.0), size);
            let bounds = [[-4.0, -1.0], [22.0, 31.0]];
            let axes = Axes::fit(bounds, data);
            assert!((axes.x.per_point() - axes.z.per_point()).abs() < 1e-6);
            assert!(bounds.iter().all(|&corner| data.contains(axes.at(corner))));
            assert!(axes.at([0.0, 5.0]).y > axes.at([0.0, 6.0]).y, "z points up");
        }
    }
}
