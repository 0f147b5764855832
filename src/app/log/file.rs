//! A file that may be a log, and how it is to be read.

use std::rc::Rc;

use centrode_core::record::log::frame::Setting;
use centrode_core::record::log::mcap::Topic;
use centrode_core::record::log::{Commands, Options, Rate, Setup};

/// So much of a file is looked at before it is read, bytes.
pub const HEAD: usize = 64 << 10;

/// Where a file's bytes are.
#[derive(Debug, Clone)]
pub enum Kept {
    /// Here.
    Here(Rc<Vec<u8>>),
    /// With the surroundings, under this number.
    There(u32),
}

/// A file that may be a log.
#[derive(Debug, Clone)]
pub struct File {
    /// Its name.
    pub name: String,
    /// Its size, bytes.
    pub size: u64,
    /// Its first bytes.
    pub head: Rc<[u8]>,
    /// Where the rest is.
    pub kept: Kept,
}

impl File {
    /// A file whose bytes are here.
    #[must_use]
    pub fn here(name: &str, bytes: Vec<u8>) -> Self {
        let head = bytes.get(..bytes.len().min(HEAD)).unwrap_or_default().into();
        Self { name: name.into(), size: bytes.len() as u64, head, kept: Kept::Here(Rc::new(bytes)) }
    }

    /// A file that the surroundings have, under a number, with its size and its first bytes.
    #[must_use]
    pub fn there(name: &str, size: u64, head: &[u8], number: u32) -> Self {
        Self { name: name.into(), size, head: head.into(), kept: Kept::There(number) }
    }
}

/// Whether a file is a log rather than a scenario, by its name and its first bytes.
#[must_use]
pub fn is_log(name: &str, head: &[u8]) -> bool {
    let extension = name.rsplit_once('.').map_or(String::new(), |(_, extension)| extension.to_lowercase());
    match extension.as_str() {
        "toml" => false,
        "csv" | "tsv" | "tum" | "mcap" => true,
        _ => {
            let text = String::from_utf8_lossy(head.get(..head.len().min(HEAD)).unwrap_or_default());
            let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
            // A scenario begins with a table or a key.
            let first = lines.next().unwrap_or_default();
            !(first.starts_with('[') || first.contains('='))
        }
    }
}

/// How a person wants a log to be read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Asked {
    /// Format, columns, tool and topics.
    pub options: Options,
    /// Which topics of the second file.
    pub second_topics: Vec<String>,
    /// Whether the commands are those of the scenario's motion.
    pub motion: bool,
    /// Whether the log's frame is fitted.
    pub fit_frame: bool,
    /// Whether the spacing of its rows says how fast the loop ran, rather than the scenario.
    pub own_rate: bool,
}

/// A log with what belongs to it.
#[derive(Debug, Clone)]
pub struct Parts {
    /// The log.
    pub file: File,
    /// A second file with the commands.
    pub commands: Option<File>,
    /// How it is read.
    pub asked: Asked,
    /// The topics that the log has, as far as it was read, and those of the second file.
    pub topics: [Vec<Topic>; 2],
}

impl Parts {
    /// A log about which nothing was said.
    #[must_use]
    pub fn new(file: File) -> Self {
        Self { file, commands: None, asked: Asked::default(), topics: Default::default() }
    }

    /// How it becomes a recording.
    #[must_use]
    pub fn setup(&self) -> Setup {
        let Asked { motion, fit_frame, own_rate, .. } = self.asked;
        Setup {
            rate: if own_rate { Rate::Log } else { Rate::Scenario },
            commands: if motion { Some(Commands::Motion) } else { self.commands.as_ref().map(|_| Commands::Log) },
            frame: if fit_frame { Setting::Fitted } else { Setting::Base },
            ..Setup::default()
        }
    }

    /// The flags of `centrode analyze` behind the scenario that say the same; `loop_rate` (Hz) is the log's own.
    #[must_use]
    pub fn flags(&self, loop_rate: &str) -> Vec<String> {
        let Options { format, mappings, tool, topics, .. } = &self.asked.options;
        let mut flags = Vec::new();
        let mut flag = |name: &str, value: &str| flags.extend([name.to_owned(), value.to_owned()]);
        if self.asked.own_rate {
            flag("--set", &format!("loop_rate={loop_rate}"));
        }
        if let Some(format) = format {
            flag("--format", format.key());
        }
        mappings.iter().for_each(|mapping| flag("--map", &mapping.to_string()));
        tool.iter().for_each(|tool| flag("--tool", tool));
        let second = self.asked.second_topics.iter().filter(|topic| self.commands.is_some() && !topics.contains(topic));
        topics.iter().chain(second).for_each(|topic| flag("--topic", topic));
        if self.asked.motion {
            flag("--commands", "motion");
        } else if let Some(commands) = &self.commands {
            flag("--commands", &commands.name);
        }
        if self.asked.fit_frame {
            flags.push("--fit-frame".into());
        }
        flags
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logs_are_told_from_scenarios() {
        for (name, head, log) in [
            ("a.toml", "time,x\n", false),
            ("a.CSV", "[contact]\n", true),
            ("a.mcap", "", true),
            ("a.txt", "# mine\n\n[contact]\ndisk = 3\n", false),
            ("scenario", "seed = 1\n", false),
            ("a.txt", "# timestamp tx\n0 1 2 3 0 0 0 1\n", true),
            ("a.log", "time;x\n", true),
        ] {
            assert_eq!(is_log(name, head.as_bytes()), log, "{name} {head}");
        }
    }
}
