//! Paints a chart that the core has laid out.

use crate::app::charts::notation::{job, job_in};
use crate::app::fonts;
use crate::app::theme::Theme;
use crate::app::widgets::symbol;
use crate::scene::palette::{Palette, Shade};
use crate::show::ink;
use centrode_core::chart::clip::{self, Spot};
use centrode_core::chart::layout::{Align, Drawing, Form, Frame, Ink, Item, Page, Paint, Text, layout, over};
use centrode_core::chart::svg::FAINT;
use centrode_core::chart::{Chart, Map, Role, Series};
use egui::{
    Align2, Color32, ColorImage, Context, Mesh, Painter, Pos2, Rect, Stroke, TextureHandle, TextureOptions, Vec2, pos2,
    vec2,
};

/// Where a panel of a painted chart lies on the screen. Values are SI.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    frame: Frame,
    origin: Vec2,
}

impl Place {
    /// The data's place.
    #[must_use]
    pub fn data(&self) -> Rect {
        rect(self.frame.data, self.origin)
    }

    /// Both ends of both axes.
    #[must_use]
    pub fn ranges(&self) -> [[f64; 2]; 2] {
        [self.frame.x.range(), self.frame.y.range()]
    }

    /// Where a point lies.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> Pos2 {
        pos(self.frame.at(point), self.origin)
    }

    /// The values under a point of the screen, within the ranges.
    #[must_use]
    pub fn value(&self, at: Pos2) -> [f64; 2] {
        let at = at - self.origin;
        self.frame.value([at.x.into(), at.y.into()])
    }
}

fn pos([x, y]: Spot, origin: Vec2) -> Pos2 {
    pos2(x as f32, y as f32) + origin
}

fn rect(rect: clip::Rect, origin: Vec2) -> Rect {
    Rect::from_min_max(pos([rect.left, rect.top], origin), pos([rect.right, rect.bottom], origin))
}

/// The colour of an ink in a theme.
#[must_use]
pub fn color(ink: Ink, theme: &Theme) -> Color32 {
    match ink {
        Ink::Ground => theme.panel,
        Ink::Grid => theme.faint.gamma_multiply(0.7),
        Ink::Role(Role::Robot) => theme.robot,
        _ => {
            let [r, g, b, a] = ink::color(ink, &Palette::of(theme.shade), theme.dark).to_bytes();
            Color32::from_rgba_unmultiplied(r, g, b, a)
        }
    }
}

/// A map as a texture, a pixel for each cell; `soft` blends neighbours.
fn texture(ctx: &Context, name: &str, map: &Map, theme: &Theme, soft: bool) -> TextureHandle {
    let (columns, rows) = (map.columns, map.rows());
    // Rows from the top of the page down, columns from its left.
    let (turned, rising) = (map.x[0] > map.x[1], map.y[0] < map.y[1]);
    let row = |k: usize| if rising { rows - 1 - k } else { k };
    let cells = (0..rows).flat_map(|k| (0..columns).map(move |column| (k, column))).map(|(k, column)| {
        let cell = row(k) * columns + if turned { columns - 1 - column } else { column };
        let share = map.share(map.values[cell]);
        if share.is_nan() {
            return Color32::TRANSPARENT;
        }
        let color = color(Ink::Map(share), theme);
        if map.is_faint(cell) { theme.raised.lerp_to_gamma(color, FAINT as f32) } else { color }
    });
    let image = ColorImage::new([columns, rows], cells.collect());
    let options = if soft { TextureOptions::LINEAR } else { TextureOptions::NEAREST };
    ctx.load_texture(name, image, options)
}

/// A chart as it was last shown: kept while what it was made of, its key, and the page stay the same.
pub struct Picture<K> {
    key: K,
    /// Whose textures the maps are: the page may be drawn by another from a moment on.
    ctx: Context,
    shade: Shade,
    chart: Chart,
    maps: Vec<Option<TextureHandle>>,
    laid: Option<(Page, Drawing)>,
}

impl<K: PartialEq> Picture<K> {
    /// The picture that is kept, or another where its key or the theme differs; `soft` blends neighbours in maps.
    pub fn keep<'a>(
        kept: &'a mut Option<Self>,
        ctx: &Context,
        theme: &Theme,
        (key, soft): (K, bool),
        make: impl FnOnce() -> Chart,
    ) -> &'a mut Self {
        let same = kept.take().filter(|was| was.key == key && was.shade == theme.shade && was.ctx == *ctx);
        kept.insert(same.unwrap_or_else(|| {
            let chart = make();
            let map = |panel: &centrode_core::chart::Panel| {
                panel.map.as_ref().map(|map| texture(ctx, &panel.title, map, theme, soft))
            };
            let maps = chart.panels.iter().map(map).collect();
            Self { key, ctx: ctx.clone(), shade: theme.shade, chart, maps, laid: None }
        }))
    }

    /// The chart.
    #[must_use]
    pub fn chart(&self) -> &Chart {
        &self.chart
    }

    /// Paints it on a page of the size of `space`; gives the places of its panels.
    pub fn show(&mut self, painter: &Painter, theme: &Theme, space: Rect, page: Page) -> Vec<Place> {
        let page = Page { size: [space.width().into(), space.height().into()], ..page };
        let (_, drawing) = match self.laid.take().filter(|(was, _)| *was == page) {
            Some(laid) => self.laid.insert(laid),
            None => self.laid.insert((page, layout(&self.chart, &page))),
        };
        let brush = Brush { painter, theme, origin: space.min.to_vec2(), maps: &self.maps };
        drawing.shapes.iter().for_each(|shape| brush.shape(shape));
        drawing.frames.iter().map(|&frame| Place { frame, origin: brush.origin }).collect()
    }

    /// Paints what moves over a panel: series in its place.
    pub fn over(&self, painter: &Painter, theme: &Theme, (panel, place): (usize, &Place), series: &[Series]) {
        let Some((page, _)) = &self.laid else { return };
        let on_map = self.maps.get(panel).is_some_and(Option::is_some);
        let brush = Brush { painter, theme, origin: place.origin, maps: &[] };
        over(&place.frame, series, page, on_map).iter().for_each(|shape| brush.shape(shape));
    }
}

/// A page of the interface with a size of text, points.
#[must_use]
pub fn page(text: f32) -> Page {
    Page::screen([0.0; 2], text.into())
}

struct Brush<'a> {
    painter: &'a Painter,
    theme: &'a Theme,
    origin: Vec2,
    maps: &'a [Option<TextureHandle>],
}

impl Brush<'_> {
    fn color(&self, paint: Paint) -> Color32 {
        color(paint.ink, self.theme).gamma_multiply(paint.opacity as f32)
    }

    fn pos(&self, point: Spot) -> Pos2 {
        pos(point, self.origin)
    }

    fn shape(&self, shape: &Item) {
        let painter = self.painter;
        match shape {
            Item::Fill(place, paint) => {
                painter.rect_filled(rect(*place, self.origin), 0.0, self.color(*paint));
            }
            Item::Map(place, panel) => {
                let place = rect(*place, self.origin);
                painter.rect_filled(place, 0.0, self.theme.raised);
                if let Some(Some(texture)) = self.maps.get(*panel) {
                    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
                    painter.image(texture.id(), place, whole, Color32::WHITE);
                }
            }
            Item::Band(edges, paint) => self.band(edges, self.color(*paint)),
            Item::Line(points, paint, wide, dash) => {
                let stroke = Stroke::new((*wide as f32).max(1.0) * self.theme.weight, self.color(*paint));
                let points = self.sharp(points.iter().map(|point| self.pos(*point)).collect());
                match dash {
                    Some(dash) => painter.extend(dashed(&points, stroke, dash.map(|length| length as f32))),
                    None => drop(painter.line(points, stroke)),
                }
            }
            Item::Mark(at, form, radius, paint, edge) => self.mark(*at, *form, *radius, *paint, *edge),
            Item::Text(text) => self.text(text),
        }
    }

    /// A straight line along an axis on whole pixels.
    fn sharp(&self, mut points: Vec<Pos2>) -> Vec<Pos2> {
        if let [a, b] = &mut points[..] {
            if a.x == b.x {
                a.x = self.painter.round_to_pixel_center(a.x);
                b.x = a.x;
            } else if a.y == b.y {
                a.y = self.painter.round_to_pixel_center(a.y);
                b.y = a.y;
            }
        }
        points
    }

    fn band(&self, edges: &[[Spot; 2]], color: Color32) {
        let mut mesh = Mesh::default();
        for (k, edge) in edges.iter().enumerate() {
            edge.iter().for_each(|point| mesh.colored_vertex(self.pos(*point), color));
            if k > 0 {
                let next = 2 * k as u32;
                mesh.add_triangle(next - 2, next - 1, next);
                mesh.add_triangle(next - 1, next, next + 1);
            }
        }
        self.painter.add(egui::Shape::mesh(mesh));
    }

    fn mark(&self, at: Spot, form: Form, radius: f64, paint: Paint, edge: Ink) {
        let (fill, edge) = (self.color(paint), color(edge, self.theme));
        let wide = (radius * form.stroke()) as f32;
        let (place, r) = (self.pos(at), radius as f32);
        let painter = self.painter;
        match form {
            Form::Triangle | Form::Diamond => {
                let corners = form.corners(at, radius).into_iter().map(|corner| self.pos(corner)).collect();
                painter.add(egui::Shape::convex_polygon(corners, fill, Stroke::new(0.5 * wide, edge)));
            }
            Form::Circle => drop(painter.circle(place, r, edge, Stroke::new(wide, fill))),
            Form::Dot => drop(painter.circle(place, r, fill, Stroke::new(wide, edge))),
            Form::Ring => drop(painter.circle_stroke(place, r, Stroke::new(wide, fill))),
        }
    }

    fn text(&self, text: &Text) {
        let (ink, size) = (color(text.ink, self.theme), text.size as f32);
        let job = if text.strong {
            job_in(&text.text, &fonts::strong_family(), size, ink)
        } else {
            job(&text.text, size, ink)
        };
        let galley = self.painter.layout_job(job);
        let (at, [wide, high]) = (self.pos(text.at), galley.size().into());
        let along = match text.align {
            Align::Left => 0.0,
            Align::Center => 0.5 * wide,
            Align::Right => wide,
        };
        if text.upright {
            // Turned about its upper left corner.
            symbol::upright(self.painter, at + vec2(-0.5 * high, along), galley, ink);
        } else {
            let place = Align2::LEFT_CENTER.anchor_size(at - vec2(along, 0.0), vec2(wide, high));
            symbol::galley(self.painter, place.min, galley, ink);
        }
    }
}

/// A line of dashes: the lengths of two, each with the gap behind it.
pub fn dashed(points: &[Pos2], stroke: Stroke, [one, gap, other, last]: [f32; 4]) -> Vec<egui::Shape> {
    egui::Shape::dashed_line_with_offset(points, stroke, &[one, other], &[gap, last], 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::chart::{Axis, Panel};

    #[test]
    fn a_picture_is_kept_until_its_key_or_the_theme_changes() {
        let ctx = Context::default();
        let axis = |name| Axis::new(name, "1", "1", 1.0);
        let map = Map {
            unit: "s",
            scale: 1.0,
            columns: 2,
            values: vec![0.0, 1.0],
            faint: vec![false, true],
            x: [0.0, 2.0],
            y: [0.0, 1.0],
            ends: [0.0, 1.0],
            level: None,
            line: Vec::new(),
        };
        let chart = || {
            let panel = Panel { map: Some(map.clone()), ..Panel::new(axis("x"), axis("y")) };
            Chart { panels: vec![panel], ..Chart::default() }
        };
        let mut kept: Option<Picture<u32>> = None;
        let mut image = |key: u32, shade: Shade| {
            let picture = Picture::keep(&mut kept, &ctx, &Theme::new(shade), (key, false), chart);
            picture.maps[0].as_ref().map(TextureHandle::id)
        };
        let light = image(1, Shade::Light);
        assert!(light.is_some() && image(1, Shade::Light) == light, "kept");
        // What stands back in a map is mixed with the theme's ground.
        let dark = image(1, Shade::Dark);
        assert_ne!(dark, light);
        assert_ne!(image(2, Shade::Dark), dark);
    }
}
