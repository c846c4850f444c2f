//! What a value must be: small rules, composed in `fields.rs` into one line for each key.

use super::format::{Json, Node, quoted, shown};
use super::nearest::did_you_mean;
use super::report::{Finding, Report};
use super::{Vec3, range::Range, range::SMALLEST};

/// A value in a scene file and the dotted key that leads to it.
pub(super) struct At<'a> {
    pub(super) report: &'a mut Report,
    pub(super) key: &'a str,
    pub(super) node: &'a Node,
}

/// What a value must be, and how it is read.
pub(super) trait Rule {
    /// What the value becomes.
    type Value;
    /// What is allowed, in plain words: "a number from 0 to 1".
    fn words(&self) -> String;
    /// The value; nothing, after a report, if it is not allowed.
    fn read(&self, at: &mut At) -> Option<Self::Value>;
    /// Stands in for a value that is wrong or missing, in a scene that is thrown away.
    fn stand_in(&self) -> Self::Value;
}

impl At<'_> {
    /// Reports a value of the wrong type.
    pub(super) fn wrong_type<T>(&mut self, words: &str) -> Option<T> {
        let help = match &self.node.json {
            Json::Text(text) if words.contains("number") && text.trim().parse::<f64>().is_ok() => {
                "write the number without quotes"
            }
            _ => "",
        };
        let kind = self.node.kind();
        let message = format!("{} is {kind} but must be {words}", quoted(self.key));
        let finding = Finding::new("scene::wrong_type", message)
            .at(self.node.span, "wrong type")
            .key(self.key)
            .help(help);
        self.report.error(finding);
        None
    }

    /// Reports a value that its rule does not allow.
    pub(super) fn not_allowed<T>(&mut self, code: &'static str, words: &str, help: &str) -> Option<T> {
        let found = shown(self.report.text(self.node.span));
        let message = format!("{} is {found} but must be {words}", quoted(self.key));
        let finding = Finding::new(code, message).at(self.node.span, "not allowed").key(self.key).help(help);
        self.report.error(finding);
        None
    }

    /// The items of a list of exactly `N` values, each read by `read` with its number.
    fn items<T, const N: usize>(
        &mut self,
        words: &str,
        mut read: impl FnMut(&mut At, usize) -> Option<T>,
    ) -> Option<[T; N]> {
        let Json::List(items) = &self.node.json else { return self.wrong_type(words) };
        if items.len() != N {
            let message = format!("`{}` has {} values but must be {words}", self.key, items.len());
            let finding =
                Finding::new("scene::wrong_length", message).at(self.node.span, "wrong length").key(self.key);
            self.report.error(finding);
            return None;
        }
        let values: Vec<Option<T>> =
            items.iter().enumerate().map(|(i, node)| self.item(i, node, &mut read)).collect();
        let values: Vec<T> = values.into_iter().collect::<Option<_>>()?;
        values.try_into().ok()
    }

    fn item<T>(
        &mut self,
        i: usize,
        node: &Node,
        read: &mut impl FnMut(&mut At, usize) -> Option<T>,
    ) -> Option<T> {
        let key = format!("{}.{i}", self.key);
        read(&mut At { report: self.report, key: &key, node }, i)
    }
}

/// A number in a range.
#[derive(Clone, Copy)]
pub(super) struct Number(pub(super) Range);

impl Rule for Number {
    type Value = f64;

    fn words(&self) -> String {
        format!("a number {}", self.0.words())
    }

    fn read(&self, at: &mut At) -> Option<f64> {
        match at.node.json {
            Json::Number(value) if self.0.contains(value) => Some(value),
            Json::Number(_) => at.not_allowed("scene::out_of_range", &self.0.words(), ""),
            _ => at.wrong_type(&self.words()),
        }
    }

    fn stand_in(&self) -> f64 {
        self.0.min
    }
}

/// A whole number in a range; `50.0` is one.
#[derive(Clone, Copy)]
pub(super) struct Count(pub(super) u32, pub(super) u32);

impl Rule for Count {
    type Value = u32;

    fn words(&self) -> String {
        format!("a whole number from {} to {}", self.0, self.1)
    }

    fn read(&self, at: &mut At) -> Option<u32> {
        let Json::Number(value) = at.node.json else { return at.wrong_type(&self.words()) };
        match whole(value).and_then(|whole| u32::try_from(whole).ok()) {
            Some(count) if (self.0..=self.1).contains(&count) => Some(count),
            _ => at.not_allowed("scene::out_of_range", &self.words(), ""),
        }
    }

    fn stand_in(&self) -> u32 {
        self.0
    }
}

/// `value` as an integer, if it is one of at most 2^53.
pub(super) fn whole(value: f64) -> Option<i64> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    #[expect(clippy::cast_possible_truncation, reason = "the guard leaves exact integers only")]
    (value.fract() == 0.0 && (-EXACT..=EXACT).contains(&value)).then_some(value as i64)
}

/// `true` or `false`.
#[derive(Clone, Copy)]
pub(super) struct Flag;

impl Rule for Flag {
    type Value = bool;

    fn words(&self) -> String {
        "true or false".into()
    }

    fn read(&self, at: &mut At) -> Option<bool> {
        match at.node.json {
            Json::Bool(value) => Some(value),
            _ => at.wrong_type(&self.words()),
        }
    }

    fn stand_in(&self) -> bool {
        false
    }
}

/// One of a few names.
#[derive(Clone, Copy)]
pub(super) struct Choice<T: 'static>(pub(super) &'static [(&'static str, T)]);

impl<T: Copy> Rule for Choice<T> {
    type Value = T;

    fn words(&self) -> String {
        alternatives(self.0.iter().map(|(name, _)| format!("\"{name}\"")))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Text(text) = &at.node.json else { return at.wrong_type(&self.words()) };
        let known = self.0.iter().find(|(name, _)| name == text);
        known.map(|(_, value)| *value).or_else(|| {
            let help = did_you_mean(text, self.0.iter().map(|(name, _)| *name)).unwrap_or_default();
            at.not_allowed("scene::unknown_value", &self.words(), &help)
        })
    }

    fn stand_in(&self) -> T {
        self.0[0].1
    }
}

/// One of a few whole numbers.
#[derive(Clone, Copy)]
pub(super) struct Coded<T: 'static>(pub(super) &'static [(i64, T)]);

impl<T: Copy> Rule for Coded<T> {
    type Value = T;

    fn words(&self) -> String {
        alternatives(self.0.iter().map(|(code, _)| code.to_string()))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Number(value) = at.node.json else {
            return at.wrong_type(&format!("the number {}", self.words()));
        };
        let known = self.0.iter().find(|(code, _)| whole(value) == Some(*code));
        known.map(|(_, value)| *value).or_else(|| at.not_allowed("scene::unknown_value", &self.words(), ""))
    }

    fn stand_in(&self) -> T {
        self.0[0].1
    }
}

/// The name of a texture: part of a file name, so letters, digits, `_` and `-` only.
#[derive(Clone, Copy)]
pub(super) struct Name;

impl Rule for Name {
    type Value = String;

    fn words(&self) -> String {
        "a name of letters, digits, `_` and `-`".into()
    }

    fn read(&self, at: &mut At) -> Option<String> {
        let Json::Text(text) = &at.node.json else { return at.wrong_type(&self.words()) };
        let plain = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
        if (1..=64).contains(&text.len()) && text.chars().all(plain) {
            return Some(text.clone());
        }
        at.not_allowed("scene::bad_name", &self.words(), "give the name without folder and ending")
    }

    fn stand_in(&self) -> String {
        String::new()
    }
}

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

    fn stand_in(&self) -> Vec<[i64; 2]> {
        Vec::new()
    }
}

fn grid_index(at: &mut At) -> Option<i64> {
    let words = "a whole number";
    let Json::Number(value) = at.node.json else { return at.wrong_type(words) };
    whole(value).or_else(|| at.not_allowed("scene::out_of_range", words, ""))
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

    fn stand_in(&self) -> Option<R::Value> {
        None
    }
}

fn alternatives(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        all => all.concat(),
    }
}
