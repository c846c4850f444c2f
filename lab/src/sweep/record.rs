//! What came of a case.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::store::{Address, Entry, Store};
use drape::error::{Error, Result};

/// The ending of the pictures in the store.
const PICTURE: &str = ".png";

/// A measured value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Measured {
    /// A number.
    Number(f64),
    /// A word or a hash.
    Text(String),
    /// Nothing: not reached, or no number.
    Nothing,
}

/// The end of a case: as that of a command, and what was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The exit code that `drape simulate` would have ended with.
    pub exit_code: u8,
    /// The message of the error; empty if there was none.
    pub message: String,
    /// The measures by name; of a case that failed only those that are known all the same.
    pub values: BTreeMap<String, Measured>,
    /// The hash of the picture's file, if there is one.
    pub picture: Option<String>,
}

impl Record {
    /// The record of a case that failed.
    pub(super) fn failed(error: &Error) -> Self {
        let exit_code = error.kind.exit_code();
        Self { exit_code, message: error.message.clone(), values: BTreeMap::new(), picture: None }
    }

    /// The end of the case in a word.
    pub fn outcome(&self) -> &'static str {
        match self.exit_code {
            0 => "ok",
            3 => "refused",
            5 => "unstable",
            6 => "out of time",
            _ => "failed",
        }
    }

    /// The measure called `name`.
    pub fn value(&self, name: &str) -> &Measured {
        self.values.get(name).unwrap_or(&Measured::Nothing)
    }

    /// The number of a measure, if it is one.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.value(name) {
            Measured::Number(number) => Some(*number),
            Measured::Text(_) | Measured::Nothing => None,
        }
    }
}

/// A number, if it is one that JSON can hold.
impl From<f64> for Measured {
    fn from(number: f64) -> Self {
        if number.is_finite() { Self::Number(number) } else { Self::Nothing }
    }
}

impl Store {
    /// The record at `address`; damaged too if its picture is not the one that was written.
    pub(super) fn record(&self, address: Address) -> Entry<Record> {
        match self.read::<Record>(address) {
            Entry::Whole(record) if record.picture.is_some() && self.picture(address, &record).is_none() => {
                Entry::Damaged
            }
            entry => entry,
        }
    }

    /// The bytes of the picture of a record, if they are those that were written.
    pub(super) fn picture(&self, address: Address, record: &Record) -> Option<Vec<u8>> {
        self.attached(address, PICTURE, record.picture.as_deref()?)
    }

    /// Stores a record, after its picture.
    ///
    /// # Errors
    /// [`drape::error::Kind::Io`] when a file cannot be written.
    pub(super) fn put_record(
        &self,
        address: Address,
        mut record: Record,
        picture: Option<&[u8]>,
    ) -> Result<()> {
        if let Some(bytes) = picture {
            record.picture = Some(self.attach(address, PICTURE, bytes)?);
        }
        self.put(address, &record)
    }
}
