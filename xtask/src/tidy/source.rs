//! Reading Rust just well enough for the rules: text without comments, strings and tests, and the paths in it.

/// The same text, line for line, with comments and the insides of strings blanked.
pub fn code(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut i = 0;
    while i < chars.len() {
        let rest = &chars[i..];
        let length = match rest {
            ['/', '/', ..] => until(rest, |r| r[0] == '\n', 0),
            ['/', '*', ..] => block_comment(rest),
            ['r', '"' | '#', ..] if !in_word(&chars, i) => raw_string(rest).unwrap_or(0),
            ['"', ..] => string(rest),
            // A character, not a lifetime.
            ['\'', '\\', ..] => 3 + until(rest.get(3..).unwrap_or(&[]), |r| r[0] == '\'', 1),
            ['\'', _, '\'', ..] => 3,
            _ => 0,
        };
        if length == 0 {
            out.push(rest[0]);
            i += 1;
        } else {
            let length = length.min(rest.len());
            out.extend(rest[..length].iter().map(|c| if *c == '\n' { '\n' } else { ' ' }));
            i += length;
        }
    }
    out
}

fn in_word(chars: &[char], i: usize) -> bool {
    i > 0 && (chars[i - 1].is_alphanumeric() || chars[i - 1] == '_')
}

/// Length up to the place where `end` holds, and `extra` more.
fn until(rest: &[char], end: impl Fn(&[char]) -> bool, extra: usize) -> usize {
    let place = (0..rest.len()).find(|i| end(&rest[*i..]));
    place.map_or(rest.len(), |i| i + extra)
}

fn block_comment(rest: &[char]) -> usize {
    let (mut depth, mut i) = (0, 0);
    while i < rest.len() {
        match rest[i..] {
            ['/', '*', ..] => (depth, i) = (depth + 1, i + 2),
            ['*', '/', ..] => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            return i;
        }
    }
    rest.len()
}

fn string(rest: &[char]) -> usize {
    let mut i = 1;
    while i < rest.len() {
        match rest[i] {
            '\\' => i += 2,
            '"' => return i + 1,
            _ => i += 1,
        }
    }
    rest.len()
}

fn raw_string(rest: &[char]) -> Option<usize> {
    let hashes = rest[1..].iter().take_while(|c| **c == '#').count();
    if rest.get(1 + hashes) != Some(&'"') {
        return None;
    }
    let start = 2 + hashes;
    let ends = |r: &[char]| r[0] == '"' && r.len() > hashes && r[1..=hashes].iter().all(|c| *c == '#');
    Some(start + until(&rest[start..], ends, 1 + hashes))
}

/// `code` without the items marked `#[cfg(test)]`, line for line.
pub fn without_tests(code: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut out = code.to_owned();
    while let Some(start) = out.find(MARK) {
        let mut depth = 0;
        let end = out[start..].char_indices().find_map(|(i, c)| {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            let over = (c == '}' || c == ';') && depth == 0;
            over.then_some(start + i + 1)
        });
        let end = end.unwrap_or(out.len());
        let blank: String = out[start..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
        out.replace_range(start..end, &blank);
    }
    out
}

/// Every path in `code` with its line: `use` trees spelt out, and `a::b::c` elsewhere.
pub fn paths(code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let words = words(code);
    let mut i = 0;
    while i < words.len() {
        if words[i].1 == "use" {
            i = tree(&words, i + 1, "", &mut found);
        } else if is_name(&words[i].1) {
            let line = words[i].0;
            let mut path = words[i].1.clone();
            while words.get(i + 1).is_some_and(|w| w.1 == "::") && words.get(i + 2).is_some_and(|w| is_name(&w.1)) {
                path = format!("{path}::{}", words[i + 2].1);
                i += 2;
            }
            found.push((line, path));
            i += 1;
        } else {
            i += 1;
        }
    }
    found
}

/// Reads one `use` tree that starts at word `i`; gives where it ends.
fn tree(words: &[(usize, String)], mut i: usize, prefix: &str, found: &mut Vec<(usize, String)>) -> usize {
    let mut path = prefix.to_owned();
    let mut line = words.get(i).map_or(0, |word| word.0);
    while let Some((at, word)) = words.get(i) {
        match word.as_str() {
            "::" => {}
            "{" => {
                i += 1;
                while words.get(i).is_some_and(|w| w.1 != "}" && w.1 != ";") {
                    i = tree(words, i, &path, found);
                    if words.get(i).is_some_and(|w| w.1 == ",") {
                        i += 1;
                    }
                }
                return i + 1;
            }
            // The new name is no part of the path.
            "as" => i += 1,
            "," | "}" | ";" => break,
            name => {
                line = *at;
                path = if path.is_empty() { name.to_owned() } else { format!("{path}::{name}") };
            }
        }
        i += 1;
    }
    found.push((line, path));
    i
}

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Names, `::` and single other characters, each with its line.
fn words(code: &str) -> Vec<(usize, String)> {
    let mut words = Vec::new();
    for (number, line) in code.lines().enumerate() {
        let mut rest = line;
        while let Some(first) = rest.chars().next() {
            let name = |c: char| c.is_alphanumeric() || c == '_';
            let length = if name(first) {
                rest.find(|c| !name(c)).unwrap_or(rest.len())
            } else if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            };
            if !first.is_whitespace() {
                words.push((number + 1, rest[..length].to_owned()));
            }
            rest = &rest[length..];
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_strings_are_blank_and_lines_stay() {
        let text = "a // x\n/* b /* c */ \n */ d \"e \\\" f\" g r#\"h \" i\"# j 'k' '\\'' l<'m>";
        let blank = code(text);
        assert_eq!(blank.split_whitespace().collect::<Vec<_>>(), ["a", "d", "g", "j", "l<'m>"]);
        assert_eq!(blank.lines().count(), text.lines().count());
        assert_eq!(code("\"open"), "     ");
        assert_eq!(code("/* open"), "       ");
        assert_eq!(code("'\\"), "  ");
    }

    #[test]
    fn tests_are_left_out_with_all_they_hold() {
        let text = "a\n#[cfg(test)]\nmod tests { fn b() { c } }\nd\n#[cfg(test)]\nuse e;\nf";
        let rest = without_tests(text);
        assert_eq!(rest.split_whitespace().collect::<Vec<_>>(), ["a", "d", "f"]);
        assert_eq!(rest.lines().count(), text.lines().count());
    }

    #[test]
    fn use_trees_are_spelt_out() {
        let found = paths("use std::{fs, io::{self, Read as R}, time};\nlet a = crate::b::c(d);");
        let found: Vec<&str> = found.iter().map(|path| path.1.as_str()).collect();
        for path in ["std::fs", "std::io::self", "std::io::Read", "std::time", "crate::b::c", "d"] {
            assert!(found.contains(&path), "{path} in {found:?}");
        }
        assert!(!found.contains(&"R"));
    }

    #[test]
    fn broken_code_ends_too() {
        for text in ["use", "use a::{", "use a::{b", "use {,};", "a::", "#[cfg(test)]", "use a as"] {
            paths(&without_tests(&code(text)));
        }
    }
}
