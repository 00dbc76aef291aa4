//! Tables in Markdown, with aligned columns.

use std::fmt;

/// The alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Align {
    Left,
    Right,
}

/// A table of text.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    headings: Vec<(String, Align)>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new<'h>(headings: impl IntoIterator<Item = (&'h str, Align)>) -> Self {
        let headings = headings.into_iter().map(|(heading, align)| (heading.to_owned(), align)).collect();
        Self { headings, rows: Vec::new() }
    }

    /// Adds a row, which has a cell for each heading.
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = String>) {
        self.rows.push(row.into_iter().collect());
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = |(column, (heading, _)): (usize, &(String, Align))| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            // A rule has at least three characters.
            cells.chain([heading]).map(|cell| cell.chars().count()).fold(3, usize::max)
        };
        let widths: Vec<usize> = self.headings.iter().enumerate().map(width).collect();
        let mut line = |cells: &mut dyn Iterator<Item = &String>| -> fmt::Result {
            for ((cell, width), (_, align)) in cells.zip(&widths).zip(&self.headings) {
                match align {
                    Align::Left => write!(f, "| {cell:<width$} ")?,
                    Align::Right => write!(f, "| {cell:>width$} ")?,
                }
            }
            f.write_str("|\n")
        };
        line(&mut self.headings.iter().map(|(heading, _)| heading))?;
        let rules: Vec<String> = self
            .headings
            .iter()
            .zip(&widths)
            .map(|((_, align), width)| match align {
                Align::Left => "-".repeat(*width),
                Align::Right => "-".repeat(width - 1) + ":",
            })
            .collect();
        line(&mut rules.iter())?;
        self.rows.iter().try_for_each(|row| line(&mut row.iter()))
    }
}

/// 1234567 as 1,234,567.
pub(crate) fn with_commas(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let mut table = Table::new([("name", Align::Left), ("count", Align::Right)]);
        table.push(["a longer name".into(), with_commas(1_234_567)]);
        table.push(["≤".into(), with_commas(12)]);
        let expected = "\
            | name          |     count |\n\
            | ------------- | --------: |\n\
            | a longer name | 1,234,567 |\n\
            | ≤             |        12 |\n";
        assert_eq!(table.to_string(), expected);
    }
}
