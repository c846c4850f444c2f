//! Tables of numbers as text: comma-separated values (RFC 4180, lines end in a line feed alone).

use crate::printable;

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
        self.labelled_row(&[], numbers);
    }

    /// Adds a row of `labels`, each between quotes, and numbers as [`Csv::row`] writes them.
    pub fn labelled_row(&mut self, labels: &[&str], numbers: impl IntoIterator<Item = f64>) {
        let labels =
            labels.iter().map(|label| format!("\"{}\"", printable::line(label).replace('"', "\"\"")));
        let number = |number: f64| if number.is_finite() { format!("{number:?}") } else { String::new() };
        let fields: Vec<String> = labels.chain(numbers.into_iter().map(number)).collect();
        self.text += &(fields.join(",") + "\n");
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
        csv.labelled_row(&["x, \"y\"\n\u{1b}"], [f64::NAN, 2.0]);
        let rows = "a,b,c\n0.1,-1e-300,1.7976931348623157e308\n1.0,0.0,\n\"x, \"\"y\"\"␊␛\",,2.0\n";
        assert_eq!(csv.text(), rows);
    }
}
