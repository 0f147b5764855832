//! Licences as packages state them: expressions of SPDX, and which of several is taken.

use crate::run::root;
use anyhow::{Context, Result, bail, ensure};
use std::fmt;
use std::fs;

/// The licences that `deny.toml` allows, the preferred ones first.
pub fn allowed() -> Result<Vec<String>> {
    let table: toml::Table = fs::read_to_string(root().join("deny.toml"))?.parse()?;
    let list = table.get("licenses").and_then(|group| group.get("allow")).and_then(toml::Value::as_array);
    let list = list.context("deny.toml allows no licence")?;
    Ok(list.iter().filter_map(|value| value.as_str().map(String::from)).collect())
}

/// An expression: one licence, all of some, or any of some.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Expression {
    /// One, with its exception where it has one.
    One(String),
    /// All of them hold.
    All(Vec<Expression>),
    /// One of them is to be taken.
    Any(Vec<Expression>),
}

impl Expression {
    /// Reads an expression. As in older packages, a slash is an "or".
    pub fn read(text: &str) -> Result<Self> {
        let spaced = text.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
        let mut words: Vec<&str> = spaced.split_whitespace().rev().collect();
        let read = any(&mut words).with_context(|| format!("the licence {text:?}"))?;
        ensure!(words.is_empty(), "the licence {text:?} does not end where it should");
        Ok(read)
    }

    /// What is taken, by the order in which licences are allowed; none where what is allowed does not suffice.
    pub fn taken(&self, allowed: &[String]) -> Option<Vec<String>> {
        let place = |name: &String| allowed.iter().position(|known| known == name);
        let mut taken = match self {
            Self::One(name) => place(name).map(|_| vec![name.clone()])?,
            Self::All(parts) => parts.iter().map(|part| part.taken(allowed)).collect::<Option<Vec<_>>>()?.concat(),
            Self::Any(parts) => {
                let possible = parts.iter().filter_map(|part| part.taken(allowed));
                possible.min_by_key(|names| names.iter().map(place).max())?
            }
        };
        taken.sort_by_key(place);
        taken.dedup();
        Some(taken)
    }
}

/// As SPDX writes it.
impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (parts, between) = match self {
            Self::One(name) => return f.write_str(name),
            Self::All(parts) => (parts, " AND "),
            Self::Any(parts) => (parts, " OR "),
        };
        for (k, part) in parts.iter().enumerate() {
            f.write_str(if k == 0 { "" } else { between })?;
            match part {
                Self::One(name) => f.write_str(name)?,
                several => write!(f, "({several})")?,
            }
        }
        Ok(())
    }
}

fn any(words: &mut Vec<&str>) -> Result<Expression> {
    list(words, "OR", Expression::Any, |words| list(words, "AND", Expression::All, one))
}

/// Parts with a word between them.
fn list(
    words: &mut Vec<&str>,
    between: &str,
    made: fn(Vec<Expression>) -> Expression,
    part: fn(&mut Vec<&str>) -> Result<Expression>,
) -> Result<Expression> {
    let first = part(words)?;
    let mut parts = vec![first];
    while words.pop_if(|word| *word == between).is_some() {
        parts.push(part(words)?);
    }
    Ok(if parts.len() == 1 { parts.swap_remove(0) } else { made(parts) })
}

fn one(words: &mut Vec<&str>) -> Result<Expression> {
    match words.pop() {
        Some("(") => {
            let inside = any(words)?;
            ensure!(words.pop() == Some(")"), "a bracket stays open");
            Ok(inside)
        }
        Some(name) if !["OR", "AND", "WITH", ")"].contains(&name) => {
            if words.pop_if(|word| *word == "WITH").is_none() {
                return Ok(Expression::One(name.into()));
            }
            let exception = words.pop().context("the exception is missing")?;
            Ok(Expression::One(format!("{name} WITH {exception}")))
        }
        other => bail!("a licence is expected, not {}", other.unwrap_or("the end")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(text: &str) -> Option<String> {
        let allowed = ["MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "Unicode-3.0"].map(String::from);
        Expression::read(text).unwrap().taken(&allowed).map(|names| names.join(" + "))
    }

    #[test]
    fn the_first_that_is_allowed_is_taken_and_all_where_all_hold() {
        for (text, expected) in [
            ("Apache-2.0 OR MIT", "MIT"),
            ("Apache-2.0/MIT", "MIT"),
            ("Apache-2.0 / MIT", "MIT"),
            ("Unlicense OR MIT", "MIT"),
            ("Apache-2.0 OR GPL-2.0-only", "Apache-2.0"),
            ("(MIT OR Apache-2.0) AND Unicode-3.0", "MIT + Unicode-3.0"),
            ("Unicode-3.0 AND Apache-2.0 OR MIT", "MIT"),
            ("GPL-3.0 OR Apache-2.0 WITH LLVM-exception", "Apache-2.0 WITH LLVM-exception"),
            ("MIT AND (GPL-3.0 OR MIT)", "MIT"),
        ] {
            assert_eq!(taken(text).as_deref(), Some(expected), "{text}");
        }
        for text in ["GPL-3.0", "MIT AND GPL-3.0", "Apache-2.0 WITH other-exception"] {
            assert_eq!(taken(text), None, "{text}");
        }
    }

    #[test]
    fn written_out_it_is_read_alike() {
        for (text, written) in [
            ("Apache-2.0/MIT", "Apache-2.0 OR MIT"),
            ("(MIT OR Apache-2.0) AND Unicode-3.0", "(MIT OR Apache-2.0) AND Unicode-3.0"),
            ("A WITH B OR C", "A WITH B OR C"),
        ] {
            let read = Expression::read(text).unwrap();
            assert_eq!(read.to_string(), written);
            assert_eq!(Expression::read(written).unwrap(), read);
        }
    }

    #[test]
    fn what_is_no_expression_is_refused() {
        for text in ["", "MIT OR", "OR MIT", "(MIT", "MIT)", "MIT Apache-2.0", "MIT WITH", "AND"] {
            assert!(Expression::read(text).is_err(), "{text}");
        }
    }
}
