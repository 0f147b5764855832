//! Links: what is written is read back, what is broken is told, and whatever is read can be run.

use centrode_core::scenario::chain::{ChainDraft, Change};
use centrode_core::scenario::keys::{KEYS, Usual};
use centrode_core::scenario::link::page::{CHAIN, CHALLENGES, MAX_REPEATS, RULES, THEMES, TOUR_STEPS, VIEWS};
use centrode_core::scenario::link::{Broken, ChainLink, Link, LinkError, MAX_LINK, PAGE_KEYS, Page, Why};
use centrode_core::scenario::preset::{PRESETS, find, find_chain};
use centrode_core::scenario::text::Draft;
use centrode_core::scenario::{Detectors, Method, Plan, Scenario};
use centrode_core::study::tuning::{self, watch::Rule};
use proptest::prelude::*;

fn whole(text: &str) -> Link {
    let (link, broken) = Link::read(text);
    assert!(broken.is_empty(), "{text}: {broken:?}");
    link
}

fn with(preset: &str, sets: &[&str]) -> Scenario {
    let mut draft = find(preset).and_then(|preset| preset.draft()).expect(preset);
    sets.iter().for_each(|text| draft.set(text).expect(text));
    draft.finish().expect("possible")
}

#[test]
fn a_link_says_what_differs_from_its_preset() {
    let bench = find("bench").expect("a preset");
    let scenario = with("bench", &["contact.disk=3", "detection.xi2=0.005"]);
    let page = Page { view: "tuning", time: Some(6.27), ..Page::default() };
    let link = Link::new(bench, &scenario, page).expect("possible");
    let text = "preset=bench&contact.disk=3&detection.xi2=0.005&view=tuning&t=6.27";
    assert_eq!(link.fragment().as_deref(), Ok(text));
    assert_eq!(whole(text), link);
    assert_eq!(whole(&format!("https://example.org/centrode/?test#{text}")), link);
    assert_eq!(whole(&format!(" #{text}\n")), link);
    let encoded = text.replace('.', "%2e").replace('/', "%2F");
    assert_eq!(whole(&format!("https://example.org/centrode/%23{encoded}")), link);
    let (address, command) = (link.at("https://example.org/?a=b#old"), link.command());
    assert_eq!(address, Ok(format!("https://example.org/?a=b#{text}")));
    assert_eq!(
        command,
        "centrode study --preset bench --set contact.disk=3 --set detection.xi2=0.005 --repeats 100 --method fcd --false-alarms 0.05"
    );
}

#[test]
fn an_empty_link_is_the_page_as_it_opens() {
    for text in ["", "#", "https://example.org/", "https://example.org/?test#", "preset=bench", "&&"] {
        let link = whole(text);
        assert_eq!((link.preset().name, &link.page), ("bench", &Page::default()), "{text}");
        assert_eq!(link.scenario(), &with("bench", &[]), "{text}");
    }
}

#[test]
fn every_preset_is_its_own_nearest() {
    for preset in PRESETS {
        let scenario = preset.scenario().expect(preset.name);
        let link = Link::nearest(&scenario, Page::default()).expect(preset.name);
        assert_eq!(link.fragment(), Ok(format!("preset={}", link.preset().name)));
        assert_eq!(link.scenario(), &scenario);
        assert_eq!(whole(&format!("preset={}", preset.name)).scenario(), &scenario);
    }
}

#[test]
fn lists_words_and_what_is_off_are_written_plainly() {
    let sets = ["robot.disks=[0.01, 0.02]", "load.force=[-1, 0, 2.5]", "detection.xi1=off", "contact.arc_length=0.018"];
    let link = Link::new(&PRESETS[0], &with("bench", &sets), Page::default()).expect("possible");
    let text = "preset=bench&robot.disks=0.01,0.02&contact.arc_length=0.018&load.force=-1,0,2.5&detection.xi1=off";
    assert_eq!(link.fragment().as_deref(), Ok(text));
    assert_eq!(whole(text), link);
    let none = with("free", &["robot.disks=[]"]);
    let link = Link::new(find("free").expect("a preset"), &none, Page::default()).expect("possible");
    assert_eq!(link.fragment().as_deref(), Ok("preset=free&robot.disks="));
    assert_eq!(whole("preset=free&robot.disks="), link);
}

/// What a link is told to be broken in, and the scenario that is left.
fn broken(text: &str) -> (Link, Vec<Broken>) {
    let (link, broken) = Link::read(text);
    assert!(Plan::new(link.scenario()).is_ok(), "{text}");
    assert_eq!(whole(&link.fragment().expect("short")), link, "{text}");
    (link, broken)
}

#[test]
fn what_is_broken_is_named_with_what_is_allowed_and_what_was_used() {
    for (text, parts) in [
        ("preset=bench&contact.disk=9", &["contact.disk=9", "disk from 1 to 3", "(contact.disk = 2 instead)"][..]),
        ("contact.disk=two", &["contact.disk=two", "\"two\"", "the number of a disk", "(contact.disk = 2 instead)"]),
        ("contact.disk=1.5", &["1.5", "the number of a disk"]),
        ("preset=disk-9", &["preset=disk-9", "unknown preset", "bench, paper", "(preset = \"bench\" instead)"]),
        ("bogus=1", &["bogus", "unknown key", "preset, loop_rate", "view, t, speed"]),
        ("robot.lenght=1", &["robot.lenght", "unknown key", "length, pitch_radius"]),
        ("robot=3", &["robot", "table of keys"]),
        ("contact.disk", &["contact.disk", "key=value is expected"]),
        ("contact.disk=%zz", &["contact.disk=%zz", "percent-encoding"]),
        ("contact.disk=3&contact.disk=1", &["contact.disk=1", "more than once", "(contact.disk = 3 instead)"]),
        (
            "contact.disk=3&contact.arc_length=0.01",
            &["contact.arc_length=0.01", "not both", "(contact.disk = 3 instead)"],
        ),
        ("contact.arc_length=0.05", &["robot.length", "0.03 m", "(contact.disk = 2 instead)"]),
        ("detection.xi2=nan", &["nan", "0 m or more", "(detection.xi2 = 0.007 instead)"]),
        ("detection.xi2=never", &["never", "\"off\""]),
        ("seed=1e3", &["seed=1e3", "whole number", "(seed = 1 instead)"]),
        ("load.force=1,2", &["load.force=1,2", "three numbers", "(load.force = [0, 0, 0] instead)"]),
        ("load.force=1,x,2", &["load.force[1]", "\"x\"", "a number"]),
        ("motion.end=0.4", &["motion.end=0.4", "filter.length = 500", "401 samples", "(motion.end = 10 instead)"]),
        ("robot.length=0.02", &["robot.length=0.02", "robot.disks[2] = 0.0225", "(robot.length = 0.03 instead)"]),
        ("view=plots", &["view=plots", "\"robot\" or", "(view = \"robot\" instead)"]),
        ("t=-1", &["t=-1", "from 0 s", "not allowed"]),
        ("t=12", &["t=12", "from 0 s to motion.end = 10 s", "(t = 10 instead)"]),
        ("t=soon", &["t=soon", "not allowed"]),
        ("repeats=0", &["repeats=0", "whole number from 1", "(repeats = 100 instead)"]),
        ("v=2", &["v=2", "newer page"]),
        ("=3", &["=3", "key=value is expected"]),
    ] {
        let (_, told) = broken(text);
        assert_eq!(told.len(), 1, "{text}: {told:?}");
        let message = told[0].to_string();
        assert!(!message.contains('\n'), "{message:?}");
        for part in parts {
            assert!(message.contains(part), "{text:?} → {message:?} lacks {part:?}");
        }
    }
}

#[test]
fn what_is_not_broken_is_kept() {
    // The length alone would be impossible with the preset's disks; with its own it is not.
    let link = whole("robot.length=0.02&robot.disks=0.005,0.01");
    assert_eq!((link.scenario().robot.length, link.scenario().robot.disks.len()), (0.02, 2));
    let (link, told) = broken("robot.length=0.02&robot.disks=0.005,oops&seed=7&contact.disk=1&v=3&view=map");
    assert_eq!(told.iter().map(|broken| broken.key.as_str()).collect::<Vec<_>>(), ["robot.disks", "v", "robot.length"]);
    assert_eq!(link.fragment().as_deref(), Ok("preset=bench&seed=7&contact.disk=1&view=map"));
    let (link, told) = broken("motion.start=5&motion.finish=4");
    assert!(told.len() == 1 && told[0].key == "motion.finish" && link.scenario().motion.start == 5.0, "{told:?}");
}

#[test]
fn a_reader_may_take_fewer_scenarios_than_are_possible() {
    let check = |scenario: &Scenario| match scenario.motion.end > 20.0 {
        true => Err(KEYS[0].refuse(centrode_core::scenario::keys::Value::Number(scenario.motion.end), KEYS[0].allowed)),
        false => Plan::new(scenario).map(drop),
    };
    let (link, told) = Link::read_if("seed=3&motion.end=30&contact.disk=1", check);
    assert_eq!(link.fragment().as_deref(), Ok("preset=bench&seed=3&contact.disk=1"));
    assert!(told.len() == 1 && told[0].key == "motion.end", "{told:?}");
}

#[test]
fn what_is_too_long_is_said_and_not_read() {
    let long = format!("contact.disk=3&robot.disks={}", "0.001,".repeat(2000));
    let (link, told) = broken(&long);
    assert!(matches!(told[..], [Broken { why: Why::TooLong { bytes }, .. }] if bytes == long.len()), "{told:?}");
    assert_eq!(link.scenario(), &with("bench", &[]));
    let disks: Vec<f64> = (1..2000).map(|i| f64::from(i) * 0.03 / 2001.0).collect();
    let mut scenario = with("free", &[]);
    scenario.robot.disks = disks;
    let link = Link::nearest(&scenario, Page::default()).expect("possible");
    let refused = link.fragment().expect_err("too long");
    assert!(matches!(refused, LinkError::TooLong { bytes } if bytes > MAX_LINK));
    assert!(refused.to_string().contains("save the scenario as a file"), "{refused}");
}

#[test]
fn an_address_is_a_whole_one() {
    let link = whole("");
    for address in [
        "https://example.org/",
        "http://localhost:8080/?test",
        "file:///pages/index.html",
        "https://ö.org/#x",
        "https://a.org/?a=|^{}\\`",
    ] {
        assert!(link.at(address).is_ok(), "{address}");
    }
    for address in [
        "",
        "example.org",
        "localhost:8080",
        "://x",
        "https://",
        "1s://x",
        "https://a b",
        "https://a<b",
        "https://?x",
        "bench",
    ] {
        let refused = link.at(address).expect_err(address);
        assert!(matches!(&refused, LinkError::NotAddress { address: named } if named == address), "{refused:?}");
    }
}

#[test]
fn the_page_s_words_are_those_of_studies() {
    assert!(RULES.iter().copied().eq(Rule::ALL.iter().map(|rule| rule.name())));
    assert!(MAX_REPEATS <= tuning::MAX_REPEATS as u64);
    for view in VIEWS {
        assert_eq!(whole(&format!("view={view}")).page.view, *view);
    }
    for key in PAGE_KEYS {
        assert!(
            KEYS.iter().all(|other| other.path != key.name) && !["preset", "v"].contains(&key.name),
            "{}",
            key.name
        );
    }
}

/// A scenario in which any number of keys are set to something possible.
fn scenario() -> impl Strategy<Value = Scenario> {
    let steps = prop::collection::vec((0..KEYS.len(), 0.0..1.0_f64), 0..40);
    ((0..PRESETS.len()), steps).prop_map(|(preset, steps)| {
        let mut scenario = PRESETS[preset].scenario().expect("a preset");
        for (place, share) in steps {
            let (key, mut next) = (&KEYS[place], scenario.clone());
            let (low, high) = match key.usual {
                Usual::None => (0.0, 0.001),
                _ => key.usual(&scenario),
            };
            let value = low + share * (high - low);
            for place in 0..key.any_of().len() {
                key.hold(&mut next, place, (share * 64.0) as usize >> place & 1 == 1);
            }
            match (key.words().len(), key.is_list(), key.has_off() && share < 0.2) {
                (0, false, false) => key.set_number(&mut next, value),
                (0, true, _) => key.set_part(&mut next, (share * 3.0) as usize, value),
                (0, _, true) => key.switch_off(&mut next),
                (words, ..) => key.choose(&mut next, (share * words as f64) as usize),
            }
            if Plan::new(&next).is_ok() {
                scenario = next;
            }
        }
        scenario
    })
}

/// An experiment with several segments in which something is set, a contact added and one taken away.
fn chained(length: f64) -> ChainLink {
    let draft = ChainDraft::of(find_chain("two-contacts").expect("a preset"));
    let contact = "segment = 1\nat = 0.02\nkind = \"plane\"\ntime = 4".parse().expect("a table");
    let changes = [
        Change::Set("segment[3].length".into(), toml::Value::Float(0.03 + 0.001 * length)),
        Change::Remove("contact[2]".into()),
        Change::Add("contact", contact),
    ];
    ChainLink::new("two-contacts", draft.with(changes).expect("possible")).expect("a preset")
}

#[test]
fn several_segments_are_held_and_what_is_impossible_of_them_is_told() {
    let chain = chained(1.0);
    let link = Link::new(&PRESETS[0], &Scenario::default(), Page { chain: Some(chain.clone()), ..Page::of(CHAIN) });
    let text = link.expect("possible").fragment().expect("short");
    assert!(text.contains("&chain=two-contacts&") && text.contains("&chain.segment.3.length=0.031"), "{text}");
    assert_eq!(whole(&text).page.chain, Some(chain));
    // A link that names several segments wants to show them.
    assert_eq!(whole("chain=buckling").page.view, CHAIN);
    assert_eq!(whole("chain=buckling&view=robot").page.view, "robot");
    let (link, broken) =
        Link::read("chain=two-contacts&chain.segment.2.length=-1&chain.segment.9.length=1&chain.segment.1.length=0.04");
    let told: Vec<&str> = broken.iter().map(|broken| broken.key.as_str()).collect();
    assert_eq!(told.len(), 2, "{broken:?}");
    assert!(broken[0].to_string().contains("segment[2].length"), "{broken:?}");
    let scenario = link.page.chain.expect("a chain").draft.scenario().expect("possible");
    assert_eq!(scenario.segments[0].alone.scenario().robot.length, 0.04);
}

fn page() -> impl Strategy<Value = Page> {
    let (views, rules) = (prop::sample::select(VIEWS), prop::sample::select(RULES));
    let numbers = (prop::option::of(0.0..0.3_f64), 0.1..4.0_f64, 0.001..0.999_f64, 1..MAX_REPEATS);
    let some = prop::sample::subsequence(Method::ALL, 0..=Method::ALL.len());
    let lesson = (prop::option::of(1..=TOUR_STEPS), prop::option::of(prop::sample::select(CHALLENGES)));
    let theme = prop::option::of(prop::sample::select(THEMES));
    let all = (views, rules, numbers, any::<bool>(), some, lesson, theme);
    all.prop_map(|(view, rule, numbers, looping, some, (tour, challenge), theme)| {
        let (time, speed, false_alarms, repeats) = numbers;
        let compare = Detectors::of(&some);
        let chain = (view == CHAIN).then(|| chained(speed));
        Page { view, rule, time, speed, looping, false_alarms, repeats, compare, tour, challenge, theme, chain }
    })
}

proptest! {
    #[test]
    fn what_is_written_is_read_back(scenario in scenario(), page in page(), preset in 0..PRESETS.len()) {
        let link = Link::new(&PRESETS[preset], &scenario, page).expect("possible");
        let text = link.fragment().expect("short");
        // RFC 3986; only lists of contacts have what is escaped.
        let escaped = if link.page.chain.is_some() { "%" } else { "" };
        let plain = |c: char| c.is_ascii_alphanumeric() || "-._~!$&'()*+,;=:@/?".contains(c) || escaped.contains(c);
        prop_assert!(text.chars().all(plain), "{}", text);
        let (read, broken) = Link::read(&text);
        prop_assert_eq!(broken, vec![], "{}", text);
        prop_assert_eq!(&read, &link, "{}", text);
        prop_assert_eq!(read.scenario().to_toml(), scenario.to_toml(), "to the sign of 0");
        prop_assert_eq!(read.fragment().expect("short"), text);
        let nearest = Link::nearest(&scenario, link.page.clone()).expect("possible");
        prop_assert!(nearest.changes().len() <= link.changes().len());
    }

    #[test]
    fn its_command_sets_the_same(scenario in scenario()) {
        let link = Link::nearest(&scenario, Page::default()).expect("possible");
        let mut draft = link.preset().draft().expect("a preset");
        // As a shell takes the words apart.
        let command = link.command();
        let words: Vec<&str> = command.split(' ').collect();
        prop_assert_eq!(&words[..4], &["centrode", "run", "--preset", link.preset().name]);
        for pair in words[4..].chunks(2) {
            prop_assert_eq!(pair[0], "--set");
            draft.set(pair[1].trim_matches('\'')).expect(pair[1]);
        }
        prop_assert_eq!(draft.finish().expect("possible").to_toml(), scenario.to_toml());
    }

    #[test]
    fn no_text_panics(text in ".{0,200}") {
        broken(&text);
    }

    #[test]
    fn no_list_of_keys_and_values_panics(
        parts in prop::collection::vec((0..KEYS.len() + PAGE_KEYS.len() + 3, "[-0-9.e,]{0,8}|off|nan|inf|1e999|\\PC{0,4}|%2[0-9a-g]"), 0..12)
    ) {
        let name = |place: usize| {
            let keys = KEYS.iter().map(|key| key.path).chain(PAGE_KEYS.iter().map(|key| key.name));
            keys.chain(["preset", "v", "bogus"]).nth(place).unwrap_or_default()
        };
        let text: Vec<String> = parts.iter().map(|(place, value)| format!("{}={value}", name(*place))).collect();
        broken(&text.join("&"));
    }

    #[test]
    fn a_random_scenario_with_one_value_spoilt_says_so(scenario in scenario(), which in any::<prop::sample::Index>()) {
        let link = Link::new(&PRESETS[0], &scenario, Page::default()).expect("possible");
        let text = link.fragment().expect("short");
        let mut parts: Vec<String> = text.split('&').map(String::from).collect();
        let place = which.index(parts.len());
        parts[place].push('!');
        let (_, told) = broken(&parts.join("&"));
        let key = parts[place].split('=').next().unwrap_or_default();
        prop_assert!(told.first().is_some_and(|broken| broken.key == key), "{:?} {:?}", parts, told);
    }
}

#[test]
fn a_draft_and_a_link_agree_on_an_empty_scenario() {
    let paper = Draft::default().finish().expect("the default");
    let link = Link::nearest(&paper, Page::default()).expect("possible");
    assert_eq!(link.fragment().as_deref(), Ok("preset=paper"));
}
