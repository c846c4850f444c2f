//! Rules for lists, and for values that may be `null`.

use serde_json::{Value, json};

use super::Vec3;
use super::format::Json;
use super::range::{Range, SMALLEST};
use super::rule::{At, Rule};
use super::scalar::{Count, Number, whole};

/// Three numbers under one rule.
#[derive(Clone, Copy)]
pub(super) struct Vector(pub(super) Range);

impl Rule for Vector {
    type Value = Vec3;

    fn words(&self) -> String {
        format!("a list of 3 numbers {}", self.0.words())
    }

    fn read(&self, at: &mut At) -> Option<Vec3> {
        at.items(&self.words(), |at, _| Number(self.0).read(at)).map(Vec3::from)
    }

    fn schema(&self) -> Value {
        list(3, &Number(self.0).schema())
    }

    fn json(&self, value: &Vec3) -> Value {
        value.iter().map(|number| Number(self.0).json(number)).collect()
    }

    fn stand_in(&self) -> Vec3 {
        Vec3::zeros()
    }
}

/// Three numbers under one rule, of which at least one is not 0: it is divided by its length.
#[derive(Clone, Copy)]
pub(super) struct Direction(pub(super) Range);

impl Rule for Direction {
    type Value = Vec3;

    fn words(&self) -> String {
        format!("{}, not all 0", Vector(self.0).words())
    }

    fn read(&self, at: &mut At) -> Option<Vec3> {
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

    fn json(&self, value: &Vec3) -> Value {
        Vector(self.0).json(value)
    }

    fn stand_in(&self) -> Vec3 {
        Vec3::zeros()
    }
}

/// Two counts, each with its own rule.
#[derive(Clone, Copy)]
pub(super) struct Counts(pub(super) [Count; 2]);

impl Rule for Counts {
    type Value = [u32; 2];

    fn words(&self) -> String {
        format!(
            "a list of 2 whole numbers: {} to {}, {} to {}",
            self.0[0].0, self.0[0].1, self.0[1].0, self.0[1].1
        )
    }

    fn read(&self, at: &mut At) -> Option<[u32; 2]> {
        at.items(&self.words(), |at, i| self.0[i].read(at))
    }

    fn schema(&self) -> Value {
        let counts = self.0.map(|count| count.schema());
        json!({ "type": "array", "prefixItems": counts, "minItems": 2, "maxItems": 2 })
    }

    fn json(&self, value: &[u32; 2]) -> Value {
        json!(value)
    }

    fn stand_in(&self) -> [u32; 2] {
        self.0.map(|count| count.0)
    }
}

/// A list of grid points `[x, y]`; whether they lie on the grid is checked later.
#[derive(Clone, Copy)]
pub(super) struct GridPoints;

impl Rule for GridPoints {
    type Value = Vec<[i64; 2]>;

    fn words(&self) -> String {
        "a list of grid points [x, y]".into()
    }

    fn read(&self, at: &mut At) -> Option<Vec<[i64; 2]>> {
        let Json::List(points) = &at.node.json else { return at.wrong_type(&self.words()) };
        let read = &mut |at: &mut At, _| at.items("a grid point [x, y]", |at, _| grid_index(at));
        let points: Vec<Option<[i64; 2]>> =
            points.iter().enumerate().map(|(i, point)| at.item(i, point, read)).collect();
        points.into_iter().collect()
    }

    fn schema(&self) -> Value {
        let points = list(2, &json!({ "type": "integer", "minimum": 0 }));
        json!({ "type": "array", "items": points, "uniqueItems": true })
    }

    fn json(&self, value: &Vec<[i64; 2]>) -> Value {
        json!(value)
    }

    fn stand_in(&self) -> Vec<[i64; 2]> {
        Vec::new()
    }
}

fn grid_index(at: &mut At) -> Option<i64> {
    let words = "a whole number";
    let Json::Number(value) = at.node.json else { return at.wrong_type(words) };
    whole(value).or_else(|| at.not_allowed("scene::out_of_range", words, ""))
}

/// The schema of a list of `length` values.
fn list(length: usize, items: &Value) -> Value {
    json!({ "type": "array", "items": items, "minItems": length, "maxItems": length })
}

/// The rule, or `null` for none.
#[derive(Clone, Copy)]
pub(super) struct OrNull<R>(pub(super) R);

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

    fn stand_in(&self) -> Option<R::Value> {
        None
    }
}
