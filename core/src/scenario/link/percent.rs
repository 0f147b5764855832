//! Percent-encoding, as programs that links pass through put it in.

/// A text with `%2C` and the like read; none where a `%` is not followed by two digits, or bytes are not text.
pub fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => 16 * digit(rest.next()?)? + digit(rest.next()?)?,
            plain => plain,
        });
    }
    String::from_utf8(bytes).ok()
}

/// A text with everything in `%2C`'s way that does not stand for itself in every address.
pub fn encoded(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for byte in text.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b',' | b'=' => {
                out.push(byte.into());
            }
            other => out.extend(['%', char::from(hex(other >> 4)), char::from(hex(other & 15))]),
        }
    }
    out
}

fn hex(digit: u8) -> u8 {
    if digit < 10 { b'0' + digit } else { b'A' + digit - 10 }
}

fn digit(byte: u8) -> Option<u8> {
    match byte {
        b'0'..=b'9' => Some(byte - b'0'),
        b'a'..=b'f' => Some(byte - b'a' + 10),
        b'A'..=b'F' => Some(byte - b'A' + 10),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{decoded, encoded};

    #[test]
    fn what_is_encoded_is_read_back() {
        for text in ["[{kind=\"clamp\",at=0.015}]", "a&b#c %", "ε_τ+1", ""] {
            let written = encoded(text);
            assert!(!written.contains(['&', '#', ' ', '"', '+']), "{written}");
            assert_eq!(decoded(&written).as_deref(), Some(text));
        }
    }

    #[test]
    fn what_is_encoded_is_read_and_what_is_broken_is_not() {
        for (text, read) in [
            ("0.0075%2C0.015", Some("0.0075,0.015")),
            ("%CE%b5", Some("ε")),
            ("ε+1", Some("ε+1")),
            ("", Some("")),
            ("5%", None),
            ("5%2", None),
            ("%+2", None),
            ("%ff", None),
            ("%é", None),
        ] {
            assert_eq!(decoded(text).as_deref(), read, "{text}");
        }
    }
}
