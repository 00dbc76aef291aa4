//! Decoding of text files.

/// Decodes UTF-8, and skips the byte order mark that some editors write.
///
/// # Errors
/// The number of the first line that is not UTF-8, counted from 1.
pub(crate) fn of_bytes(bytes: &[u8]) -> Result<&str, usize> {
    core::str::from_utf8(without_mark(bytes)).map_err(|error| {
        let good = without_mark(bytes).iter().take(error.valid_up_to());
        good.filter(|byte| **byte == b'\n').count() + 1
    })
}

/// The bytes after the byte order mark, if there is one.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes)
}
