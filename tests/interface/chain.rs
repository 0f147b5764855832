//! Segments in series on the page, headless: choosing one, moving it, contacts that come and go, links and files.

use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, click, finish, fits, page_of, slide, texts};
use centrode::app::link::Effect;
use centrode::app::stages::stage::Stage;
use centrode_core::detect::chain::ChainMethod;
use centrode_core::record::log::write;
use centrode_core::scenario::ChainPlan;
use centrode_core::scenario::chain::{Stands, Tracked};
use centrode_core::scenario::link::Link;
use centrode_core::scenario::preset::{CHAINS, find_chain};
use centrode_core::study::chain::ChainRun;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

/// High enough that no group of controls is scrolled out of sight.
const TALL: egui::Vec2 = egui::vec2(1440.0, 2600.0);

/// A page that shows a preset with several segments.
fn chained(size: egui::Vec2, preset: &str) -> Page {
    let mut page = page_of(size);
    go(&mut page, &format!("view=chain&chain={preset}&t=8"));
    finish(&mut page);
    page
}

fn go(page: &mut Page, link: &str) {
    page.state_mut().as_mut().expect("built").go(link);
    page.run_steps(3);
}

/// What the page's text of several segments says.
fn scenario(page: &Page) -> centrode_core::scenario::ChainScenario {
    app(page).state().chain.draft.scenario().expect("it can be read")
}

fn run(preset: &str) -> ChainRun {
    let scenario = find_chain(preset).expect("a preset").chain(&[]).expect("possible");
    ChainRun::new(ChainPlan::new(&scenario).expect("a shape"))
}

#[test]
fn every_preset_is_shown_on_every_size_of_page() {
    for size in [TABLET, PHONE, LOW] {
        fits(&chained(size, "three-segments"), size, "opened");
    }
    for preset in CHAINS {
        // To place the contacts takes longer than all else: it is done once.
        let mut page = chained(DESK, preset.name);
        for size in [DESK, TABLET, PHONE, LOW] {
            page.set_size(size);
            page.run_steps(3);
            assert_eq!(app(&page).state().stage, Stage::Chain);
            fits(&page, size, preset.name);
            assert!(app(&page).notice().is_none(), "{}", preset.name);
        }
    }
}

#[test]
fn the_page_tells_what_the_command_tells() {
    for preset in ["two-contacts", "reopened", "buckling"] {
        let page = chained(DESK, preset);
        let run = run(preset);
        let found = run.judged.contacts(run.judged.teller().expect("it judges"), &[0.5]);
        for (number, contact) in found.iter().enumerate() {
            let said = texts(&page, &format!("Contact {}: alarm at {:.3}\u{a0}s", number + 1, contact.alarm));
            assert_eq!(said.len(), 1, "{preset}: {:?}", texts(&page, "Contact "));
            if contact.alarm < 7.0
                && let Some(estimate) = contact.estimates.first().filter(|one| one.nothing < 0.5)
            {
                assert!(said[0].contains(&format!("segment {}", estimate.segment + 1)), "{said:?}");
            }
        }
    }
}

#[test]
fn a_segment_is_chosen_and_its_motion_set() {
    let mut page = chained(TALL, "three-segments");
    let before = scenario(&page);
    page.get_all_by_role_and_label(Role::RadioButton, "Segment 3").next().expect("a segment").click();
    page.run_steps(2);
    assert_eq!(app(&page).state().chain.segment, 2);
    slide(&mut page, "θL at the end", 60.0);
    slide(&mut page, "Direction δ at the end", 45.0);
    let after = scenario(&page);
    assert!((after.segments[2].motion().theta_end.to_degrees() - 60.0).abs() < 1e-9);
    assert!((after.segments[2].delta_end.to_degrees() - 45.0).abs() < 1e-9);
    assert_eq!(after.segments[..2], before.segments[..2], "the others stay");
    // What is of all segments is set for all.
    slide(&mut page, "Position noise", 0.2);
    let noisy = scenario(&page);
    assert!(noisy.segments.iter().all(|one| (one.alone.scenario().tracker.position_noise - 2e-4).abs() < 1e-12));
    click(&mut page, "Reset all");
    assert_eq!(scenario(&page), before);
}

#[test]
fn contacts_are_added_moved_and_removed() {
    let mut page = chained(TALL, "three-segments");
    let before = scenario(&page).contacts.len();
    click(&mut page, "Add a contact");
    assert_eq!(scenario(&page).contacts.len(), before + 1);
    assert_eq!(app(&page).state().chain.contact, before, "the new one is looked at");
    slide(&mut page, "Place on the segment", 12.0);
    slide(&mut page, "Stands from", 6.5);
    slide(&mut page, "Tilt", 30.0);
    let contact = scenario(&page).contacts[before].clone();
    assert!((contact.at - 0.012).abs() < 1e-9);
    let Stands::From { time, tilt } = contact.stands else { panic!("{contact:?}") };
    assert!((time - 6.5).abs() < 1e-9 && (tilt.to_degrees() - 30.0).abs() < 1e-9);
    click(&mut page, &format!("Remove contact {}", before + 1));
    assert_eq!(scenario(&page).contacts.len(), before);
    for left in (0..before).rev() {
        click(&mut page, &format!("Remove contact {}", left + 1));
    }
    assert!(!texts(&page, "Nothing touches the robot.").is_empty());
    finish(&mut page);
    assert_eq!(scenario(&page).contacts, []);
}

#[test]
fn what_a_preset_says_in_other_words_comes_back_with_its_reset() {
    for (preset, label) in [("two-contacts", "Place on the segment"), ("buckling", "Stands from")] {
        let mut page = chained(TALL, preset);
        let before = scenario(&page);
        slide(&mut page, label, 7.0);
        assert_ne!(scenario(&page), before, "{label}");
        click(&mut page, &format!("Reset {label}"));
        assert_eq!(scenario(&page), before, "{label}");
    }
}

#[test]
fn a_shorter_robot_is_looked_at_where_it_has_a_segment() {
    let mut page = chained(TALL, "three-segments");
    page.get_all_by_role_and_label(Role::RadioButton, "Segment 3").next().expect("a segment").click();
    page.run_steps(2);
    let shorter = find_chain("three-segments").expect("shipped").toml.split("[[segment]]").collect::<Vec<_>>();
    let contact = "[[contact]]\nsegment = 2\ndisk = 2\ntime = 5.8\n";
    let text = format!("{}[[segment]]{}[[segment]]{}{contact}", shorter[0], shorter[1], shorter[2]);
    page.state_mut().as_mut().expect("built").opened("shorter.toml", Ok(text.into_bytes()));
    page.run_steps(3);
    assert_eq!(scenario(&page).segments.len(), 2, "{:?}", app(&page).notice());
    slide(&mut page, "θL at the end", 60.0);
    assert!((scenario(&page).segments[1].motion().theta_end.to_degrees() - 60.0).abs() < 1e-9);
}

#[test]
fn a_threshold_that_is_switched_off_comes_back_as_it_was() {
    let mut page = chained(TALL, "three-segments");
    slide(&mut page, "h (CUSUM)", 33.0);
    let set = scenario(&page);
    click(&mut page, "h (CUSUM) on");
    assert_ne!(scenario(&page), set);
    click(&mut page, "h (CUSUM) on");
    assert_eq!(scenario(&page), set);
}

#[test]
fn a_clamp_under_moving_segments_is_refused_and_says_why() {
    let mut page = chained(TALL, "three-segments");
    let before = scenario(&page);
    let moving = before.contacts[0].segment > 0;
    assert!(moving, "the preset's contact is above segments that move");
    click(&mut page, "Clamp");
    assert_eq!(scenario(&page), before);
    assert!(!texts(&page, "while the segments below it rest").is_empty());
}

#[test]
fn nonsense_is_told_beside_its_field_and_changes_nothing() {
    let mut page = chained(TALL, "two-contacts");
    let before = scenario(&page);
    for (field, text) in
        [("Place on the segment value", "abc"), ("Stands from value", "-3"), ("Place on the segment value", "99 m")]
    {
        page.get_by_label(field).focus();
        page.run_steps(1);
        page.get_by_label(field).type_text(text);
        page.run_steps(1);
        page.key_press(egui::Key::Enter);
        page.run_steps(2);
        assert_eq!(scenario(&page), before, "{field}: {text}");
        assert!(!texts(&page, "Nothing was changed").is_empty(), "{field}: {text}");
    }
}

#[test]
fn detectors_and_trackers_are_switched() {
    let mut page = chained(TALL, "two-contacts");
    click(&mut page, "Screw motion");
    assert_eq!(scenario(&page).smd, None);
    click(&mut page, "GLR");
    let judged = centrode::app::chain::apply::judging(&scenario(&page));
    assert!(judged.iter().any(|method| method.key() == "glr") && !judged.contains(&ChainMethod::Smd));
    click(&mut page, "Last end disk");
    assert_eq!(scenario(&page).tracked, Tracked::Tip);
    finish(&mut page);
}

#[test]
fn a_link_holds_all_that_is_set() {
    let mut page = chained(TALL, "two-contacts");
    slide(&mut page, "θL at the end", 50.0);
    click(&mut page, "Add a contact");
    let effects = page.state_mut().as_mut().expect("built").take_effects();
    let fragment = effects
        .into_iter()
        .rev()
        .find_map(|effect| match effect {
            Effect::Address { fragment, .. } => Some(fragment),
            _ => None,
        })
        .expect("the address is told");
    let (link, broken) = Link::read(&fragment);
    assert!(broken.is_empty(), "{broken:?}");
    let mut other = page_of(DESK);
    go(&mut other, &fragment);
    assert_eq!(scenario(&other), scenario(&page));
    assert!(link.command().starts_with("centrode run --preset two-contacts --set "), "{}", link.command());
    // What is broken in a link is told, and what is left is shown.
    go(&mut other, "chain=two-contacts&chain.segment[2].length=-1&chain.segment[1].motion.theta_end=1");
    let notice = app(&other).notice().expect("it is told");
    assert!(notice.details.contains("segment[2].length"), "{}", notice.details);
    assert!((scenario(&other).segments[0].motion().theta_end - 1.0).abs() < 1e-12);
}

#[test]
fn a_file_with_several_segments_opens_and_a_broken_one_is_told() {
    let mut page = page_of(DESK);
    let text = find_chain("oblique").expect("a preset").toml.as_bytes().to_vec();
    page.state_mut().as_mut().expect("built").opened("mine.toml", Ok(text));
    page.run_steps(3);
    assert_eq!((app(&page).state().stage, app(&page).state().chain.preset.as_str()), (Stage::Chain, "oblique"));
    let broken = b"[[segment]]\nlength = 0.03\n[[contact]]\nsegment = 7\nat = 0.01\ntime = 4\n".to_vec();
    page.state_mut().as_mut().expect("built").opened("broken.toml", Ok(broken));
    page.run_steps(3);
    let notice = app(&page).notice().expect("it is told");
    assert!(notice.details.contains("ine 4") && notice.details.contains("segment"), "{}", notice.details);
    assert_eq!(app(&page).state().chain.preset, "oblique", "what was shown stays");
}

#[test]
fn plots_show_all_segments_or_everything_of_one() {
    let mut page = chained(DESK, "two-contacts");
    let figures = |page: &Page| texts(page, "Plot of segment").len();
    assert_eq!(figures(&page), 3);
    page.get_by_role_and_label(Role::RadioButton, "Screw axis angle").click();
    page.run_steps(2);
    assert_eq!(texts(&page, "screw axis angle over time").len(), 3);
    page.get_all_by_role_and_label(Role::RadioButton, "Segment 2").last().expect("a choice").click();
    page.run_steps(2);
    assert!(figures(&page) >= 4, "{:?}", texts(&page, "Plot of segment"));
    assert!(texts(&page, "Plot of segment 3").is_empty());
}

/// What the rig would have recorded of a preset, without what is true.
fn recorded(preset: &str) -> Vec<u8> {
    let recording = run(preset).recording;
    let mut text = write::chain_csv_header(&recording);
    (0..recording.times.len()).for_each(|at| write::chain_csv_row(&mut text, &recording, at));
    text.into_bytes()
}

#[test]
fn a_log_of_several_trackers_takes_the_place_of_the_simulation() {
    let mut page = chained(DESK, "two-contacts");
    let simulated = told(&page);
    assert_eq!(simulated.len(), 2, "{simulated:?}");
    page.state_mut().as_mut().expect("built").opened("rig.csv", Ok(recorded("two-contacts")));
    page.run_steps(3);
    finish(&mut page);
    assert!(app(&page).notice().is_none(), "{:?}", app(&page).notice());
    fits(&page, DESK, "a log");
    assert_eq!(texts(&page, "Log rig").len(), 1);
    assert!(!texts(&page, "A log does not say whether anything touched").is_empty());
    // The same readings give the same alarms.
    assert_eq!(told(&page), simulated);
    assert_eq!(crate::logs::copied_command(&mut page), "centrode analyze rig.csv --preset two-contacts");
    page.run_steps(2);
    click(&mut page, "Report");
    assert!(app(&page).notice().is_some_and(|notice| notice.details.contains("Segment 3")));
    page.run_steps(3);
    click(&mut page, "Go on");
    page.state_mut().as_mut().expect("built").go("view=chain&chain=two-contacts&t=4");
    page.run_steps(3);
    // What is set judges it anew: a higher threshold alarms later.
    page.state_mut().as_mut().expect("built").go("view=chain&chain=two-contacts&chain.detection.cusum=60&t=4");
    page.run_steps(3);
    finish(&mut page);
    assert_ne!(told(&page), simulated);
    page.state_mut().as_mut().expect("built").go("view=chain&chain=two-contacts&t=4");
    page.run_steps(3);
    click(&mut page, "Close log");
    finish(&mut page);
    assert!(texts(&page, "Log rig").is_empty());
    assert_eq!(told(&page), simulated);
}

#[test]
fn a_log_that_cannot_be_read_says_why_and_changes_nothing() {
    let mut page = chained(DESK, "two-contacts");
    let before = told(&page);
    page.state_mut().as_mut().expect("built").opened("one.csv", Ok(b"time,x_1\n0,soon\n".to_vec()));
    page.run_steps(3);
    let why = app(&page).notice().map(|notice| (notice.title.clone(), notice.text.clone())).expect("it is told");
    assert_eq!(why.0, "one.csv was not read");
    assert!(why.1.len() > 20, "{}", why.1);
    assert_eq!(told(&page), before);
}

/// The contacts that are told, with the time of each alarm.
fn told(page: &Page) -> Vec<String> {
    let all = texts(page, "alarm at");
    all.iter()
        .filter_map(|said| Some(said.split_once(',')?.0.to_owned()))
        .filter(|said| said.starts_with("Contact"))
        .collect()
}
