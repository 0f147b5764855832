//! What leaves the program as a file: how it is called, and how its caption says what made it.

use crate::chart::Chart;
use crate::chart::notation::plain;
use crate::scenario::link::{Link, Page};
use crate::scenario::{Scenario, preset};

/// The longest part of a file's name, characters.
const LONGEST: usize = 60;

/// Name of a file that holds `what` (such as `map`) made of something called `of` (such as a preset): letters, digits, dashes and
/// underscores that every file system takes.
///
/// ```
/// use centrode_core::study::export::name;
///
/// assert_eq!(name("map", "bench", "csv"), "map-bench.csv");
/// assert_eq!(name("run", "my rig/07: test", "csv"), "run-my-rig-07-test.csv");
/// assert_eq!(name("figure-4", "figure-4", "svg"), "figure-4.svg");
/// ```
#[must_use]
pub fn name(what: &str, of: &str, extension: &str) -> String {
    let (what, of) = (safe(what), safe(of));
    let parts: Vec<&str> = [what.as_str(), of.as_str()].into_iter().filter(|part| !part.is_empty()).collect();
    let stem = match parts[..] {
        [] => "centrode".to_owned(),
        [one, other] if one == other => one.to_owned(),
        _ => parts.join("-"),
    };
    format!("{stem}.{extension}")
}

/// A text as part of a file's name.
fn safe(text: &str) -> String {
    let mut safe = String::new();
    for character in text.chars() {
        match character {
            letter if letter.is_ascii_alphanumeric() || letter == '_' => safe.push(letter),
            _ if safe.is_empty() || safe.ends_with('-') => {}
            _ => safe.push('-'),
        }
    }
    safe.truncate(LONGEST);
    safe.trim_end_matches('-').into()
}

/// A line that says what made something: `Centrode #` and the link to the scenario, with what a page shows of it. It does not
/// depend on how the scenario was come by: a figure and Table II start from their own preset, all else from the nearest one.
///
/// ```
/// use centrode_core::scenario::link::Page;
/// use centrode_core::scenario::preset::find;
/// use centrode_core::study::export::origin;
///
/// let scenario = find("disk-3")?.scenario()?;
/// assert_eq!(origin(&scenario, Page::of("map")), "Centrode #preset=disk-3&view=map");
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[must_use]
pub fn origin(scenario: &Scenario, page: Page) -> String {
    let own = match page.view {
        "table2" => "bench",
        view => view,
    };
    let link = match preset::find(own) {
        Ok(preset) => Link::new(preset, scenario, page),
        Err(_) => Link::nearest(scenario, page),
    };
    match link.map_err(|refused| refused.to_string()).and_then(|link| link.fragment().map_err(|long| long.to_string()))
    {
        Ok(fragment) => format!("Centrode #{fragment}"),
        Err(why) => format!("Centrode, without a link: {why}"),
    }
}

/// A chart whose caption ends in its [`origin`].
#[must_use]
pub fn signed(mut chart: Chart, scenario: &Scenario, page: Page) -> Chart {
    if !chart.caption.is_empty() {
        chart.caption.push('\n');
    }
    chart.caption.push_str(&plain(&origin(scenario, page)));
    chart
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::notation::runs;
    use crate::scenario::link::page::VIEWS;
    use crate::study::figure::Number;

    #[test]
    fn names_keep_to_what_every_file_system_takes() {
        for (of, expected) in [
            ("bench", "run-bench.csv"),
            ("", "run.csv"),
            ("../../etc/passwd", "run-etc-passwd.csv"),
            ("a\u{0}b\nc", "run-a-b-c.csv"),
            ("<>:\"/\\|?*", "run.csv"),
            ("Größe 2.5", "run-Gr-e-2-5.csv"),
            ("min_speed", "run-min_speed.csv"),
        ] {
            assert_eq!(name("run", of, "csv"), expected, "{of:?}");
        }
        let long = name("run", &"x".repeat(400), "csv");
        assert_eq!(long.len(), "run-.csv".len() + LONGEST);
        assert_eq!(name("?", "", "svg"), "centrode.svg");
    }

    #[test]
    fn a_caption_ends_in_a_link_that_is_read_back() {
        let mut scenario = Scenario::default();
        (scenario.detection.armed_from, scenario.seed) = (4.5, 7);
        for view in VIEWS {
            let chart = signed(Chart { caption: "Made.".into(), ..Chart::default() }, &scenario, Page::of(view));
            let (made, line) = chart.caption.split_once('\n').expect("a line of its own");
            assert_eq!(made, "Made.");
            let shown: String = runs(line).into_iter().map(|run| run.text).collect();
            let (link, broken) = Link::read(shown.strip_prefix("Centrode ").expect("a mark"));
            assert!(broken.is_empty() && *link.scenario() == scenario && link.page.view == *view, "{shown}");
            let own = Number::ALL.into_iter().find(|number| number.preset() == *view).map(Number::preset);
            let own = own.or((*view == "table2").then_some("bench"));
            assert!(own.is_none_or(|own| link.preset().name == own), "{shown}");
        }
    }

    #[test]
    fn a_scenario_too_long_for_a_link_says_so() {
        let mut scenario = Scenario::default();
        scenario.robot.disks = (1..=2000).map(|k| f64::from(k) * 1.234_567e-5).collect();
        let line = origin(&scenario, Page::default());
        assert!(line.starts_with("Centrode, without a link: ") && !line.contains('#'), "{line}");
    }
}
