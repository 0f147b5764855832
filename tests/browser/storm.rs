//! A storm of random input: whatever is clicked, dragged, typed and resized, the page keeps running, what stands beside the canvas for
//! screen readers says what is on it, and the address holds the run that is shown.
//!
//! The same seed makes the same choices. `CENTRODE_STORM=7 cargo xtask test --dev browser -- engines::` makes another storm than usual,
//! `CENTRODE_STORM=7x200` one of 200 things done.

use crate::harness::{Page, WIDGETS, Widget};
use serde_json::json;
use std::collections::BTreeSet;

/// How much is done.
const ACTIONS: usize = 12;
/// A seed as good as any.
const SEED: u64 = 15;
const SIZES: [[u32; 2]; 4] = [[1280, 800], [1000, 640], [640, 900], [1400, 960]];
const KEYS: &str =
    "Tab ShiftTab Enter Escape ArrowLeft ArrowRight ArrowUp ArrowDown Home End PageUp PageDown a b c m s 0 ?";
const TEXTS: [&str; 8] = ["3", "-1", "1e9", "0.5", "", "abc", "12,5", "NaN"];

/// What would open a window of the browser's own, or leave the page.
const SHELTER: &str = "(() => { window.open = () => null; HTMLAnchorElement.prototype.click = () => {}; \
    HTMLInputElement.prototype.click = function () { if (this.type !== 'file') HTMLElement.prototype.click.call(this); }; \
    return 1; })()";

/// What plays would be another value a moment later.
const PAUSE: &str =
    "[...document.querySelectorAll('#elements button')].find((node) => node.textContent === 'Pause')?.click()";

/// Numbers that a seed determines (SplitMix64).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to 1.
    fn fraction(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn one_of<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.next() as usize % all.len()]
    }
}

#[track_caller]
pub fn a_storm_of_input(page: &mut Page) {
    let asked = std::env::var("CENTRODE_STORM").unwrap_or_else(|_| SEED.to_string());
    let (seed, actions) = asked.split_once('x').unwrap_or((&asked, ""));
    let seed: u64 = seed.parse().expect("a whole number");
    let actions = if actions.is_empty() { ACTIONS } else { actions.parse().expect("a whole number behind x") };
    println!("the seed of this storm: {seed}");
    page.eval(SHELTER);
    let mut dice = Dice(seed);
    let mut done = Vec::new();
    for _ in 0..actions {
        let sight = look(page);
        assert_eq!(sight.face, "running", "after {done:#?}: {}", page.text("#failed"));
        done.push(act(page, &sight, &mut dice));
    }
    resize(page, SIZES[0]);
    // Whatever is open.
    for _ in 0..3 {
        page.key("Escape");
    }
    page.eval(PAUSE);
    println!("what was done: {done:?}");
    let mut apart = Vec::new();
    page.wait("the elements to say what the canvas shows", |page| {
        let (said, shown) = (said(page), shown(page));
        let now: Vec<Fact> = said.difference(&shown).cloned().collect();
        if now != apart {
            println!("said and not shown: {now:?}");
            apart = now;
        }
        (said.len() > 10 && apart.is_empty()).then_some(())
    });
    page.wait("the run of the address", |page| {
        page.eval(
            "location.hash.includes('chain=') || centrode.shown_fingerprint() === centrode.link_fingerprint(location.href)",
        )
        .as_bool()
        .filter(|same| *same)
    });
    assert_eq!(page.problems(), Vec::<String>::new(), "after {done:#?}");
}

/// What the page shows at a moment.
struct Sight {
    face: String,
    size: [f64; 2],
    /// What a person can work.
    widgets: Vec<Widget>,
}

/// Looks once: each question waits until a frame is drawn.
#[track_caller]
fn look(page: &mut Page) -> Sight {
    const WORKED: [&str; 9] =
        ["Button", "Slider", "CheckBox", "RadioButton", "TextInput", "SpinButton", "ComboBox", "MenuItem", "Tab"];
    let seen = page.eval(&format!("[document.documentElement.dataset.page, [innerWidth, innerHeight], {WIDGETS}]"));
    let (face, size, widgets): (String, [f64; 2], String) = serde_json::from_value(seen).expect("a sight");
    let mut widgets: Vec<Widget> = serde_json::from_str(&widgets).expect("a list of widgets");
    widgets.retain(|widget| WORKED.contains(&widget.role.as_str()) && !widget.disabled && widget.bounds.is_some());
    Sight { face, size, widgets }
}

/// Does something; tells what.
#[track_caller]
fn act(page: &mut Page, sight: &Sight, dice: &mut Dice) -> String {
    match dice.next() % 20 {
        0..8 => {
            let (name, at) = somewhere(sight, dice, true);
            page.click_at(at);
            format!("click {name}")
        }
        8..11 => {
            let (name, at) = somewhere(sight, dice, false);
            page.click_at(at);
            format!("click {name}")
        }
        11..14 => {
            let (from, start) = somewhere(sight, dice, true);
            let (to, end) = somewhere(sight, dice, false);
            for (what, at) in
                [("mouseMoved", start), ("mousePressed", start), ("mouseMoved", end), ("mouseReleased", end)]
            {
                page.mouse(what, at);
            }
            page.frames();
            format!("drag {from} to {to}")
        }
        14..17 => {
            let keys: Vec<&str> = KEYS.split(' ').chain([" "]).collect();
            let key = *dice.one_of(&keys);
            page.key(key);
            format!("press {key:?}")
        }
        17..19 => {
            let text = *dice.one_of(&TEXTS);
            if page.eval("document.activeElement?.tagName === 'INPUT' && document.activeElement.type === 'text'")
                == true
            {
                page.insert(text);
                page.key("Enter");
            }
            format!("type {text:?}")
        }
        _ => {
            let size = *dice.one_of(&SIZES);
            resize(page, size);
            format!("size {size:?}")
        }
    }
}

#[track_caller]
fn resize(page: &mut Page, size: [u32; 2]) {
    page.resize(size);
    page.wait("the size", |page| (page.eval("[innerWidth, innerHeight]") == json!(size)).then_some(()));
    page.frames();
}

/// A place on the page, of a widget if `widget` and there is one, and what is there.
fn somewhere(sight: &Sight, dice: &mut Dice, widget: bool) -> (String, [f64; 2]) {
    let (fraction, [width, height]) = (dice.fraction(), sight.size);
    let is_in = |[x, y]: [f64; 2]| x >= 0.0 && y >= 0.0 && x < width - 1.0 && y < height - 1.0;
    let places: Vec<&Widget> = sight.widgets.iter().filter(|widget| is_in(widget.at(fraction))).collect();
    if widget && !places.is_empty() {
        let widget = dice.one_of(&places);
        return (format!("{} {:?}", widget.role, widget.label), widget.at(fraction));
    }
    let at = [fraction * (width - 2.0), dice.fraction() * (height - 2.0)].map(f64::floor);
    (format!("{at:?}"), at)
}

/// Role, name and value of a widget.
type Fact = (String, String, String);

/// What the elements say.
fn said(page: &mut Page) -> BTreeSet<Fact> {
    let all = page.eval(
        "[...document.querySelectorAll('#elements input')].map((node) => [node.dataset.kind, node.getAttribute('aria-label') ?? '', \
         node.dataset.kind === 'slider' ? node.getAttribute('aria-valuetext') ?? '' : String(node.checked)])",
    );
    let all: Vec<Fact> = serde_json::from_value(all).expect("a list");
    let role = |kind: &str| match kind {
        "slider" => Some("Slider"),
        "check" => Some("CheckBox"),
        "radio" => Some("RadioButton"),
        _ => None,
    };
    let fact = |(kind, name, value): Fact| Some((role(&kind)?.to_owned(), name, value));
    all.into_iter().filter_map(fact).collect()
}

/// What the canvas shows.
fn shown(page: &mut Page) -> BTreeSet<Fact> {
    let fact = |widget: Widget| {
        let value = if widget.role == "Slider" { widget.value } else { (widget.on == Some(true)).to_string() };
        (widget.role, widget.label, value)
    };
    page.widgets().into_iter().map(fact).collect()
}
