//! The words that are painted: whole, apart, and set like a text.

use crate::stages::show;
use crate::support::{Page, click, finish, page_of, slide};
use centrode::app::stages::stage::Stage;
use centrode::app::words::help::PARAGRAPHS;
use egui::epaint::TextShape;
use egui::{Rect, Shape, vec2};

/// A small laptop's window.
const SMALL: egui::Vec2 = vec2(1280.0, 720.0);

fn collect<'a>(shape: &'a Shape, clip: Rect, out: &mut Vec<(&'a TextShape, Rect)>) {
    match shape {
        Shape::Text(text) => out.push((text, clip)),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, clip, out)),
        _ => {}
    }
}

/// Every text of the last frame, with where it can be seen.
fn painted(page: &Page) -> Vec<(&TextShape, Rect)> {
    let mut out = Vec::new();
    page.output().shapes.iter().for_each(|clipped| collect(&clipped.shape, clipped.clip_rect, &mut out));
    out
}

/// Where the text that begins with `start` stands; `visible` when all of it can be seen.
fn places(page: &Page, start: &str) -> Vec<(Rect, bool)> {
    let screen = Rect::from_min_size(egui::Pos2::ZERO, SMALL);
    let found = painted(page).into_iter().filter(|(text, _)| text.galley.text().starts_with(start));
    let place = |(text, clip): (&TextShape, Rect)| {
        let rect = text.galley.rect.translate(text.pos.to_vec2());
        (rect, clip.intersect(screen).expand(0.5).contains_rect(rect))
    };
    found.map(place).collect()
}

#[test]
fn the_legend_of_the_plane_is_whole_on_a_small_laptop() {
    let mut page = page_of(SMALL);
    for kind in ["Clamp", "Plane"] {
        click(&mut page, kind);
        let mut entries =
            vec!["cm model", "cc constrained", "cs sensor", "true shape", "if unconstrained", "beam", "estimate"];
        if kind == "Plane" {
            entries.push("contact force");
        }
        let mut rows = Vec::new();
        for entry in entries {
            let found = places(&page, entry);
            assert!(!found.is_empty() && found.iter().all(|(_, visible)| *visible), "{entry}: {found:?}");
            rows.extend(found.into_iter().map(|(rect, _)| rect.shrink(1.0)));
        }
        for (k, row) in rows.iter().enumerate() {
            assert!(rows[..k].iter().all(|other| !other.intersects(*row)), "{row} covers another of {rows:?}");
        }
    }
}

#[test]
fn the_readout_ends_above_the_edge_of_its_card() {
    let mut page = page_of(SMALL);
    for preset in ["bench", "miscalibrated", "touch-2"] {
        let link = format!("preset={preset}&detection.detectors=fcd,jfd,cusum&t=7");
        page.state_mut().as_mut().expect("built").go(&link);
        page.run_steps(2);
        finish(&mut page);
        let said = |start: &str| {
            let found = painted(&page).into_iter().filter(|(text, _)| text.galley.text().starts_with(start));
            found.map(|(text, clip)| (text.galley.rect.translate(text.pos.to_vec2()), clip)).collect::<Vec<_>>()
        };
        assert_eq!(said("CUSUM tells").len(), 1, "{preset}: what CUSUM found is said besides");
        let rows = said("Joint force alarm");
        let [(last, card)] = rows[..] else { panic!("{preset}: {rows:?}") };
        assert!(last.bottom() < card.bottom() - 6.0, "{preset}: {last} at the edge of {card}");
    }
}

#[test]
fn the_names_of_arming_and_detection_stand_apart_in_every_plot() {
    let mut page = page_of(SMALL);
    for armed in [3.0, 4.0, 5.0, 5.5, 6.0, 6.2] {
        slide(&mut page, "Armed from", armed);
        let [arming, detection] = ["armed from", "detected "].map(|start| places(&page, start));
        assert!(!arming.is_empty() && !detection.is_empty(), "{armed} s");
        for (rect, visible) in &detection {
            assert!(*visible && arming.iter().all(|(other, _)| !other.intersects(*rect)), "{armed} s: {rect}");
        }
    }
}

#[test]
fn no_text_has_two_spaces_in_a_row() {
    // Numbers of a table may be set apart by spaces.
    let check = |text: &str| assert!(!text.contains("  ") || !text.contains(char::is_alphabetic), "{text:?}");
    PARAGRAPHS.iter().for_each(|(title, text)| [title, text].into_iter().for_each(|text| check(text)));
    let mut page = page_of(SMALL);
    for stage in Stage::ALL {
        show(&mut page, stage.name());
        let texts = painted(&page);
        assert!(texts.len() > 30, "{stage:?}");
        texts.iter().for_each(|(text, _)| check(text.galley.text()));
    }
}
