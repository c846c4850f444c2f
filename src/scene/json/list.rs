//! Rules for lists, and for values that may be `null`.

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::node::Json;
use super::number::whole;
use super::range::{Range, SMALLEST};
use super::rule::{At, Rule};
use super::scalar::Count;

/// Three numbers under one rule.
#[derive(Clone, Copy)]
pub(crate) struct Vector(pub(crate) Range);

impl Rule for Vector {
    type Value = Vector3<f64>;

    fn words(&self) -> String {
        format!("a list of 3 numbers {}", self.0.bounds())
    }

    fn read(&self, at: &mut At) -> Option<Vector3<f64>> {
        at.items(&self.words(), |at, _| self.0.read(at)).map(Vector3::from)
    }

    fn schema(&self) -> Value {
        list(3, &self.0.schema())
    }

    fn json(&self, value: &Vector3<f64>) -> Value {
        value.iter().map(|number| self.0.json(number)).collect()
    }

    fn placeholder(&self) -> Vector3<f64> {
        Vector3::zeros()
    }
}

/// Three numbers under one rule, of which at least one is not 0: it is divided by its length.
#[derive(Clone, Copy)]
pub(crate) struct Direction(pub(crate) Range);

impl Rule for Direction {
    type Value = Vector3<f64>;

    fn words(&self) -> String {
        format!("{}, not all 0", Vector(self.0).words())
    }

    fn read(&self, at: &mut At) -> Option<Vector3<f64>> {
        let vector = Vector(self.0).read(at)?;
        if vector.amax() >= SMALLEST {
            return Some(vector);
        }
        at.not_allowed("scene::zero_vector", &self.words(), "")
    }

    fn schema(&self) -> Value {
        let mut schema = Vector(self.0).schema();
        schema["contains"] = json!({ "anyOf": [{ "minimum": SMALLEST }, { "maximum": -SMALLEST }] });
        schema
    }

    fn json(&self, value: &Vector3<f64>) -> Value {
        Vector(self.0).json(value)
    }

    fn placeholder(&self) -> Vector3<f64> {
        Vector3::zeros()
    }
}

/// Two counts, each under its own rule.
#[derive(Clone, Copy)]
pub(crate) struct Counts(pub(crate) Count<u32>, pub(crate) Count<u32>);

impl Rule for Counts {
    type Value = [u32; 2];

    fn words(&self) -> String {
        let Self(Count(a, b), Count(c, d)) = self;
        format!("a list of 2 whole numbers: {a} to {b}, {c} to {d}")
    }

    fn read(&self, at: &mut At) -> Option<[u32; 2]> {
        at.items(&self.words(), |at, i| [self.0, self.1][i].read(at))
    }

    fn schema(&self) -> Value {
        let counts = [self.0.schema(), self.1.schema()];
        json!({ "type": "array", "prefixItems": counts, "minItems": 2, "maxItems": 2 })
    }

    fn json(&self, value: &[u32; 2]) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> [u32; 2] {
        [self.0.0, self.1.0]
    }
}

/// A list of grid points `[x, y]`; whether they lie on the grid is checked with the whole document.
#[derive(Clone, Copy)]
pub(crate) struct GridPoints;

impl Rule for GridPoints {
    type Value = Vec<[usize; 2]>;

    fn words(&self) -> String {
        "a list of grid points [x, y]".into()
    }

    fn read(&self, at: &mut At) -> Option<Vec<[usize; 2]>> {
        at.list(&self.words(), |at, _| at.items("a grid point [x, y]", |at, _| grid_index(at)))
    }

    fn schema(&self) -> Value {
        let points = list(2, &json!({ "type": "integer", "minimum": 0 }));
        json!({ "type": "array", "items": points, "uniqueItems": true })
    }

    fn json(&self, value: &Vec<[usize; 2]>) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> Vec<[usize; 2]> {
        Vec::new()
    }
}

/// A whole number; a negative one becomes one that lies on no grid.
fn grid_index(at: &mut At) -> Option<usize> {
    let words = "a whole number";
    let Json::Number(value) = at.node.json else { return at.wrong_type(words) };
    let index = whole(value).map(|index| usize::try_from(index).unwrap_or(usize::MAX));
    index.or_else(|| at.not_allowed("scene::out_of_range", words, ""))
}

/// The schema of a list of `length` values.
fn list(length: usize, items: &Value) -> Value {
    json!({ "type": "array", "items": items, "minItems": length, "maxItems": length })
}

/// The rule, or `null` for none.
#[derive(Clone, Copy)]
pub(crate) struct OrNull<R>(pub(crate) R);

impl<R: Rule> Rule for OrNull<R> {
    type Value = Option<R::Value>;

    fn words(&self) -> String {
        format!("{}, or null", self.0.words())
    }

    fn read(&self, at: &mut At) -> Option<Option<R::Value>> {
        match at.node.json {
            Json::Null => Some(None),
            _ => self.0.read(at).map(Some),
        }
    }

    fn schema(&self) -> Value {
        json!({ "anyOf": [self.0.schema(), { "type": "null" }] })
    }

    fn json(&self, value: &Option<R::Value>) -> Value {
        value.as_ref().map_or(Value::Null, |value| self.0.json(value))
    }

    fn placeholder(&self) -> Option<R::Value> {
        None
    }
}
