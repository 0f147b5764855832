//! How a log is to be read, as a person fills it in: which column is what, in which unit, and what else a file does not say.

use std::collections::BTreeMap;

use super::file::{File, Parts};
use centrode_core::record::log::header::columns;
use centrode_core::record::log::text::head::{is_number, preview};
use centrode_core::record::log::{Column, Format, Mapping, Options, Reader, Role};

/// Rows shown of the file.
const ROWS: usize = 5;

/// One change of a form.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// A quantity is in this column, from 0; none gives back what was guessed.
    Column(Role, Option<usize>),
    /// It is in no column, whatever was guessed.
    Unused(Role),
    /// Its unit.
    Unit(Role, &'static str),
    /// The format; none to guess it.
    Format(Option<Format>),
    /// The tool of an NDI file.
    Tool(String),
    /// Whether a topic is read, of the second file if so.
    Topic(String, bool, bool),
    /// Whether the commands are those of the scenario's motion.
    Motion(bool),
    /// The commands are in a second file, which is to be chosen.
    Second,
    /// Whether the frame is fitted.
    FitFrame(bool),
    /// Whether the log says how fast the loop ran.
    OwnRate(bool),
}

/// The form.
#[derive(Debug, Clone)]
pub struct Form {
    /// The log, and what was said of it so far.
    pub parts: Parts,
    /// Why it was not read, if it was not.
    pub why: Option<String>,
    /// The first rows, a header among them if there is one.
    pub rows: Vec<Vec<String>>,
    /// Names of the columns.
    pub headers: Vec<String>,
    /// What quantities were guessed to be: column and unit.
    pub guessed: BTreeMap<Role, (usize, &'static str)>,
    /// What they are.
    pub chosen: BTreeMap<Role, (usize, &'static str)>,
    /// Whether the next file that comes in has the commands.
    pub awaits: bool,
}

impl Form {
    /// Of a log, with why it was not read if so.
    #[must_use]
    pub fn new(parts: Parts, why: Option<String>) -> Self {
        let none = BTreeMap::new();
        let (rows, headers, guessed, chosen) = (Vec::new(), Vec::new(), none.clone(), none);
        let mut form = Self { parts, why, rows, headers, guessed, chosen, awaits: false };
        form.look();
        form
    }

    /// The format in which it is read.
    #[must_use]
    pub fn format(&self) -> Format {
        let File { name, head, .. } = &self.parts.file;
        self.parts.asked.options.format.unwrap_or_else(|| Format::guess(name, head))
    }

    /// Looks at the first rows again.
    fn look(&mut self) {
        (self.guessed, self.chosen) = (BTreeMap::new(), BTreeMap::new());
        (self.rows, self.headers) = (Vec::new(), Vec::new());
        if self.format() != Format::Csv {
            return;
        }
        let head = &self.parts.file.head;
        self.rows = preview(head, ROWS).unwrap_or_default();
        let first = self.rows.first().cloned().unwrap_or_default();
        let bare = first.iter().all(|cell| is_number(cell.as_bytes()));
        let name = |(place, cell): (usize, &String)| {
            if bare || cell.trim().is_empty() { format!("#{}", place + 1) } else { cell.clone() }
        };
        self.headers = first.iter().enumerate().map(name).collect();
        let told = |mappings: Vec<Mapping>| {
            let options = Options { format: Some(Format::Csv), mappings: mappings.clone(), ..Options::default() };
            let read = Reader::new(&self.parts.file.name, head.to_vec(), &options);
            let read = read.map(|reader| reader.columns().to_vec());
            let read = read.or_else(|_| columns(&self.headers, 1, &mappings)).unwrap_or_default();
            read.iter().filter_map(place).collect::<BTreeMap<_, _>>()
        };
        let guessed = told(Vec::new());
        let chosen = told(self.parts.asked.options.mappings.clone());
        (self.guessed, self.chosen) = (guessed, chosen);
    }

    /// Takes a change.
    pub fn edit(&mut self, edit: Edit) {
        // A dialog that was left without a file waits for none.
        self.awaits = edit == Edit::Second;
        let asked = &mut self.parts.asked;
        match edit {
            Edit::Column(role, Some(place)) => {
                // A column is one quantity.
                self.chosen.retain(|_, (taken, _)| *taken != place);
                let unit = self.guessed.get(&role).filter(|(guess, _)| *guess == place).map(|(_, unit)| *unit);
                let unit = unit.or_else(|| named_unit(role, self.headers.get(place)?));
                self.chosen.insert(role, (place, unit.unwrap_or(role.dimension().si().name)));
            }
            Edit::Column(role, None) => {
                self.chosen.remove(&role);
                if let Some(guess) = self.guessed.get(&role) {
                    self.chosen.insert(role, *guess);
                }
            }
            Edit::Unused(role) => drop(self.chosen.remove(&role)),
            Edit::Unit(role, unit) => {
                if let Some((_, known)) = self.chosen.get_mut(&role) {
                    *known = unit;
                }
            }
            Edit::Format(format) => {
                asked.options.format = format;
                asked.options.mappings.clear();
                self.look();
            }
            Edit::Tool(tool) => asked.options.tool = Some(tool).filter(|tool| !tool.trim().is_empty()),
            Edit::Topic(topic, second, read) => {
                let topics = if second { &mut asked.second_topics } else { &mut asked.options.topics };
                topics.retain(|known| *known != topic);
                if read {
                    topics.push(topic);
                }
            }
            Edit::Motion(motion) => {
                asked.motion = motion;
                if !motion {
                    self.parts.commands = None;
                }
            }
            Edit::Second => {}
            Edit::FitFrame(fit) => asked.fit_frame = fit,
            Edit::OwnRate(own) => asked.own_rate = own,
        }
    }

    /// A second file has come in, with the commands.
    pub fn second(&mut self, file: File) {
        self.awaits = false;
        self.parts.asked.motion = false;
        self.parts.commands = Some(file);
        self.parts.topics[1].clear();
        self.parts.asked.second_topics.clear();
    }

    /// The log with what was filled in.
    #[must_use]
    pub fn filled(self) -> Parts {
        let changed = self.chosen.iter().filter(|(role, chosen)| self.guessed.get(role) != Some(chosen));
        let column = |place: usize| {
            let header = self.headers.get(place).cloned().unwrap_or_default();
            let alone = self.headers.iter().filter(|other| **other == header).count() == 1;
            let plain = alone && header.trim() == header && !header.is_empty();
            if plain { header } else { format!("#{}", place + 1) }
        };
        let mapping = |(role, (place, unit)): (&Role, &(usize, &'static str))| Mapping {
            role: Some(*role),
            unit: Some(*unit),
            column: column(*place),
        };
        let taken = |place: usize| self.chosen.values().any(|(other, _)| *other == place);
        let unused = self.guessed.iter().filter(|(role, (place, _))| !self.chosen.contains_key(role) && !taken(*place));
        let unused = unused.map(|(_, (place, _))| Mapping { role: None, unit: None, column: column(*place) });
        let mappings = changed.map(mapping).chain(unused).collect();
        let mut parts = self.parts;
        parts.asked.options.mappings = mappings;
        parts
    }
}

fn place(column: &Column) -> Option<(Role, (usize, &'static str))> {
    Some((column.role?, (column.place, column.unit)))
}

/// The unit that a header names, when the quantity can have it.
fn named_unit(role: Role, header: &str) -> Option<&'static str> {
    let unit = header.rsplit(['[', '(']).next()?.trim_end_matches([']', ')']).trim();
    role.dimension().unit(unit).map(|unit| unit.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    fn form(text: &str) -> Form {
        let file = File::here("a.csv", text.as_bytes().to_vec());
        Form::new(Parts::new(file), None)
    }

    #[test]
    fn what_is_filled_in_is_what_differs_from_the_guess() {
        let mut form = form("Zeit;x [mm];u (mm);z [mm]\n0;1;2;3\n");
        assert_eq!(form.guessed.keys().copied().collect::<Vec<_>>(), [Role::X, Role::Z]);
        form.edit(Edit::Column(Role::Time, Some(0)));
        form.edit(Edit::Unit(Role::Time, "ms"));
        form.edit(Edit::Column(Role::Y, Some(2)));
        let told: Vec<String> = form.clone().filled().asked.options.mappings.iter().map(ToString::to_string).collect();
        assert_eq!(told, ["time [ms]=Zeit", "y [mm]=u (mm)"]);
        form.edit(Edit::Column(Role::Y, None));
        assert!(!form.chosen.contains_key(&Role::Y));
        form.edit(Edit::Unused(Role::Z));
        let told: Vec<String> = form.clone().filled().asked.options.mappings.iter().map(ToString::to_string).collect();
        assert_eq!(told, ["time [ms]=Zeit", "unused=z [mm]"]);
        // Opened again, it shows what was filled in.
        let again = Form::new(form.filled(), None);
        assert_eq!(again.chosen.get(&Role::Time), Some(&(0, "ms")));
        assert!(again.guessed.contains_key(&Role::Z) && !again.chosen.contains_key(&Role::Z));
    }

    #[test]
    fn columns_without_names_go_by_their_number() {
        let mut form = form("0,1,2\n1,2,3\n");
        assert_eq!(form.headers, ["#1", "#2", "#3"]);
        assert!(form.guessed.is_empty());
        form.edit(Edit::Column(Role::Time, Some(0)));
        assert_eq!(form.filled().asked.options.mappings[0].to_string(), "time [s]=#1");
    }
}
