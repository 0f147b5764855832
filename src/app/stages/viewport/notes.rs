//! What is written over the 3D picture: the legend and the scene's labels.

use egui::{Color32, Pos2, Rect, Ui, Vec2, pos2, vec2};

use super::subject::Subject;
use crate::app::charts::legend;
use crate::app::fonts;
use crate::app::lesson::captions::{self, Caption};
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use crate::scene::{Camera, Label, Line, Pose, Scene, Solid, arc};

/// Space between the legend and the view's edges, points; in a narrow view half of it.
const MARGIN: f32 = 14.0;
/// A view narrower than this has the legend in rows, points.
const NARROW: f32 = 480.0;

/// Writes legend, captions and labels of a run; `taken` is where other things stand.
pub fn notes(
    ui: &Ui,
    rect: Rect,
    camera: &Camera,
    subject: &Subject<'_>,
    (scene, said): (&Scene, &[Caption]),
    mut taken: Vec<Rect>,
) {
    let theme = Theme::of(ui);
    let view = View { rect, camera };
    taken.extend(name_all(ui, &view, &theme, subject, scene));
    // Labels first: they stand close to what they name, and a caption has room elsewhere.
    taken.extend(labels(ui, &view, &theme, scene, &taken));
    if !said.is_empty() {
        let seen: Vec<Pos2> = bodies(scene).chain(leaders(scene)).filter_map(|point| view.at(point)).collect();
        // Where there is little room, the latest alone.
        let first = if rect.width() < NARROW { said.len() - 1 } else { 0 };
        for caption in &said[first..] {
            let Some(anchor) = view.at(caption.anchor).filter(|at| rect.contains(*at)) else { continue };
            taken.extend(captions::paint(ui, rect, (caption, anchor), &taken, &seen));
        }
    }
}

struct View<'a> {
    rect: Rect,
    camera: &'a Camera,
}

impl View<'_> {
    fn at(&self, point: glam::Vec3) -> Option<Pos2> {
        let pixel = self.camera.project(point, glam::Vec2::new(self.rect.width(), self.rect.height()))?;
        Some(self.rect.min + vec2(pixel.x, pixel.y))
    }
}

/// Paints the legend at the bottom left, unless the robot is there; gives its place.
fn name_all(ui: &Ui, view: &View<'_>, theme: &Theme, subject: &Subject<'_>, scene: &Scene) -> Option<Rect> {
    let painter = ui.painter_at(view.rect);
    let narrow = view.rect.width() < NARROW;
    let room = view.rect.shrink(if narrow { 0.5 * MARGIN } else { MARGIN });
    let entries = subject.entries(theme, narrow);
    // Beside the robot in a column; in a narrow view below it, in rows.
    let width = if narrow { room.width() } else { 0.0 };
    let size = legend::size(&painter, theme, width, &entries);
    let place = Rect::from_min_size(pos2(room.left(), room.bottom() - size.y), size);
    let free = view.rect.contains_rect(place)
        && size.y < 0.45 * view.rect.height()
        && !bodies(scene).filter_map(|point| view.at(point)).any(|at| place.contains(at));
    free.then(|| {
        legend::legend(&painter, theme, place.min, width, &entries);
        place
    })
}

/// Points of everything that stands there: along tubes, around disks and cylinders.
fn bodies(scene: &Scene) -> impl Iterator<Item = glam::Vec3> {
    let tubes = scene.tubes.iter().flat_map(|tube| tube.path.iter().copied().step_by(4));
    let disks = scene.disks.iter().flat_map(|disk| arc::circle(disk.pose, disk.radius, 16));
    let blocks = scene.blocks.iter().flat_map(|block| {
        let (radius, half) = match block.solid {
            Solid::Box { half } => (half.x.max(half.y), half.z),
            Solid::Cylinder { radius, half_length } => (radius, half_length),
        };
        let end = move |z: f32| Pose::new(block.pose.point(glam::Vec3::Z * z), block.pose.rotation);
        [-half, half].into_iter().flat_map(move |z| arc::circle(end(z), radius, 16))
    });
    tubes.chain(disks).chain(blocks)
}

/// Points along the lines that lead to labels.
fn leaders(scene: &Scene) -> impl Iterator<Item = glam::Vec3> {
    let labelled = |line: &&Line| scene.labels.iter().any(|label| line.path.last() == Some(&label.anchor));
    let along = |line: &Line| {
        let [from, to] = [line.path[0], line.path[line.path.len() - 1]];
        (0..=8_u8).map(move |k| from.lerp(to, f32::from(k) / 8.0))
    };
    scene.lines.iter().filter(labelled).flat_map(along)
}

/// Writes the scene's labels: each where it asks to be, or mirrored to where it fits and covers nothing; gives their places.
fn labels(ui: &Ui, view: &View<'_>, theme: &Theme, scene: &Scene, taken: &[Rect]) -> Vec<Rect> {
    let mut written: Vec<Rect> = Vec::new();
    let painter = ui.painter_at(view.rect);
    let inside = view.rect.shrink(4.0);
    // The signs of this instant are the larger ones.
    let signs: Vec<Pos2> =
        scene.markers.iter().filter(|sign| sign.size > 13.0).filter_map(|sign| view.at(sign.position)).collect();
    for label in &scene.labels {
        let Some(anchor) = view.at(label.anchor).filter(|at| view.rect.contains(*at)) else { continue };
        let ink = color(label);
        let text = painter.layout_no_wrap(label.text.clone(), fonts::strong(12.5), ink);
        let free = |place: &Rect| {
            inside.contains_rect(*place)
                && !taken.iter().chain(&written).any(|other| other.intersects(*place))
                && !signs.iter().any(|sign| place.expand(7.0).contains(*sign))
        };
        let slid = |place: Rect| {
            let x = (inside.left() - place.left()).max(0.0) + (inside.right() - place.right()).min(0.0);
            place.translate(vec2(x, 0.0))
        };
        let Some(at) = places(anchor, label, text.size()).map(slid).find(free) else { continue };
        painter.rect_filled(at, 5.0, theme.panel.gamma_multiply(0.86));
        symbol::galley(&painter, at.min + vec2(5.0, 2.0), text, ink);
        written.push(at);
    }
    written
}

fn color(label: &Label) -> Color32 {
    let [r, g, b, _] = label.color.to_bytes();
    Color32::from_rgb(r, g, b)
}

/// Where a label's ground may lie, the best place first.
fn places(anchor: Pos2, label: &Label, size: Vec2) -> impl Iterator<Item = Rect> {
    let size = size + vec2(10.0, 4.0);
    let farther = [1.0, 1.8, 3.0, 4.5];
    let sides = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    let offset = vec2(label.offset.x, label.offset.y);
    farther.into_iter().flat_map(move |far| {
        sides.map(|(x, y)| {
            let off = far * vec2(x * offset.x, y * offset.y);
            let left = if off.x < 0.0 { anchor.x + off.x - size.x } else { anchor.x + off.x };
            let top = if off.y < 0.0 { anchor.y + off.y - size.y } else { anchor.y + off.y };
            Rect::from_min_size(pos2(left, top), size)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Color;

    #[test]
    fn a_label_is_tried_where_it_asks_first() {
        let label = Label {
            anchor: glam::Vec3::ZERO,
            offset: glam::Vec2::new(-8.0, 6.0),
            text: String::new(),
            color: Color::WHITE,
        };
        let anchor = pos2(100.0, 100.0);
        let all: Vec<Rect> = places(anchor, &label, vec2(30.0, 10.0)).collect();
        assert_eq!(all[0], Rect::from_min_size(pos2(52.0, 106.0), vec2(40.0, 14.0)));
        assert!(all.iter().all(|place| !place.contains(anchor)));
    }
}
