//! Tables in Markdown.

use core::fmt;

/// A table whose columns are as wide as their widest cell. Names are aligned left, figures right.
pub(crate) struct Table {
    names: usize,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table with these heads. The first `names` columns hold names, the others figures.
    pub(crate) fn new<const COLUMNS: usize>(names: usize, heads: [&str; COLUMNS]) -> Self {
        Self { names, rows: vec![heads.map(str::to_owned).to_vec()] }
    }

    pub(crate) fn push<const COLUMNS: usize>(&mut self, row: [String; COLUMNS]) {
        self.rows.push(row.to_vec());
    }

    fn width(&self, column: usize) -> usize {
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, row) in self.rows.iter().enumerate() {
            for (column, cell) in row.iter().enumerate() {
                let width = self.width(column);
                if column < self.names {
                    write!(f, "| {cell:width$} ")?;
                } else {
                    write!(f, "| {cell:>width$} ")?;
                }
            }
            writeln!(f, "|")?;
            if number == 0 {
                for column in 0..row.len() {
                    let width = self.width(column);
                    if column < self.names {
                        write!(f, "| {:-<width$} ", "")?;
                    } else {
                        write!(f, "| {:->width$} ", ":")?;
                    }
                }
                writeln!(f, "|")?;
            }
        }
        Ok(())
    }
}

/// An integer as text, with commas between thousands.
pub(crate) fn thousands(number: u64) -> String {
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
    fn columns_are_as_wide_as_their_widest_cell() {
        let mut table = Table::new(1, ["scene", "ms"]);
        table.push(["é".to_owned(), "1.5".to_owned()]);
        table.push(["classic".to_owned(), "12.5".to_owned()]);
        let expected = "\
| scene   |   ms |
| ------- | ---: |
| é       |  1.5 |
| classic | 12.5 |
";
        assert_eq!(table.to_string(), expected);
    }

    #[test]
    fn thousands_have_commas() {
        assert_eq!([0, 999, 1000, 1_234_567].map(thousands), ["0", "999", "1,000", "1,234,567"]);
    }
}
