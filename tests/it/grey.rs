//! Nothing in a chart is told by colour alone: without colours, curves still differ in their dashes, their width or their marks.

use crate::figure::figure;
use centrode_core::chart::{Panel, Role, Series, Style, Vertical};
use centrode_core::detect::Method;
use centrode_core::run::simulate;
use centrode_core::scenario::preset;
use centrode_core::scenario::{Detectors, Scenario};
use centrode_core::study::figure::Number;
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::{compare, course, tuning};

/// Curves and rows of marks that are named, for what has no name lies on a curve that has one.
fn named(panel: &Panel) -> Vec<&Series> {
    panel.series.iter().filter(|series| !series.name.is_empty()).collect()
}

/// A family is told apart by its shades, which an even colour map makes lighter from first to last.
fn are_kin(one: &Series, other: &Series) -> bool {
    matches!((one.role, other.role), (Role::Member(a), Role::Member(b)) if (a - b).abs() > 0.04)
}

#[track_caller]
fn is_plain_without_colours(panel: &Panel) {
    let all = named(panel);
    for (k, one) in all.iter().enumerate() {
        for other in &all[..k] {
            let same = one.style == other.style && one.name != other.name;
            assert!(
                !same || are_kin(one, other),
                "{}: {} and {} look alike: {:?}",
                panel.title,
                one.name,
                other.name,
                one.style
            );
        }
    }
    for (k, one) in panel.verticals.iter().enumerate() {
        for other in &panel.verticals[..k] {
            let same = Vertical::style(one.role) == Vertical::style(other.role) && one.name != other.name;
            assert!(!same, "{}: {} and {} look alike", panel.title, one.name, other.name);
        }
    }
}

fn shipped(name: &str) -> Scenario {
    preset::find(name).expect("a preset").scenario().expect("valid")
}

#[test]
fn figures() {
    for number in Number::ALL {
        figure(number).panels.iter().for_each(is_plain_without_colours);
    }
}

#[test]
fn plots_over_time() {
    let mut scenario = shipped("bench");
    scenario.detection.detectors = Detectors::of(Method::ALL);
    let run = simulate(&scenario).expect("a run");
    for methods in course::plots(run.judged.settings.thresholds.detectors) {
        is_plain_without_colours(&course::statistic(&run, &methods, 1.0));
    }
    is_plain_without_colours(&course::angle(&run));
}

#[test]
fn detectors_and_rules() {
    let looks: Vec<Style> =
        Method::ALL.iter().map(|method| compare::chart::look(*method).1).chain([Style::Heavy]).collect();
    let rules: Vec<Style> = Rule::ALL.iter().map(|rule| tuning::chart::look(*rule).1).collect();
    for styles in [looks, rules] {
        for (k, style) in styles.iter().enumerate() {
            assert!(!styles[..k].contains(style), "{style:?} twice in {styles:?}");
        }
    }
}
