//! Where the keyboard is can be seen, whatever has it.

use crate::lesson::learn;
use crate::stages::show;
use crate::support::{DESK, PHONE, Page, build, click, page_of, paused};
use centrode::app::stages::stage::Stage;
use centrode::app::theme::Theme;
use centrode::scene::palette::Shade;
use egui::accesskit::Role;
use egui::{Color32, Key, Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::wgpu::{create_render_state, default_wgpu_setup};
use egui_wgpu::RendererOptions;

/// Frames of this colour that the last frame has painted.
fn frames(page: &Page, accent: Color32) -> Vec<Rect> {
    fn all(shape: &Shape, accent: Color32, found: &mut Vec<Rect>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| all(shape, accent, found)),
            Shape::Rect(rect) if rect.stroke.color == accent && rect.stroke.width >= 2.0 => found.push(rect.rect),
            _ => {}
        }
    }
    let mut found = Vec::new();
    for clipped in &page.output().shapes {
        let mut of = Vec::new();
        all(&clipped.shape, accent, &mut of);
        found.extend(of.into_iter().filter(|rect| clipped.clip_rect.contains_rect(*rect)));
    }
    found
}

/// What has the keyboard: its name, its role and its place.
fn focused(page: &Page) -> Option<(String, Role, Rect)> {
    let node = page.query_by(|node| node.is_focused())?;
    let at = node.accesskit_node();
    Some((at.label().or(at.value()).unwrap_or_default(), at.role(), node.rect()))
}

/// Whether what has the keyboard at a place has a frame of this colour around it.
fn is_framed(page: &Page, place: Rect, accent: Color32) -> bool {
    let screen = page.ctx.content_rect();
    let around = |frame: &Rect| {
        // A widget that is higher than what it is scrolled in is framed where it is seen.
        frame.expand(0.5).contains_rect(place.intersect(screen)) || place.contains_rect(frame.shrink(3.0))
    };
    let near = |frame: &Rect| frame.area() < 4.0 * place.area().max(900.0) && screen.contains_rect(*frame);
    place.intersects(screen) && frames(page, accent).iter().any(|frame| around(frame) && near(frame))
}

/// Walks through a page by Tab and wants a frame around each widget that has the keyboard; gives how many those were.
#[track_caller]
fn walk(page: &mut Page, shade: Shade, what: &str) -> usize {
    let (accent, mut met) = (Theme::new(shade).accent, Vec::new());
    // Until it is where it began, or has left the page.
    while met.len() < 400 {
        page.key_press(Key::Tab);
        page.step();
        let Some((name, role, place)) = focused(page) else { break };
        if met.contains(&(name.clone(), role)) {
            break;
        }
        if !is_framed(page, place, accent) {
            // As the page does for whoever walks through its elements.
            page.get_by(|node| node.is_focused()).scroll_to_me();
            page.run_steps(3);
            let place = focused(page).expect("it has the keyboard").2;
            let framed = is_framed(page, place, accent);
            assert!(framed, "{what}, {shade:?}: no frame around {role:?} {name:?} at {place}");
        }
        met.push((name, role));
    }
    met.len()
}

#[test]
fn every_widget_is_framed_in_every_theme() {
    for (presses, shade) in [(1, Shade::Dark), (2, Shade::Light), (3, Shade::Projector)] {
        for size in [DESK, PHONE] {
            let gpu = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
            let mut page = paused(build(Harness::builder().with_size(size), Some(gpu)));
            for _ in 0..presses {
                page.get_by_label_contains("Theme: ").click();
                page.run_steps(2);
            }
            let least = if size == DESK { 60 } else { 20 };
            let count = walk(&mut page, shade, &format!("{size}"));
            assert!(count > least, "{size}: {count} widgets");
        }
    }
}

#[test]
fn every_widget_of_every_view_is_framed() {
    for stage in Stage::ALL {
        let mut page = page_of(DESK);
        show(&mut page, stage.name());
        let count = walk(&mut page, Shade::Dark, stage.name());
        // Of several segments few groups are in sight at once.
        let least = if stage == Stage::Chain { 30 } else { 40 };
        assert!(count > least, "{stage:?}: {count} widgets");
    }
}

#[test]
fn every_entry_of_menus_windows_and_lessons_is_framed() {
    for opener in ["Share", "Preset", "Learn", "Help"] {
        let mut page = page_of(DESK);
        click(&mut page, opener);
        page.run_steps(4);
        let count = walk(&mut page, Shade::Dark, opener);
        assert!(count > 2, "{opener}: {count} widgets");
    }
    for (lesson, size) in [("Tour", DESK), ("Tour", PHONE), ("Challenges", DESK), ("Challenges", PHONE)] {
        let mut page = page_of(size);
        learn(&mut page, lesson);
        let count = walk(&mut page, Shade::Dark, lesson);
        assert!(count > 8, "{lesson}: {count} widgets");
    }
}
