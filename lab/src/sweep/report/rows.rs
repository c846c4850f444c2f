//! The rows of all cases, as CSV and as JSON, written one after the other.

use std::io::{Result, Write};

use serde_json::{Value, json};

use crate::printable;
use crate::sweep::case::Case;
use crate::sweep::plan::Plan;
use crate::sweep::record::{Measured, Record};

/// What stands where a case has no result.
const NO_RESULT: &str = "no result";

/// Both tables.
pub(super) struct Rows<'a> {
    measures: &'a [String],
    csv: &'a mut dyn Write,
    json: &'a mut dyn Write,
    first: bool,
}

impl<'a> Rows<'a> {
    /// Begins both tables.
    pub(super) fn new(plan: &'a Plan, csv: &'a mut dyn Write, json: &'a mut dyn Write) -> Result<Self> {
        let paths: Vec<&str> = plan.spec.set.iter().map(|axis| axis.path.as_str()).collect();
        let measures = &plan.spec.measure;
        let columns = ["case", "id"].into_iter().chain(paths.iter().copied());
        let columns = columns.chain(["exit_code", "message"]).chain(measures.iter().map(String::as_str));
        writeln!(csv, "{}", columns.map(field).collect::<Vec<_>>().join(","))?;
        let scene = printable::json(&json!(plan.scene().name).to_string());
        let [paths, names] = [json!(paths), json!(measures)].map(|list| printable::json(&list.to_string()));
        let count = plan.count();
        write!(
            json,
            "{{\"scene\":{scene},\"cases\":{count},\"set\":{paths},\"measure\":{names},\"results\":["
        )?;
        Ok(Self { measures, csv, json, first: true })
    }

    /// Adds a case and what came of it.
    pub(super) fn add(&mut self, case: &Case, record: Option<&Record>) -> Result<()> {
        let (code, message) = match record {
            Some(record) => (json!(record.exit_code), record.message.as_str()),
            None => (Value::Null, NO_RESULT),
        };
        let (number, id) = (case.number + 1, case.address.to_string());
        let values =
            self.measures.iter().map(|name| record.map_or(Value::Null, |record| json(record.value(name))));
        let values: Vec<Value> = values.collect();

        let start =
            [json!(number), json!(id)].into_iter().chain(case.changes.iter().map(|(_, value)| value.clone()));
        let fields = start.chain([code.clone(), json!(message)]).chain(values.iter().cloned());
        writeln!(self.csv, "{}", fields.map(|value| text(&value)).collect::<Vec<_>>().join(","))?;

        let pairs = self.measures.iter().zip(&values).map(|(name, value)| pair(name, value));
        let changes: Vec<String> = case.changes.iter().map(|(path, value)| pair(path, value)).collect();
        let comma = if self.first { "" } else { "," };
        self.first = false;
        write!(
            self.json,
            "{comma}\n{{\"case\":{number},\"id\":\"{id}\",\"changes\":{{{}}},\"exit_code\":{code},\"message\":{},\"values\":{{{}}}}}",
            changes.join(","),
            printable::json(&json!(message).to_string()),
            pairs.collect::<Vec<_>>().join(","),
        )
    }

    /// Ends both tables.
    pub(super) fn finish(self) -> Result<()> {
        writeln!(self.json, "\n]}}")?;
        self.json.flush()?;
        self.csv.flush()
    }
}

fn pair(key: &str, value: &Value) -> String {
    printable::json(&format!("{}:{value}", Value::from(key)))
}

fn json(value: &Measured) -> Value {
    match value {
        Measured::Number(number) => json!(number),
        Measured::Text(text) => json!(text),
        Measured::Nothing => Value::Null,
    }
}

/// A value as a field of CSV: numbers bare, nothing empty, everything else between quotes where it must be.
fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => field(text),
        other => field(&other.to_string()),
    }
}

fn field(text: &str) -> String {
    let text = printable::line(text);
    if text.contains(['"', ',']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_read_back() {
        let fields = [json!(null), json!(0.1), json!("a"), json!("a, \"b\"\n"), json!([1, 2]), json!(true)];
        let texts = ["", "0.1", "a", "\"a, \"\"b\"\"␊\"", "\"[1,2]\"", "true"];
        assert_eq!(fields.map(|value| text(&value)), texts);
    }
}
