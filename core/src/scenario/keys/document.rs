//! What is written from the table: the commented default scenario, and the reference in `docs/KEYS.md`.

use crate::scenario::Scenario;
use crate::scenario::keys::quantity::readable;
use crate::scenario::keys::{Allowed, GROUPS, KEYS, Key, Units, Value};
use std::fmt::Write;

/// Column in which comments stand.
const COMMENT: usize = 30;

/// A number as a TOML float.
fn float(value: f64) -> String {
    let text = readable(value);
    if text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'-') { text + ".0" } else { text }
}

fn toml(value: &Value) -> String {
    match value {
        Value::Number(value) => float(*value),
        Value::List(values) => format!("[{}]", values.iter().map(|&v| float(v)).collect::<Vec<_>>().join(", ")),
        other => other.to_toml(),
    }
}

/// The SI unit of a key's numbers; empty for none.
fn unit(key: &Key) -> &'static str {
    key.quantity.si_unit()
}

/// The key's default as TOML; for one that is given in place of another, an example.
fn default(key: &Key) -> String {
    let value = key.get(&Scenario::default());
    let example = || Value::Number(key.instead_of.map_or(f64::NAN, |(_, example)| example));
    toml(&value.unwrap_or_else(example))
}

/// The sentence, with what a file can say besides.
fn meaning(key: &Key) -> String {
    let mut text = key.sentence.to_owned();
    match key.allowed {
        Allowed::Threshold => text += " Or \"off\".",
        Allowed::Estimated(_) => text += " Or \"auto\": estimated from the still stretch before the motion.",
        Allowed::Words(_) | Allowed::Some(_) => {
            text = format!("{}. {text}", key.allowed.words(key.quantity, Units::Si))
        }
        _ => {}
    }
    if let Some((other, _)) = key.instead_of {
        text += &format!(" In place of {}.", other.rsplit('.').next().unwrap_or(other));
    }
    if key.illustrative {
        text += " (Illustrative.)";
    }
    text
}

/// The default scenario, every key with its unit and meaning, as TOML.
#[must_use]
pub fn commented_default() -> String {
    let mut out = String::from(
        "# A scenario of the simulated experiment. SI units and radians; a missing key has the value shown here.\n\
         # \"Illustrative\" marks a value that the paper does not give. docs/KEYS.md says what each key may hold.\n\n",
    );
    let line = |out: &mut String, left: &str, right: &str| {
        let _ = writeln!(out, "{left:<width$}# {right}", width = COMMENT.max(left.chars().count() + 1));
    };
    let mut group = "";
    for key in KEYS {
        if key.group() != group {
            group = key.group();
            let sentence = GROUPS.iter().find(|known| known.path == group).map_or("", |known| known.sentence);
            out.push('\n');
            line(&mut out, &format!("[{group}]"), sentence);
        }
        let aside = if key.instead_of.is_some() { "# " } else { "" };
        let unit = match unit(key) {
            "" => String::new(),
            unit => format!("{unit}. "),
        };
        let left = format!("{aside}{} = {}", key.name(), default(key));
        line(&mut out, &left, &format!("{unit}{}", meaning(key)));
    }
    out
}

/// The reference of all keys, as Markdown.
#[must_use]
pub fn reference() -> String {
    let mut out = String::from(
        "# The keys of a scenario\n\n\
         Written from the table of keys in `core/src/scenario/keys/table.rs`; a test keeps it current, and\n\
         `cargo xtask renew keys` writes it anew.\n\n\
         A scenario is a TOML file in SI units and radians; a missing key has its default. `centrode scenario` prints a file\n\
         with every key, and `--set KEY=VALUE` overrides one. The page shows lengths in mm, angles in °, moments in mN·m,\n\
         moduli in GPa and shares in %. Defaults marked with * are illustrative: the paper gives none.\n",
    );
    let rows = |out: &mut String, group: &str| {
        out.push_str("\n| key | unit | allowed | default | meaning |\n| --- | --- | --- | --- | --- |\n");
        for key in KEYS.iter().filter(|key| key.group() == group) {
            let unit = if unit(key).is_empty() { "–" } else { unit(key) };
            let mark = if key.illustrative { "\\*" } else { "" };
            let default = match key.instead_of {
                Some((other, _)) => format!("in place of `{other}`"),
                None => format!("`{}`{mark}", default(key)),
            };
            let allowed = key.allowed.words(key.quantity, Units::Si);
            let _ = writeln!(out, "| `{}` | {unit} | {allowed} | {default} | {} |", key.path, key.sentence);
        }
    };
    out.push_str("\n## At the top\n");
    rows(&mut out, "");
    for group in GROUPS {
        let _ = write!(out, "\n## {}\n\n{}\n", group.path, group.sentence);
        rows(&mut out, group.path);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commented_default_is_the_default() {
        assert_eq!(Scenario::from_toml(&commented_default()), Ok(Scenario::default()));
    }

    #[test]
    fn what_is_given_in_place_of_another_key_can_be_given() {
        let text: Vec<String> = commented_default()
            .lines()
            .filter(|line| !line.starts_with("disk =") && !line.starts_with("time ="))
            .map(|line| match line.strip_prefix("# ") {
                Some(key) if key.starts_with("arc_length") || key.starts_with("bend") => key.into(),
                _ => line.into(),
            })
            .collect();
        let scenario = Scenario::from_toml(&text.join("\n")).expect("possible");
        for key in KEYS.iter().filter(|key| key.instead_of.is_some()) {
            assert_eq!(key.number(&scenario), key.instead_of.map(|(_, example)| example), "{}", key.path);
        }
    }
}
