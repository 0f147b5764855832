//! The same as a command line.

use super::{ChainLink, Link, page};
use crate::scenario::Method;
use crate::scenario::keys::Value;
use crate::scenario::preset::CHAIN_NAMES;
use crate::scenario::text::number;

impl Link {
    /// The command that judges a log by the link's scenario: `log` is the file, `more` are flags behind the scenario.
    #[must_use]
    pub fn analyze(&self, log: &str, more: &[String]) -> String {
        let mut words = vec!["analyze".to_owned(), log.into()];
        words.extend(self.scenario_words());
        words.extend_from_slice(more);
        command_line(&words)
    }

    /// The flags that make the scenario.
    fn scenario_words(&self) -> Vec<String> {
        let mut words = vec!["--preset".to_owned(), self.preset.name.into()];
        for (key, value) in &self.changes {
            words.extend(["--set".into(), format!("{}={}", key.path, toml(value))]);
        }
        words
    }

    /// The command that runs several segments.
    fn chain_words(&self) -> Vec<String> {
        let opened = || ChainLink::of(CHAIN_NAMES[0]);
        let Some(chain) = self.page.chain.clone().or_else(opened) else { return vec!["run".into()] };
        let mut words = ["run", "--preset", chain.preset()].map(String::from).to_vec();
        for (key, value) in chain.changes() {
            words.extend(["--set".into(), format!("{key}={value}")]);
        }
        words
    }

    /// The command that computes what the page shows: a run, or the figure, map, table or study on the stage. In the
    /// quotes of a shell where it needs them.
    #[must_use]
    pub fn command(&self) -> String {
        let view = self.page.view;
        if view == page::CHAIN {
            return command_line(&self.chain_words());
        }
        let figure = view.strip_prefix("figure-");
        let mut words: Vec<String> = match (figure, view) {
            (Some(number), _) => vec!["figure".into(), number.into()],
            (None, "table2" | "map") => vec![view.into()],
            (None, "tuning" | "detectors") => vec!["study".into()],
            _ => vec!["run".into()],
        };
        words.extend(self.scenario_words());
        if view == "tuning" {
            let page = &self.page;
            words.extend(["--repeats".into(), page.repeats.to_string()]);
            words.extend(["--method".into(), page.rule.into()]);
            words.extend(["--false-alarms".into(), number(page.false_alarms)]);
        }
        if view == "detectors" {
            let page = &self.page;
            let detectors: Vec<&str> = page.compare.iter().map(Method::key).collect();
            words.extend(["--repeats".into(), page.repeats.to_string()]);
            words.extend(["--detectors".into(), detectors.join(",")]);
            words.extend(["--rate".into(), number(page.false_alarms)]);
        }
        if figure.is_some() {
            words.extend(["--out".into(), format!("{view}.svg")]);
        }
        command_line(&words)
    }
}

fn command_line(words: &[String]) -> String {
    let quoted = words.iter().map(|word| quoted(word));
    std::iter::once("centrode".into()).chain(quoted).collect::<Vec<_>>().join(" ")
}

/// A value as `--set` takes it.
fn toml(value: &Value) -> String {
    // TOML's whole number -0 has no sign.
    let number = |value: f64| if value == 0.0 && value.is_sign_negative() { "-0.0".into() } else { number(value) };
    match value {
        Value::Number(value) => number(*value),
        Value::List(values) => format!("[{}]", values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(",")),
        Value::Words(words) if words.is_empty() => "[]".into(),
        other => super::written(other),
    }
}

/// A word that a shell takes as it stands, or in quotes.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.,=+/:".contains(c);
    if word.chars().all(plain) { word.into() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        assert_eq!(quoted("contact.disk=3"), "contact.disk=3");
        assert_eq!(quoted("robot.disks=[0.01,0.02]"), "'robot.disks=[0.01,0.02]'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
