//! Decoding of text files.

use std::borrow::Cow;

/// Decodes UTF-8, and skips the byte order mark that some editors write.
///
/// # Errors
/// The number of the first line that is not UTF-8, counted from 1.
pub fn of_bytes(bytes: &[u8]) -> Result<&str, usize> {
    core::str::from_utf8(without_mark(bytes)).map_err(|error| {
        let good = without_mark(bytes).iter().take(error.valid_up_to());
        good.filter(|byte| **byte == b'\n').count() + 1
    })
}

/// The bytes after the byte order mark, if there is one.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes)
}

/// The lines of a file that end in LF, CR LF or CR, without a byte order mark.
pub(crate) fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = without_mark(bytes);
    core::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        let (line, behind) = rest.split_at(end);
        rest = behind.strip_prefix(b"\r\n").or_else(|| behind.get(1..)).unwrap_or_default();
        Some(line)
    })
}

/// The text of a line, and whether it is UTF-8. A line that is not is decoded as Windows-1252, which has the
/// letters of Latin-1.
pub(crate) fn line(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    /// The characters of the bytes from 0x80 to 0x9F; the others are those of the same number.
    const WINDOWS: [char; 32] = [
        '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}',
        '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
    ];
    match core::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), true),
        Err(_) => {
            let character = |byte: &u8| {
                let place = byte.checked_sub(0x80).map(usize::from);
                place.and_then(|place| WINDOWS.get(place)).copied().unwrap_or(char::from(*byte))
            };
            (Cow::Owned(bytes.iter().map(character).collect()), false)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_any_way() {
        let all = |text: &'static str| lines(text.as_bytes()).collect::<Vec<_>>();
        assert_eq!(all("a\rb\nc\r\nd"), [b"a", b"b", b"c", b"d"]);
        assert_eq!(all("a\n\r\rb\n"), [&b"a"[..], b"", b"", b"b"]);
        assert_eq!(all("\u{feff}a"), [b"a"]);
        assert!(all("").is_empty());
    }

    #[test]
    fn lines_that_are_not_utf8_are_windows_1252() {
        assert_eq!(line("grün".as_bytes()), (Cow::Borrowed("grün"), true));
        assert_eq!(line(b"gr\xfcn \x80"), (Cow::Owned("grün €".to_owned()), false));
    }
}
