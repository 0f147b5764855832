//! What the untouched page says while it plays for the first time: it bends, it touches, it is found.

use crate::app::charts::notation::number;
use crate::app::fonts;
use crate::app::memo;
use crate::app::theme::Theme;
use centrode_core::model::Vec3;
use centrode_core::run::Run;
use egui::{Event, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};

/// How long the segment bends before that is said, s.
const BENT: f64 = 0.4;
/// How far apart places are tried, points.
const STEP: f32 = 12.0;
/// The widest that a caption gets, points.
const WIDTH: f32 = 210.0;

/// A sentence at a place in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Caption {
    /// What it speaks of, m, in the base frame.
    pub anchor: glam::Vec3,
    /// What it says.
    pub text: String,
}

/// Whether there is something to be said. It is said once, and not to someone who has begun to use the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Captions {
    /// Nothing was touched yet, and nothing has moved.
    Waiting,
    /// The first playback runs.
    Running,
    /// All was said, or the person has taken over.
    Over,
}

impl Captions {
    /// On a page that was opened untouched, or on another.
    #[must_use]
    pub fn new(untouched: bool) -> Self {
        if untouched { Self::Waiting } else { Self::Over }
    }

    /// Goes on by a frame: whether playback runs, and whether the person did something.
    pub fn go_on(&mut self, playing: bool, touched: bool) {
        *self = match *self {
            // The touch that starts playback is no end of what it starts.
            Self::Waiting if playing => Self::Running,
            Self::Running if touched || !playing => Self::Over,
            other => other,
        };
    }

    /// Ends them: the page shows something else than it opened with, or begins again.
    pub fn end(&mut self) {
        *self = Self::Over;
    }

    /// What is said at a time (s) of a run.
    #[must_use]
    pub fn at(self, run: &Run, time: f64) -> Vec<Caption> {
        if self == Self::Running { captions(run, time) } else { Vec::new() }
    }
}

/// Whether the person clicked, touched or pressed a key in this frame.
#[must_use]
pub fn touched(ui: &Ui) -> bool {
    ui.input(|input| {
        input.events.iter().any(|event| {
            matches!(
                event,
                Event::PointerButton { pressed: true, .. }
                    | Event::Key { pressed: true, .. }
                    | Event::Touch { .. }
                    | Event::MouseWheel { .. }
                    | Event::AccessKitActionRequest(_)
            )
        })
    })
}

fn at(position: &Vec3) -> glam::Vec3 {
    glam::Vec3::new(position.x as f32, position.y as f32, position.z as f32)
}

fn captions(run: &Run, time: f64) -> Vec<Caption> {
    let begins = run.plan.scenario().motion.start + BENT;
    let (Some(contact), Some(beam)) = (run.contact_time(), run.plan.contact()) else { return Vec::new() };
    if time < begins || time > memo::end(run) {
        return Vec::new();
    }
    let place = run.place(time);
    let on = |s: f64| at(&run.shape(place).pose(s).position);
    let said = |anchor, text: &str| Caption { anchor, text: text.into() };
    if time < contact {
        return vec![said(on(run.segment().length), "It bends. Model and sensor agree on what it turns about.")];
    }
    let mut captions = vec![said(on(beam.arc_length), "It touches the beam: the part below stops.")];
    if let Some(detection) = run.detection().filter(|detection| (contact..=time).contains(&detection.time)) {
        // As they were found: at rest there is nothing but noise.
        let judgement = run.sample_at(detection.time).judgement;
        let between = 0.5 * (at(&judgement.model_centrode) + at(&judgement.sensor_centrode));
        let delay = number(detection.time - contact, 2);
        let anchor = if between.is_finite() { between } else { on(detection.location) };
        captions.push(said(anchor, &format!("The centrodes have parted: found after {delay}\u{a0}s.")));
    }
    captions
}

/// Paints a caption beside where its anchor is seen, clear of what is `taken` and, if it can be, of `bodies`; gives its place.
pub fn paint(
    ui: &Ui,
    view: Rect,
    (caption, anchor): (&Caption, Pos2),
    taken: &[Rect],
    bodies: &[Pos2],
) -> Option<Rect> {
    let theme = Theme::of(ui);
    let painter = ui.painter_at(view);
    let narrow = view.width() < 2.0 * WIDTH;
    let (width, size) = if narrow { (0.3 * view.width(), 12.0) } else { (WIDTH, 13.0) };
    let galley = painter.layout(caption.text.clone(), fonts::strong(size), theme.panel, width);
    let size = galley.size() + vec2(20.0, 14.0);
    let place = place(anchor, size, view.shrink(6.0), (taken, bodies))?;
    let near = near(&place, anchor);
    painter.add(Shape::line_segment([anchor, near], Stroke::new(1.5, theme.ink)));
    painter.circle(anchor, 3.5, theme.ink, Stroke::new(1.5, theme.panel));
    painter.rect_filled(place, 8.0, theme.ink);
    painter.galley(place.min + vec2(10.0, 7.0), galley, theme.panel);
    let response = ui.interact(place, ui.scope_id().with(&caption.text), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Status, true, &caption.text));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_live(egui::accesskit::Live::Polite));
    Some(place)
}

/// The point of a place that is nearest to an anchor.
fn near(place: &Rect, anchor: Pos2) -> Pos2 {
    pos2(anchor.x.clamp(place.left(), place.right()), anchor.y.clamp(place.top(), place.bottom()))
}

/// Where something so large stands beside an anchor: clear of what is `taken`, and neither it nor its line over a body; where that cannot
/// be, over as few points of bodies as can be.
fn place(anchor: Pos2, size: Vec2, inside: Rect, (taken, bodies): (&[Rect], &[Pos2])) -> Option<Rect> {
    let free =
        |place: &Rect| inside.contains_rect(*place) && !taken.iter().any(|other| other.expand(4.0).intersects(*place));
    let places: Vec<Rect> = around(anchor, size).chain(anywhere(anchor, size, inside)).filter(free).collect();
    let covered = |place: &Rect| bodies.iter().filter(|body| place.expand(4.0).contains(**body)).count();
    let clear = |place: &&Rect| {
        let line = |k: u8| anchor.lerp(near(place, anchor), f32::from(k) / 16.0);
        covered(place) == 0 && !(0..=16).map(line).any(|point| taken.iter().any(|other| other.contains(point)))
    };
    places.iter().find(clear).or_else(|| places.iter().min_by_key(|place| covered(place))).copied()
}

/// Places around an anchor, the nearest first.
fn around(anchor: Pos2, size: Vec2) -> impl Iterator<Item = Rect> {
    [40.0, 70.0, 110.0, 160.0].into_iter().flat_map(move |far: f32| {
        [(1.0, -0.4), (1.0, 0.4), (-1.0, -0.4), (-1.0, 0.4), (0.2, -1.0), (0.2, 1.0)].map(|(x, y): (f32, f32)| {
            let reach = vec2(far + 0.5 * size.x * x.abs(), far + 0.5 * size.y);
            Rect::from_center_size(anchor + vec2(x.signum() * reach.x * x.abs(), y * reach.y), size)
        })
    })
}

/// Places all over the view, the nearest to an anchor first.
fn anywhere(anchor: Pos2, size: Vec2, inside: Rect) -> Vec<Rect> {
    let steps = |room: f32| (0..=(room.max(0.0) / STEP) as u16).map(|k| f32::from(k) * STEP);
    let down = || steps(inside.height() - size.y);
    let corners = steps(inside.width() - size.x).flat_map(|x| down().map(move |y| vec2(x, y)));
    let mut places: Vec<Rect> = corners.map(|corner| Rect::from_min_size(inside.min + corner, size)).collect();
    places.sort_by(|a, b| a.distance_sq_to_pos(anchor).total_cmp(&b.distance_sq_to_pos(anchor)));
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset::PRESETS;

    #[test]
    fn three_captions_appear_at_their_instants() {
        let run = simulate(&PRESETS[0].scenario().expect("valid")).expect("a run");
        let (contact, found) = (run.contact_time().expect("one"), run.detection().expect("one").time);
        let said = |time| captions(&run, time).into_iter().map(|caption| caption.text).collect::<Vec<_>>();
        assert!(said(3.1).is_empty());
        assert!(matches!(&said(4.0)[..], [one] if one.starts_with("It bends")));
        assert!(matches!(&said(contact)[..], [one] if one.starts_with("It touches")));
        assert_eq!(said(found - 0.001).len(), 1);
        let last = said(found);
        assert!(last.len() == 2 && last[1].contains(&number(found - contact, 2)), "{last:?}");
        // Where they speak of: the contact on the backbone, the end disk well above.
        let (touch, tip) = (captions(&run, contact)[0].anchor, captions(&run, 4.0)[0].anchor);
        assert!((touch.length() - 0.015).abs() < 0.001 && tip.z > 0.027, "{touch} {tip}");
    }

    #[test]
    fn where_no_place_is_clear_the_least_is_covered() {
        let (view, size) = (Rect::from_min_size(Pos2::ZERO, vec2(220.0, 160.0)), vec2(100.0, 60.0));
        // Points all over, and a disk to the right of the anchor, where a caption would stand first.
        let anchor = pos2(60.0, 80.0);
        let over = |k: u16| pos2(f32::from(k % 11) * 20.0, f32::from(k / 11) * 20.0);
        let disk = |k: u16| pos2(160.0, 60.0) + 14.0 * Vec2::angled(f32::from(k));
        let bodies: Vec<Pos2> = (0..99).map(over).chain((0..16).map(disk)).collect();
        let found = place(anchor, size, view, (&[], &bodies)).expect("a place");
        let covered = |place: &Rect| bodies.iter().filter(|body| place.expand(4.0).contains(**body)).count();
        let first = around(anchor, size).find(|place| view.contains_rect(*place)).expect("one beside it");
        assert!(covered(&first) > 16 && (16..115).all(|k| !found.contains(disk(k))), "{found} covers the disk");
        // With room, none is covered.
        let free: Vec<Pos2> = bodies.iter().copied().filter(|body| body.x > 115.0).collect();
        let found = place(anchor, size, view, (&[], &free)).expect("a place");
        assert!(!free.iter().any(|body| found.contains(*body)), "{found}");
    }

    #[test]
    fn they_run_once_and_end_at_a_touch() {
        let mut captions = Captions::new(true);
        captions.go_on(false, true);
        assert_eq!(captions, Captions::Waiting, "nothing plays yet");
        captions.go_on(true, true);
        assert_eq!(captions, Captions::Running, "the touch that starts playback");
        captions.go_on(true, false);
        assert_eq!(captions, Captions::Running);
        captions.go_on(true, true);
        assert_eq!(captions, Captions::Over);
        captions.go_on(true, false);
        assert_eq!(captions, Captions::Over);
        let mut other = Captions::new(false);
        other.go_on(true, false);
        assert_eq!(other, Captions::Over);
    }
}
