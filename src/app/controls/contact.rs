//! Settings that are not always a number: where the contact is, and when it starts.

use crate::app::controls::quantity::{number, parse, shorten};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::keys::Quantity::{Angle, Count, Length};
use centrode_core::scenario::{Place, Start};

/// Where the contact is, when that is no disk's number.
pub fn show_place(scenario: &Scenario) -> Option<(String, &'static str)> {
    match scenario.contact.place {
        Place::Nowhere => Some(("none".into(), "")),
        Place::Disk(_) => None,
        Place::ArcLength(s) => Some((number(Length.shown(s), 1), Length.unit())),
    }
}

/// Reads where the contact is: none, a disk, or an arc length.
pub fn enter_place(scenario: &mut Scenario, text: &str) -> Option<Result<(), String>> {
    let text = text.trim();
    let refused = || {
        Err(format!(
            "there is no place called “{}”: type none, a disk's number, or an arc length such as 18 mm",
            shorten(text)
        ))
    };
    if matches!(text.to_lowercase().as_str(), "none" | "no" | "off" | "free") {
        scenario.contact.place = Place::Nowhere;
        return Some(Ok(()));
    }
    // A bare number is a disk; an arc length wears its unit, or is a field that shows one already.
    let along = matches!(scenario.contact.place, Place::ArcLength(_));
    let disk = parse(Count, text).ok();
    match (disk, parse(Length, text)) {
        (Some(disk), _) if disk.fract() == 0.0 && disk >= 0.0 && !along => {
            scenario.contact.place = Place::disk(disk as u64)
        }
        (Some(_), Ok(shown)) if along => scenario.contact.place = Place::ArcLength(Length.si(shown)),
        (None, Ok(shown)) => scenario.contact.place = Place::ArcLength(Length.si(shown)),
        _ => return Some(refused()),
    }
    Some(Ok(()))
}

/// Name of the contact's start, when that is a bend.
pub fn label_start(scenario: &Scenario) -> Option<&'static str> {
    matches!(scenario.contact.start, Start::Bend(_)).then_some("Contact bend")
}

/// When the contact starts, when that is a bend.
pub fn show_start(scenario: &Scenario) -> Option<(String, &'static str)> {
    match scenario.contact.start {
        Start::Time(_) => None,
        Start::Bend(bend) => Some((number(Angle.shown(bend), 1), Angle.unit())),
    }
}

/// Reads when the contact starts, when that is a bend.
pub fn enter_start(scenario: &mut Scenario, text: &str) -> Option<Result<(), String>> {
    // A bare number is of the kind that the field shows.
    let bare = parse(Count, text).is_ok();
    let bend = matches!(scenario.contact.start, Start::Bend(_));
    let angle = parse(Angle, text).ok().filter(|_| bend || !bare)?;
    scenario.contact.start = Start::Bend(Angle.si(angle));
    Some(Ok(()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::controls::table::control;
    use crate::app::memo::check;

    #[test]
    fn places_can_be_typed() {
        let disk = control("contact.disk").expect("a row");
        let mut scenario = Scenario::default();
        for (text, place) in [
            ("3", Place::disk(3)),
            ("none", Place::Nowhere),
            ("1", Place::disk(1)),
            ("18 mm", Place::ArcLength(0.018)),
            ("17", Place::ArcLength(0.017)),
            ("None", Place::Nowhere),
            ("0", Place::Nowhere),
        ] {
            disk.enter(&mut scenario, text).expect(text);
            assert_eq!(scenario.contact.place, place, "{text}");
            check(&scenario).expect(text);
        }
        for text in ["1.5", "-1", "two", "nan", "3 s"] {
            disk.enter(&mut scenario, text).expect_err(text);
        }
        // As many disks as asked for; whether they exist is for the scenario's check to say.
        disk.enter(&mut scenario, "4").expect("a number");
        assert!(check(&scenario).expect_err("no disk 4").to_string().contains("contact.disk"));
    }

    #[test]
    fn starts_can_be_typed() {
        let start = control("contact.time").expect("a row");
        let mut scenario = Scenario::default();
        for (text, shown) in
            [("5.5", "5.50 s"), ("5600 ms", "5.60 s"), ("45°", "45.0 °"), ("30", "30.0 °"), ("5.8 s", "5.80 s")]
        {
            start.enter(&mut scenario, text).expect(text);
            let (number, unit) = start.text(&scenario);
            assert_eq!(format!("{number} {unit}"), shown);
            assert_eq!(start.label(&scenario), if unit == "°" { "Contact bend" } else { "Contact time" });
        }
        start.enter(&mut scenario, "soon").expect_err("words");
    }
}
