//! Tables for a terminal: columns as wide as their widest cell.

use std::io;
use std::io::Write;

/// Rows of text under a heading; the first column is flush left, and so is the last.
#[derive(Debug)]
pub(crate) struct Table<const COLUMNS: usize> {
    rows: Vec<[String; COLUMNS]>,
}

impl<const COLUMNS: usize> Table<COLUMNS> {
    /// A table with its headings.
    pub(crate) fn new(headings: [&str; COLUMNS]) -> Self {
        Self { rows: vec![headings.map(str::to_owned)] }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: [String; COLUMNS]) {
        self.rows.push(cells);
    }

    /// Writes the table; nothing when it has no row but the headings.
    pub(crate) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        if self.rows.len() == 1 {
            return Ok(());
        }
        let widths: [usize; COLUMNS] = std::array::from_fn(|column| {
            self.rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
        });
        for row in &self.rows {
            let mut line = String::new();
            for (column, (cell, width)) in row.iter().zip(widths).enumerate() {
                let padding = " ".repeat(width - cell.chars().count());
                match column {
                    0 => line += &format!("  {cell}{padding}"),
                    _ if column + 1 == COLUMNS => line += &format!("  {cell}"),
                    _ => line += &format!("  {padding}{cell}"),
                }
            }
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_under_each_other() {
        let mut table = Table::new(["what", "px", "said"]);
        table.row(["a".into(), "1.5 ±".into(), "x".into()]);
        table.row(["bcdef".into(), "12".into(), String::new()]);
        let mut out = Vec::new();
        table.write(&mut out).unwrap();
        assert_eq!(
            String::from_utf8(out).unwrap(),
            "  what      px  said\n  a      1.5 ±  x\n  bcdef     12\n"
        );
    }
}
