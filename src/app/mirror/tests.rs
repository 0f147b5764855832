use super::*;
use crate::app::{App, Host};
use egui::{Rect, Vec2, vec2};

/// What is asked, given what there was before.
type Ask<'a> = &'a dyn Fn(&Mirror) -> Vec<egui::Event>;

/// A page of a size after a few frames, with what is asked of it before each of them.
fn mirrored(size: Vec2, asks: &[Ask<'_>]) -> Mirror {
    let ctx = egui::Context::default();
    ctx.enable_accesskit();
    let mut app: Option<App> = None;
    let mut last = Mirror { focus: String::new(), elements: Vec::new() };
    let nothing: Ask<'_> = &|_| Vec::new();
    // A menu takes a frame to be measured, and one to be shown.
    let quiet = [nothing; 3];
    for (k, ask) in quiet.iter().chain(asks.iter().flat_map(|ask| [ask, &nothing, &nothing, &nothing])).enumerate() {
        let raw = egui::RawInput {
            screen_rect: Some(Rect::from_min_size(egui::Pos2::ZERO, size)),
            time: Some(0.1 * k as f64),
            focused: true,
            events: ask(&last),
            ..Default::default()
        };
        let mut output =
            ctx.run_ui(raw, |ui| app.get_or_insert_with(|| App::new(ui.ctx(), None, Host::default())).ui(ui));
        // Nothing is painted: its textures are dropped.
        output.textures_delta.clear();
        last = Mirror::of(&output.platform_output.accesskit_update.expect("a tree"));
    }
    last
}

fn request(mirror: &Mirror, kind: Kind, name: &str, action: Action) -> egui::Event {
    egui::Event::AccessKitActionRequest(egui::accesskit::ActionRequest {
        action,
        target_tree: egui::accesskit::TreeId::ROOT,
        target_node: id(&find(mirror, kind, name).id).expect("a number"),
        data: None,
    })
}

#[track_caller]
fn find<'a>(mirror: &'a Mirror, kind: Kind, name: &str) -> &'a Element {
    let is = |element: &&Element| element.kind == kind && element.name == name;
    mirror.elements.iter().find(is).unwrap_or_else(|| panic!("no {kind:?} named {name:?}"))
}

fn parent<'a>(mirror: &'a Mirror, element: &Element) -> Option<&'a Element> {
    mirror.elements.iter().find(|other| Some(&other.id) == element.within.as_ref())
}

#[test]
fn every_part_of_the_page_is_there_in_reading_order() {
    let mirror = mirrored(vec2(1440.0, 900.0), &[]);
    let regions: Vec<&str> =
        mirror.elements.iter().filter(|e| e.kind == Kind::Region).map(|e| e.name.as_str()).collect();
    // The 3D view needs a GPU.
    assert_eq!(
        regions,
        ["Experiment", "Views", "Tools", "Controls", "Playback", "Bending plane", "Result", "Plots", "Symbols"]
    );
    let digits = |name| find(&mirror, Kind::Field, name).digits;
    assert_eq!((digits("ξ2 (centrode) value"), digits("Bending direction δ value")), (true, false));
    let slider = find(&mirror, Kind::Slider, "Contact disk");
    assert_eq!((slider.min, slider.max, slider.step), (Some(0.0), slider.max, Some(1.0)));
    assert!(slider.focusable && !slider.disabled);
    assert_eq!(parent(&mirror, slider).map(|part| part.name.as_str()), Some("Contact"));
    assert!(find(&mirror, Kind::Slider, "Time").value.as_ref().is_some_and(|value| value.ends_with(" s")));
    assert_eq!(find(&mirror, Kind::Button, "Contact").open, Some(true));
    let tab = find(&mirror, Kind::Tab, "Robot");
    assert_eq!((tab.on, parent(&mirror, tab).map(|tabs| tabs.kind)), (Some(true), Some(Kind::Tabs)));
    for element in &mirror.elements {
        assert!(!element.name.is_empty() || element.kind == Kind::Dialog, "{element:?} has no name");
    }
}

#[test]
fn elements_are_unique_and_come_after_what_they_are_in() {
    for size in [vec2(1440.0, 900.0), vec2(390.0, 844.0)] {
        let mirror = mirrored(size, &[]);
        for (k, element) in mirror.elements.iter().enumerate() {
            let before = &mirror.elements[..k];
            assert!(before.iter().all(|other| other.id != element.id), "{element:?} twice");
            let inside = element.within.as_ref().is_none_or(|within| before.iter().any(|other| other.id == *within));
            assert!(inside, "{element:?}");
        }
    }
}

#[test]
fn a_menu_opened_by_assistive_technology_takes_the_keyboard_and_gives_it_back() {
    let open = |mirror: &Mirror| {
        vec![
            request(mirror, Kind::Button, "Share", Action::Focus),
            request(mirror, Kind::Button, "Share", Action::Click),
        ]
    };
    let mirror = mirrored(vec2(1440.0, 900.0), &[&open]);
    let item = find(&mirror, Kind::Item, "Copy link");
    assert_eq!(parent(&mirror, item).map(|menu| menu.kind), Some(Kind::Menu));
    assert_eq!(mirror.focus, item.id, "the first entry has the keyboard");

    let press = |key| egui::Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: egui::Modifiers::NONE,
    };
    let down = |_: &Mirror| vec![press(egui::Key::ArrowDown)];
    let mirror = mirrored(vec2(1440.0, 900.0), &[&open, &down]);
    assert_eq!(mirror.focus, find(&mirror, Kind::Item, "Copy command").id);

    let escape = |_: &Mirror| vec![press(egui::Key::Escape)];
    let mirror = mirrored(vec2(1440.0, 900.0), &[&open, &down, &escape]);
    assert!(mirror.elements.iter().all(|element| element.kind != Kind::Item));
    assert_eq!(mirror.focus, find(&mirror, Kind::Button, "Share").id);
}

#[test]
fn presets_are_a_list_and_the_help_is_a_dialog() {
    let presets = |mirror: &Mirror| vec![request(mirror, Kind::Opener, "Preset", Action::Click)];
    let mirror = mirrored(vec2(1440.0, 900.0), &[&presets]);
    let chosen = mirror.elements.iter().find(|e| e.kind == Kind::Choice && e.on == Some(true)).expect("a choice");
    assert_eq!(parent(&mirror, chosen).map(|list| list.kind), Some(Kind::List));

    let help = |mirror: &Mirror| {
        vec![request(mirror, Kind::Button, "Help", Action::Focus), request(mirror, Kind::Button, "Help", Action::Click)]
    };
    let mirror = mirrored(vec2(1440.0, 900.0), &[&help]);
    let close = find(&mirror, Kind::Button, "Close help");
    assert_eq!(parent(&mirror, close).map(|dialog| dialog.kind), Some(Kind::Dialog));
    assert_eq!(mirror.focus, close.id);
    assert!(!find(&mirror, Kind::Heading, "What happens on contact").focusable);
}
