//! Tables of numbers as text: comma-separated values (RFC 4180, lines end in a line feed alone).

use std::fmt::Write;

/// A table under construction.
#[derive(Clone, Debug)]
pub struct Csv {
    text: String,
}

impl Csv {
    /// A table without rows whose columns are called `names`, which hold no comma or quote.
    pub fn new(names: &[&str]) -> Self {
        Self { text: names.join(",") + "\n" }
    }

    /// Adds a row, each number in the shortest form that reads back as the same one; one that is
    /// infinite or no number becomes an empty field.
    pub fn row(&mut self, numbers: impl IntoIterator<Item = f64>) {
        for (column, number) in numbers.into_iter().enumerate() {
            if column > 0 {
                self.text.push(',');
            }
            if number.is_finite() {
                // Writing to a string cannot fail.
                let _ = write!(self.text, "{number:?}");
            }
        }
        self.text.push('\n');
    }

    /// The whole table.
    pub fn text(&self) -> &str {
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_read_back() {
        let mut csv = Csv::new(&["a", "b", "c"]);
        csv.row([0.1, -1e-300, f64::MAX]);
        csv.row([1.0, 0.0, f64::INFINITY]);
        assert_eq!(csv.text(), "a,b,c\n0.1,-1e-300,1.7976931348623157e308\n1.0,0.0,\n");
    }
}
