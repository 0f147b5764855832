//! The presets as a gallery, headless.

use crate::support::{DESK, LOW, PHONE, TABLET, app, click, finish, fits, page_of};
use centrode_core::scenario::preset::{CHAINS, PRESETS};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};

#[test]
fn every_preset_is_there_with_its_sentence_and_chosen_by_a_click() {
    for size in [DESK, PHONE, LOW, TABLET] {
        let mut page = page_of(size);
        click(&mut page, "Preset");
        finish(&mut page);
        fits(&page, size, "gallery");
        let options: Vec<_> = page.query_all_by_role(Role::ListBoxOption).collect();
        assert_eq!(options.len(), PRESETS.len() + CHAINS.len(), "{size}");
        for preset in PRESETS.iter().chain(CHAINS) {
            let told = |text: Option<String>| text.is_some_and(|text| text == preset.summary());
            assert!(options.iter().any(|option| told(option.accesskit_node().description())), "{}", preset.name);
        }
        for group in ["The paper", "Noise", "Touch", "Detection", "Odd", "Several segments"] {
            page.get_by_role_and_label(Role::Heading, group);
        }
        page.get_by_role_and_label(Role::ListBoxOption, "Disk 1").click();
        page.run_steps(3);
        assert_eq!(app(&page).state().preset, "disk-1", "{size}");
        assert!(page.query_by_role(Role::ListBoxOption).is_none(), "it closes");
    }
}

#[test]
fn a_preset_is_chosen_by_the_keyboard() {
    let mut page = page_of(DESK);
    page.get_by_label("Preset").focus();
    page.run_steps(2);
    page.key_press(Key::Enter);
    page.run_steps(3);
    page.get_by_role_and_label(Role::ListBoxOption, "Gimbal lock").focus();
    page.run_steps(10);
    let place = page.get_by_role_and_label(Role::ListBoxOption, "Gimbal lock").rect();
    assert!(place.bottom() < DESK.y, "it is scrolled to: {place}");
    page.key_press(Key::Enter);
    page.run_steps(3);
    assert_eq!(app(&page).state().preset, "gimbal-lock");
}
