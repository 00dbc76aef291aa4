//! The statements of OBJ and MTL files, as lines of text.

use std::borrow::Cow;

use crate::text;

/// The statements that end in a name, which may hold a `#`: 3ds Max names its materials `Material #1`.
const NAMED: [&str; 11] =
    ["usemtl", "newmtl", "mtllib", "usemap", "maplib", "o", "g", "bump", "disp", "decal", "norm"];

/// The statements of a file without comments, with the numbers of their first lines, from 1. `foreign` is
/// called with the number of each line that is not UTF-8.
///
/// A line that ends in a backslash continues on the next. A backslash at the end of a comment does not count:
/// it may be part of the name of a folder.
pub(super) fn statements<'b>(
    bytes: &'b [u8],
    mut foreign: impl FnMut(usize),
) -> impl Iterator<Item = (usize, Cow<'b, str>)> {
    let mut rest = text::lines(bytes).zip(1..);
    let mut next = move || {
        let (bytes, number) = rest.next()?;
        let (line, is_utf8) = text::line(bytes);
        if !is_utf8 {
            foreign(number);
        }
        Some((number, line))
    };
    core::iter::from_fn(move || {
        let (number, first) = next()?;
        let ends_in_name = ends_in_name(&first);
        let (first, mut continues) = part(first, ends_in_name);
        if !continues {
            return Some((number, first));
        }
        let mut whole = first.into_owned();
        while continues && let Some((_, line)) = next() {
            let (line, again) = part(line, ends_in_name);
            whole.push(' ');
            whole.push_str(&line);
            continues = again;
        }
        Some((number, Cow::Owned(whole)))
    })
}

fn ends_in_name(line: &str) -> bool {
    let keyword = line.split_whitespace().next().unwrap_or_default();
    keyword.starts_with("map_") || NAMED.contains(&keyword)
}

/// The part of a line before its comment and its backslash, and whether it continues on the next line.
fn part(line: Cow<'_, str>, ends_in_name: bool) -> (Cow<'_, str>, bool) {
    let text = line.trim_end();
    let comment = match text.trim_start().starts_with('#') {
        true => Some(0),
        // A name may hold a `#`.
        false if ends_in_name => None,
        // `1.#QNAN` and its like are numbers.
        false => text.match_indices('#').map(|(place, _)| place).find(|place| !after_dot(text, *place)),
    };
    let has_comment = comment.is_some() || (ends_in_name && text.contains(" #"));
    let content = comment.and_then(|place| text.get(..place)).unwrap_or(text);
    let (content, continues) = match content.strip_suffix('\\') {
        Some(before) if !has_comment => (before, true),
        _ => (content, false),
    };
    let length = content.len();
    let content = match line {
        Cow::Borrowed(line) => Cow::Borrowed(line.get(..length).unwrap_or_default()),
        Cow::Owned(mut line) => {
            line.truncate(length);
            Cow::Owned(line)
        }
    };
    (content, continues)
}

fn after_dot(text: &str, place: usize) -> bool {
    text.get(..place).is_some_and(|before| before.ends_with('.'))
}
