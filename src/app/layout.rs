//! Where everything is, on a desk, a tablet and a phone, and in the frame of another page.

pub mod sheet;

use egui::{Rect, Ui, Vec2, pos2, vec2};

use crate::app::controls::row::TARGET;
use crate::app::embed::{Embed, TOOL};
use crate::app::lesson::tour::Focus;
use crate::app::mirror;
use crate::app::panels::title::tools_width;
use crate::app::panels::transport::{FLAT, TALL};
use crate::app::theme::GAP;
use sheet::{Handle, Sheet};

/// The rectangles of the page. What is not there is not shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// Title and presets.
    pub title: Option<Rect>,
    /// The bar of views.
    pub views: Option<Rect>,
    /// Sharing, theme, help and, where they are in a sheet, controls; in a frame the way out of it.
    pub tools: Rect,
    /// 3D view, or what else stands on the stage.
    pub view: Option<Rect>,
    /// Playback.
    pub transport: Option<Rect>,
    /// Controls; on a small screen in the sheet, and none while that holds the tabs.
    pub controls: Option<Rect>,
    /// Tabs and below them one of the three views that follow.
    pub tabbed: Option<Rect>,
    /// Bending plane.
    pub plane: Option<Rect>,
    /// Readout.
    pub readout: Option<Rect>,
    /// Plots.
    pub plots: Option<Rect>,
    /// The card of the tour and the challenges.
    pub lesson: Option<Rect>,
    /// Whether the controls are in a sheet.
    pub sheet: bool,
    /// The sheet on a small screen, and its handle.
    pub handle: Option<Handle>,
}

/// Cuts a strip off one side of a rectangle, and a gap.
struct Cut(Rect);

impl Cut {
    fn top(&mut self, height: f32) -> Rect {
        let cut = self.0.with_max_y(self.0.top() + height);
        self.0.min.y = cut.bottom() + GAP;
        cut
    }

    fn bottom(&mut self, height: f32) -> Rect {
        let cut = self.0.with_min_y(self.0.bottom() - height);
        self.0.max.y = cut.top() - GAP;
        cut
    }

    fn left(&mut self, width: f32) -> Rect {
        let cut = self.0.with_max_x(self.0.left() + width);
        self.0.min.x = cut.right() + GAP;
        cut
    }

    fn right(&mut self, width: f32) -> Rect {
        let cut = self.0.with_min_x(self.0.right() - width);
        self.0.max.x = cut.left() - GAP;
        cut
    }
}

/// The page without its edges.
fn inner(page: Rect) -> Cut {
    Cut(page.shrink2(vec2(GAP, 0.0)).with_max_y(page.bottom() - GAP))
}

/// What stands at the top.
struct Bar {
    title: Option<Rect>,
    views: Rect,
    tools: Rect,
}

impl Bar {
    /// All in one row; the title above what is so wide. In a frame there is no title.
    fn in_one(row: Rect, title: f32, sheet: bool, framed: bool) -> Self {
        let mut row = Cut(row);
        if framed {
            let tools = row.right(if sheet { 2.0 * TOOL } else { TOOL });
            return Self { title: None, views: row.0, tools };
        }
        let tools = row.right(tools_width(sheet));
        let title = row.left(title);
        Self { title: Some(title), views: row.0, tools }
    }
}

impl Layout {
    /// Lays out a page of a size, or what of it is shown in a frame.
    #[must_use]
    pub fn new(page: Rect, sheet: Sheet, embed: Option<Embed>) -> Self {
        match embed {
            None => Self::whole(page, sheet, false),
            Some(Embed::All) => Self::whole(page, sheet, true),
            Some(Embed::Tuning) => Self::alone(page),
            Some(Embed::Robot) => {
                let (whole, rest) = Self::played(page);
                Self { view: Some(rest), ..whole }
            }
            Some(Embed::Plots) => {
                let (whole, rest) = Self::played(page);
                Self { plots: Some(rest), ..whole }
            }
        }
    }

    fn whole(page: Rect, sheet: Sheet, framed: bool) -> Self {
        let Vec2 { x: width, y: height } = page.size();
        if height < 560.0 || (width < 1140.0 && height < 640.0) {
            if width < 560.0 { Self::phone(page, sheet, framed) } else { Self::low(page, sheet, framed) }
        } else if width <= 700.0 {
            Self::phone(page, sheet, framed)
        } else if width < 1140.0 {
            Self::tablet(page, framed)
        } else {
            Self::desk(page, framed)
        }
    }

    /// What stands on the stage, and a foot.
    fn alone(page: Rect) -> Self {
        let mut rest = Cut(page.shrink(0.5 * GAP));
        let tools = rest.bottom(34.0);
        Self { view: Some(rest.0), ..Self::tools(tools) }
    }

    /// Playback at the bottom with the tools beside it, and what is left for one view. A frame too small for that has no playback,
    /// and the tools lie over the view.
    fn played(page: Rect) -> (Self, Rect) {
        let mut rest = Cut(page.shrink(0.5 * GAP));
        if page.height() < 240.0 || page.width() < 300.0 {
            let corner = vec2(TOOL, TOOL).min(rest.0.size());
            return (Self::tools(Rect::from_min_size(rest.0.max - corner, corner)), rest.0);
        }
        let mut foot = Cut(rest.bottom(if rest.0.width() < 620.0 { TALL } else { FLAT }));
        let tools = foot.right(TOOL);
        (Self { transport: Some(foot.0), ..Self::tools(tools) }, rest.0)
    }

    /// Nothing but the tools.
    fn tools(tools: Rect) -> Self {
        Self {
            title: None,
            views: None,
            tools,
            view: None,
            transport: None,
            controls: None,
            tabbed: None,
            plane: None,
            readout: None,
            plots: None,
            lesson: None,
            sheet: false,
            handle: None,
        }
    }

    /// Controls at the left, 3D in the middle, plane and readout at the right, plots below.
    fn desk(page: Rect, framed: bool) -> Self {
        let mut rest = inner(page);
        let bar = rest.top(46.0);
        let controls = rest.left(306.0);
        let plots = rest.bottom((page.height() * 0.25).clamp(180.0, 330.0));
        let transport = rest.bottom(FLAT);
        let mut side = Cut(rest.right((page.width() * 0.24).clamp(290.0, 440.0)));
        let readout = side.bottom((side.0.height() * 0.48).clamp(262.0, 300.0).min(side.0.height() - 130.0));
        Self {
            controls: Some(controls),
            plane: Some(side.0),
            readout: Some(readout),
            plots: Some(plots),
            ..Self::plain(Bar::in_one(bar, controls.width(), false, framed), rest.0, transport)
        }
    }

    /// Controls at the left; 3D, playback and tabs above each other.
    fn tablet(page: Rect, framed: bool) -> Self {
        let mut rest = inner(page);
        let bar = rest.top(46.0);
        let controls = rest.left(276.0);
        let tabbed = rest.bottom((page.height() * 0.43).max(290.0));
        let transport = rest.bottom(if rest.0.width() < 560.0 { TALL } else { FLAT });
        let bar = Bar::in_one(bar, controls.width(), false, framed);
        Self { controls: Some(controls), tabbed: Some(tabbed), ..Self::plain(bar, rest.0, transport) }
    }

    /// No more than the bar, 3D and playback.
    fn plain(Bar { title, views, tools }: Bar, view: Rect, transport: Rect) -> Self {
        Self { title, views: Some(views), view: Some(view), transport: Some(transport), ..Self::tools(tools) }
    }

    /// Views and 3D on top, the sheet below, playback under the thumb.
    fn phone(page: Rect, sheet: Sheet, framed: bool) -> Self {
        let mut rest = inner(page);
        let row = rest.top(TARGET);
        let bar = if framed {
            Bar::in_one(row, 0.0, true, true)
        } else {
            let mut row = Cut(row);
            let tools = row.right(tools_width(true));
            Bar { title: Some(row.0), views: rest.top(TARGET), tools }
        };
        let transport = rest.bottom(TALL);
        Self::plain(bar, rest.0, transport).with_sheet(sheet::below(rest.0, sheet), sheet)
    }

    /// A phone on its side: 3D at the left, the sheet at the right, playback below.
    fn low(page: Rect, sheet: Sheet, framed: bool) -> Self {
        let mut rest = inner(page);
        let bar = rest.top(TARGET);
        let transport = rest.bottom(if page.width() < 700.0 { TALL } else { FLAT });
        // Beside the tools and five views that can be read.
        let room = bar.width() - tools_width(true) - 2.0 * GAP - 5.0 * TARGET;
        let title = (0.32 * bar.width()).clamp(150.0, 300.0).min(room.max(110.0));
        Self::plain(Bar::in_one(bar, title, true, framed), rest.0, transport)
            .with_sheet(sheet::beside(rest.0, sheet), sheet)
    }

    /// A frame with room for the one or the other has no sheet, unless that is drawn up.
    fn with_sheet(self, (view, handle): (Option<Rect>, Handle), sheet: Sheet) -> Self {
        if view.is_none() && sheet.at <= 1.0 {
            return self;
        }
        let place = handle.split().1;
        let (controls, tabbed) = if sheet.controls { (Some(place), None) } else { (None, Some(place)) };
        Self { view, controls, tabbed, sheet: true, handle: Some(handle), ..self }
    }

    /// How wide the card of a lesson gets.
    #[must_use]
    pub fn lesson_width(&self) -> f32 {
        let places = [self.readout, self.tabbed, self.controls.filter(|_| self.sheet)];
        places.into_iter().flatten().next().map_or(0.0, |rect| rect.width())
    }

    /// Makes room for the card of a lesson, as high as it needs to be where that is possible. On a desk it takes the place of the readout,
    /// and where that is too low that of the bending plane, too; where there is room for one view only, that is the one that the lesson looks at.
    #[must_use]
    pub fn with_lesson(self, need: f32, focus: Focus) -> Self {
        if focus == Focus::Plate {
            return self.with_plate(need);
        }
        if let (Some(plane), Some(readout)) = (self.plane, self.readout) {
            let mut side = Cut(plane.union(readout));
            let most = (side.0.height() - 165.0).max(readout.height());
            if need > most {
                // What is to be done is to be seen without scrolling.
                return Self { plane: None, readout: None, lesson: Some(side.0), ..self };
            }
            let lesson = side.bottom(need.clamp(readout.height(), most));
            return Self { plane: Some(side.0), readout: None, lesson: Some(lesson), ..self };
        }
        let (Some(view), Some(transport)) = (self.view, self.transport) else { return self };
        let Some(lower) = self.tabbed.or(self.controls.filter(|_| self.sheet)) else { return self };
        let beside = lower.left() > view.right();
        if !self.sheet {
            let mut rest = Cut(view.union(transport).union(lower));
            let lesson = rest.bottom(need.min(0.4 * rest.0.height()));
            let tabbed = rest.bottom((0.45 * rest.0.height()).max(190.0));
            let transport = rest.bottom(transport.height());
            let (view, tabbed, transport) = (Some(rest.0), Some(tabbed), Some(transport));
            return Self { view, tabbed, transport, lesson: Some(lesson), ..self };
        }
        let mut rest = Cut(if beside { view } else { view.union(lower) });
        let lower = self.handle.map_or(lower, |handle| handle.sheet);
        let lesson = if beside { lower } else { rest.bottom(need.min(0.7 * rest.0.height())) };
        let one = |wanted: bool| wanted.then_some(rest.0);
        let open = self.controls.is_some();
        let (plots, robot) = (focus == Focus::Plots && !open, focus == Focus::Robot && !open);
        Self { view: one(robot), tabbed: one(plots), controls: one(open), lesson: Some(lesson), handle: None, ..self }
    }

    /// Nothing but the bars, the plate in place of the view, and the card.
    fn with_plate(self, need: f32) -> Self {
        let parts = [self.view, self.transport, self.controls, self.tabbed, self.plane, self.readout, self.plots];
        let mut rest = Cut(parts.into_iter().flatten().fold(Rect::NOTHING, Rect::union));
        let lesson = match (self.readout, rest.0.width() > 1.3 * rest.0.height()) {
            (Some(readout), _) => {
                let side = rest.right(readout.width());
                side.with_max_y(side.bottom().min(side.top() + need))
            }
            (None, true) => rest.right(0.5 * rest.0.width()),
            (None, false) => rest.bottom(need.min(0.6 * rest.0.height())),
        };
        let Self { title, views, tools, sheet, .. } = self;
        Self { title, views, view: Some(rest.0), lesson: Some(lesson), sheet, ..Self::tools(tools) }
    }

    /// Where a figure, the table or the map stands: in the place of view, plane and readout; on a phone of the tabs, too.
    #[must_use]
    pub fn stage(&self) -> Rect {
        // Beside the card there is less of it.
        if let Some(rect) = self.lesson.and(self.view.or(self.tabbed).or(self.controls)) {
            return rect;
        }
        let tabbed = self.tabbed.filter(|_| self.sheet);
        [self.view, self.plane, self.readout, tabbed].into_iter().flatten().fold(Rect::NOTHING, Rect::union)
    }

    /// Every rectangle there is.
    #[must_use]
    pub fn all(&self) -> Vec<Rect> {
        [
            self.title,
            self.views,
            Some(self.tools),
            self.view,
            self.transport,
            self.controls,
            self.tabbed,
            self.plane,
            self.readout,
            self.plots,
            self.lesson,
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

/// Shows a card with content that stays inside it.
pub fn card<R>(ui: &mut Ui, name: &str, rect: Rect, content: impl FnOnce(&mut Ui) -> R) -> R {
    let theme = crate::app::theme::Theme::of(ui);
    ui.painter().rect_filled(rect, f32::from(crate::app::theme::ROUND), theme.panel);
    inside(ui, name, rect, content)
}

/// Rounds the corners of a card whose content fills it.
pub fn round(ui: &Ui, rect: Rect) {
    let theme = crate::app::theme::Theme::of(ui);
    let edge = egui::Stroke::new(0.5 * GAP, theme.surface);
    ui.painter().rect_stroke(rect, f32::from(crate::app::theme::ROUND), edge, egui::StrokeKind::Outside);
}

/// What the parts of the page are called by those who do not see them; others are parts of these.
const PARTS: [(&str, &str); 11] = [
    ("title", "Experiment"),
    ("views", "Views"),
    ("tools", "Tools"),
    ("controls", "Controls"),
    ("view", "3D view"),
    ("stage", "Stage"),
    ("transport", "Playback"),
    ("readout", "Result"),
    ("plots", "Plots"),
    ("plane", "Bending plane"),
    ("symbols", "Symbols"),
];

/// Shows a part of the page that keeps to its place by itself.
pub fn part<R>(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui) -> R) -> R {
    let mut child = ui.new_child(egui::UiBuilder::new().id_salt(name).max_rect(ui.max_rect()));
    told(&child, name);
    content(&mut child)
}

fn told(ui: &Ui, name: &str) {
    if let Some((_, told)) = PARTS.iter().find(|(part, _)| *part == name) {
        mirror::mark(ui, mirror::Part::Region, told);
    }
}

/// Shows content in a rectangle.
pub fn inside<R>(ui: &mut Ui, name: &str, rect: Rect, content: impl FnOnce(&mut Ui) -> R) -> R {
    let mut child = ui.new_child(egui::UiBuilder::new().id_salt(name).max_rect(rect));
    child.shrink_clip_rect(rect);
    told(&child, name);
    content(&mut child)
}

/// The strip of tabs in a tabbed card, and what is below.
#[must_use]
pub fn tab_strip(rect: Rect) -> (Rect, Rect) {
    let strip = Rect::from_min_max(rect.min + vec2(8.0, 4.0), pos2(rect.right() - 8.0, rect.top() + 4.0 + TARGET));
    (strip, rect.with_min_y(strip.bottom() + 4.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_overlaps_or_leaves_the_page() {
        for (width, height) in [
            (390.0, 844.0),
            (360.0, 640.0),
            (320.0, 568.0),
            (844.0, 390.0),
            (768.0, 1024.0),
            (1024.0, 768.0),
            (1280.0, 720.0),
            (1440.0, 900.0),
            (1920.0, 1080.0),
            (2560.0, 1440.0),
        ] {
            let page = Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height));
            let stops = [false, true].map(|controls| [0.0, 1.0, 2.0].map(|at| Sheet { controls, at }));
            for sheet in stops.into_iter().flatten() {
                let layout = Layout::new(page, sheet, None);
                assert!(layout.view.is_some() || sheet.at > 1.0, "{width}×{height}: {sheet:?}");
                let rects = layout.all();
                for (i, rect) in rects.iter().enumerate() {
                    assert!(page.contains_rect(*rect), "{width}×{height}: {rect:?}");
                    // The first three are bars.
                    let least = if i < 3 { vec2(76.0, 36.0) } else { vec2(180.0, 40.0) };
                    assert!(rect.width() >= least.x && rect.height() >= least.y, "{width}×{height}: {rect:?}");
                    for other in &rects[..i] {
                        assert!(
                            !rect.shrink(0.5).intersects(other.shrink(0.5)),
                            "{width}×{height}: {rect:?} {other:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_lesson_that_needs_more_has_the_whole_side() {
        let page = Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 720.0));
        let layout = Layout::new(page, Sheet { controls: false, at: 1.0 }, None);
        let (plane, readout) = (layout.plane.expect("a desk"), layout.readout.expect("a desk"));
        let short = layout.with_lesson(200.0, Focus::Robot);
        assert!(short.plane.is_some() && short.lesson.expect("a card").top() > plane.top());
        let long = layout.with_lesson(380.0, Focus::Robot);
        assert_eq!((long.plane, long.lesson), (None, Some(plane.union(readout))));
    }

    #[test]
    fn a_frame_shows_what_was_asked_for_at_any_size() {
        for (width, height) in
            [(640.0, 360.0), (390.0, 844.0), (1440.0, 900.0), (320.0, 240.0), (300.0, 150.0), (120.0, 60.0)]
        {
            let page = Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height));
            for embed in Embed::ALL {
                let layout = Layout::new(page, Sheet { controls: false, at: 1.0 }, Some(embed));
                let small = height < 240.0;
                assert_eq!(layout.title, None, "{embed:?}");
                if embed == Embed::All {
                    assert!(
                        layout.views.is_some() && layout.view.is_some() && layout.transport.is_some(),
                        "{width}×{height}: {layout:?}"
                    );
                    continue;
                }
                assert!(layout.controls.is_none() && layout.tabbed.is_none() && layout.plane.is_none());
                assert_eq!(layout.plots.is_some(), embed == Embed::Plots);
                assert_eq!(layout.view.is_some(), embed != Embed::Plots);
                assert_eq!(
                    layout.transport.is_some(),
                    embed != Embed::Tuning && !small,
                    "{embed:?} at {width}×{height}"
                );
                let rects = layout.all();
                for (i, rect) in rects.iter().enumerate() {
                    assert!(
                        page.contains_rect(*rect) && !rect.is_negative(),
                        "{embed:?} at {width}×{height}: {rect:?}"
                    );
                    let apart = |other: &Rect| small || !rect.shrink(0.5).intersects(other.shrink(0.5));
                    assert!(rects[..i].iter().all(apart), "{embed:?} at {width}×{height}: {rect:?}");
                }
            }
        }
    }
}
