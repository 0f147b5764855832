//! What a person's hands do to the page: click, drag, type, tap, swipe.

use super::page::{Browser, Page};
use serde_json::{Value, json};

impl Page {
    /// Clicks in the middle of a widget.
    #[track_caller]
    pub fn click(&mut self, role: &str, label: &str) {
        let at = self.widget(role, label).at(0.5);
        self.click_at(at);
    }

    /// Clicks at a place of the page, in CSS pixels.
    #[track_caller]
    pub fn click_at(&mut self, at: [f64; 2]) {
        if let Browser::Driven(driven) = &mut self.browser {
            // All at once: what comes between would make a long press of it.
            driven.mouse(&[
                moved(at),
                json!({ "type": "pointerDown", "button": 0 }),
                pause(),
                json!({ "type": "pointerUp", "button": 0 }),
            ]);
            return self.frames();
        }
        self.mouse("mouseMoved", at);
        self.frames();
        // No frame between: a slow one would make a long press of it.
        self.mouse("mousePressed", at);
        self.mouse("mouseReleased", at);
        self.frames();
    }

    /// Drags between two places inside a widget, given as fractions of its width.
    #[track_caller]
    pub fn drag(&mut self, role: &str, label: &str, from: f64, to: f64) {
        let widget = self.widget(role, label);
        let (start, end) = (widget.at(from), widget.at(to));
        let middle = [(start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0];
        for (what, at) in [
            ("mouseMoved", start),
            ("mousePressed", start),
            ("mouseMoved", middle),
            ("mouseMoved", end),
            ("mouseReleased", end),
        ] {
            self.mouse(what, at);
            self.frames();
        }
    }

    /// Types a number into the field beside a slider and presses Enter.
    #[track_caller]
    pub fn type_number(&mut self, label: &str, text: &str) {
        self.click("TextInput", &format!("{label} value"));
        self.wait("the field to take text", |page| {
            (page.eval("document.activeElement?.tagName") == "INPUT").then_some(())
        });
        if let Browser::Driven(driven) = &mut self.browser {
            // A click that lasts for several slow frames has become a drag in the text.
            driven.select_all();
        }
        self.insert(text);
        self.key("Enter");
    }

    /// The real element of this kind and name that stands for a widget, as JavaScript finds it; waits until it is there.
    #[track_caller]
    pub fn element(&mut self, kind: &str, name: &str) -> String {
        let script = format!(
            "[...document.querySelectorAll('#elements [data-kind={kind}]')].find((node) => \
             (node.getAttribute('aria-label') ?? node.textContent) === {})",
            json!(name)
        );
        self.wait(&format!("an element {kind} named {name:?}"), |page| {
            (page.eval(&format!("Boolean({script})")) == true).then_some(())
        });
        format!("({script})")
    }

    /// The kind and the name of the element that has the keyboard; empty where none has.
    pub fn focused(&mut self) -> (String, String) {
        let found = self.eval(
            "(({ dataset, ariaLabel, textContent }) => [dataset.kind ?? '', dataset.kind ? ariaLabel ?? textContent : ''])(document.activeElement)",
        );
        serde_json::from_value(found).unwrap_or_default()
    }

    /// Presses Tab, or Shift and Tab, until this element has the keyboard.
    #[track_caller]
    pub fn tab_to(&mut self, key: &str, kind: &str, name: &str) {
        let mut seen = Vec::new();
        for _ in 0..400 {
            self.press(key);
            let focused = self.focused();
            if focused == (kind.to_owned(), name.to_owned()) {
                return self.frames();
            }
            seen.push(focused);
        }
        panic!("Tab never comes to {kind} {name:?}, only to {seen:?}");
    }

    /// Types text into whatever has the keyboard.
    pub fn insert(&mut self, text: &str) {
        if let Browser::Driven(driven) = &mut self.browser {
            driven.keys(text.chars().map(String::from));
            return self.frames();
        }
        self.chromium().call("Input.insertText", json!({ "text": text }));
        self.frames();
    }

    /// Presses and releases a key, named as in JavaScript (`" "`, `ArrowRight`, `Home`, `a`).
    ///
    /// `Shift` before a name holds that key, too (`ShiftTab`).
    pub fn key(&mut self, key: &str) {
        self.press(key);
        if key.ends_with("Tab") {
            self.frames();
        }
    }

    /// The same, for what the browser does without a frame of the interface.
    pub fn press(&mut self, key: &str) {
        if let Browser::Driven(driven) = &mut self.browser {
            driven.keys([named(key)]);
            return self.frames();
        }
        let shift = key.len() > 5 && key.starts_with("Shift");
        let key = if shift { &key[5..] } else { key };
        let modifiers = if shift { 8 } else { 0 };
        let text = match key {
            "Enter" => "\r",
            key if key.chars().count() == 1 => key,
            _ => "",
        };
        let code = if key == " " { "Space" } else { key };
        // Without its old number a key looks to eframe like one of a phone's soft keyboard, which it leaves alone.
        let number = match key {
            "Tab" => 9,
            "Enter" => 13,
            "Escape" => 27,
            "End" => 35,
            "Home" => 36,
            "PageUp" => 33,
            "PageDown" => 34,
            "ArrowUp" => 38,
            "ArrowDown" => 40,
            "ArrowLeft" => 37,
            "ArrowRight" => 39,
            key => key.to_ascii_uppercase().bytes().next().map_or(0, u32::from),
        };
        for (what, text) in [("keyDown", text), ("keyUp", "")] {
            let event = json!({ "type": what, "key": key, "code": code, "text": text, "windowsVirtualKeyCode": number, "modifiers": modifiers });
            self.chromium().call("Input.dispatchKeyEvent", event);
            if key != "Tab" {
                self.frames();
            }
        }
    }

    /// A mouse event at a place of the page, in CSS pixels: `mouseMoved`, `mousePressed` or `mouseReleased`.
    pub fn mouse(&mut self, what: &str, [x, y]: [f64; 2]) {
        if let Browser::Driven(driven) = &mut self.browser {
            let button = match what {
                "mousePressed" => Some(json!({ "type": "pointerDown", "button": 0 })),
                "mouseReleased" => Some(json!({ "type": "pointerUp", "button": 0 })),
                _ => None,
            };
            let actions: Vec<Value> = [moved([x, y])].into_iter().chain(button).collect();
            return driven.mouse(&actions);
        }
        let button = if what == "mouseMoved" { "none" } else { "left" };
        self.chromium().call(
            "Input.dispatchMouseEvent",
            json!({ "type": what, "x": x, "y": y, "button": button, "clickCount": 1 }),
        );
    }

    /// Turns the mouse wheel over a place of the page.
    pub fn wheel(&mut self, [x, y]: [f64; 2], down: f64) {
        self.chromium().call(
            "Input.dispatchMouseEvent",
            json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": down }),
        );
        self.frames();
    }

    /// Taps with a finger.
    pub fn tap(&mut self, [x, y]: [f64; 2]) {
        // No frame between, as for a click.
        for (what, points) in [("touchStart", json!([{ "x": x, "y": y }])), ("touchEnd", json!([]))] {
            self.chromium().call("Input.dispatchTouchEvent", json!({ "type": what, "touchPoints": points }));
        }
        self.frames();
    }

    /// A finger that comes down at one place, goes to another and is lifted there.
    pub fn swipe(&mut self, from: [f64; 2], to: [f64; 2]) {
        const STEPS: u32 = 12;
        let at = |k: u32| [0, 1].map(|i| from[i] + (to[i] - from[i]) * f64::from(k) / f64::from(STEPS));
        self.touch("touchStart", &[from]);
        (1..=STEPS).for_each(|k| self.touch("touchMove", &[at(k)]));
        self.touch("touchEnd", &[]);
        self.frames();
    }

    /// What fingers do: `touchStart`, `touchMove` or `touchEnd`, and where those are that are down.
    pub fn touch(&mut self, what: &str, fingers: &[[f64; 2]]) {
        let points: Vec<_> =
            fingers.iter().enumerate().map(|(id, [x, y])| json!({ "x": x, "y": y, "id": id })).collect();
        self.chromium().call("Input.dispatchTouchEvent", json!({ "type": what, "touchPoints": points }));
        self.frames();
    }
}

/// Over a place of the page, for WebDriver, which takes whole pixels.
fn moved([x, y]: [f64; 2]) -> Value {
    json!({ "type": "pointerMove", "x": x.round(), "y": y.round(), "duration": 0, "origin": "viewport" })
}

/// Long enough for a press to be seen, and far from a long one.
fn pause() -> Value {
    json!({ "type": "pause", "duration": 60 })
}

/// A key by WebDriver's character for it.
fn named(key: &str) -> String {
    let character = match key {
        "Tab" => '\u{E004}',
        "Enter" => '\u{E007}',
        "Escape" => '\u{E00C}',
        "PageUp" => '\u{E00E}',
        "PageDown" => '\u{E00F}',
        "End" => '\u{E010}',
        "Home" => '\u{E011}',
        "ArrowLeft" => '\u{E012}',
        "ArrowUp" => '\u{E013}',
        "ArrowRight" => '\u{E014}',
        "ArrowDown" => '\u{E015}',
        key => return key.to_owned(),
    };
    character.to_string()
}
