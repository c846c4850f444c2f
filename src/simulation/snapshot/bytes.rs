//! A state as bytes: a line of JSON that says what it is, the arrays as f64 little-endian, and a checksum.
//!
//! After the line, which ends with a line feed, come the arrays one after the other, each as all x, all y and all z.
//! The last eight bytes are the hash of all bytes before them, little-endian.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Seen, Snapshot};
use crate::cloth::{Counters, Points};
use crate::diagnostics::ledger::Ledger;
use crate::error::{Error, Kind, Result};
use crate::math::StateHash;

/// The number of this format.
const FORMAT: u32 = 1;

/// Most steps, or of anything else that is counted: more than a run ever has, and less than what overflows.
const MOST: u64 = 1 << 62;

/// Bytes of the checksum.
const CHECKSUM: usize = 8;

/// The line of JSON.
#[derive(Serialize, Deserialize)]
struct Header {
    /// The number of the format.
    drape_state: u32,
    version: String,
    frame: u64,
    steps: u64,
    steps_per_frame: u64,
    points: usize,
    arrays: usize,
    counters: Counters,
    /// The entries of the ledger, in J: numbers, or text where they are infinite or NaN.
    ledger: Option<Vec<Value>>,
    #[serde(default, skip_serializing_if = "Seen::is_nothing")]
    seen: Seen,
    scene: Vec<(String, Value)>,
}

impl Header {
    /// Whether the numbers are those of a run, and agree with each other.
    fn is_possible(&self) -> bool {
        let counts = json!(self.counters);
        let mut counted = counts.as_object().into_iter().flat_map(|counts| counts.values());
        let of_scene = self.scene.iter().find(|(path, _)| path == "sim.steps_per_frame");
        self.steps <= MOST
            && counted.all(|count| count.as_u64().is_some_and(|count| count <= MOST))
            && self.steps.checked_div(self.steps_per_frame) == Some(self.frame)
            && of_scene.and_then(|(_, value)| value.as_u64()) == Some(self.steps_per_frame)
            && (self.points == 0) == (self.arrays == 0)
    }
}

impl Snapshot {
    /// The bytes of a state file.
    pub fn encode(&self) -> Vec<u8> {
        let header = Header {
            drape_state: FORMAT,
            version: self.version.clone(),
            frame: self.frame(),
            steps: self.steps,
            steps_per_frame: self.steps_per_frame,
            points: self.arrays.first().map_or(0, Points::len),
            arrays: self.arrays.len(),
            counters: self.counters,
            ledger: self.ledger.map(|ledger| ledger.entries().map(|(_, joules)| entry(joules)).collect()),
            seen: self.seen,
            scene: self.scene.clone(),
        };
        // Numbers, names and lists of them are always JSON.
        let mut bytes = serde_json::to_vec(&header).unwrap_or_default();
        bytes.push(b'\n');
        let components = self.arrays.iter().flat_map(Points::components);
        bytes.extend(components.flatten().flat_map(|number| number.to_le_bytes()));
        let sum = checksum(&bytes);
        bytes.extend(sum);
        bytes
    }

    /// The state in the bytes of a file.
    ///
    /// # Errors
    /// [`Kind::Io`] when they are not those of a whole state file.
    pub fn decode(bytes: &[u8]) -> Result<Self> {
        let (content, sum) = bytes.split_at_checked(bytes.len().saturating_sub(CHECKSUM)).unwrap_or_default();
        let end = content.iter().position(|&byte| byte == b'\n').ok_or_else(no_state)?;
        let (line, arrays) = content.split_at(end);
        let format = serde_json::from_slice::<Format>(line).map_err(|_| no_state())?;
        if format.drape_state != FORMAT {
            let message = format!("the state has format {}, and {FORMAT} can be read", format.drape_state);
            return Err(Error::new(Kind::Io, message));
        }
        if sum != checksum(content) {
            return Err(damaged());
        }
        let header: Header = serde_json::from_slice(line).map_err(|_| damaged())?;
        if !header.is_possible() {
            return Err(damaged());
        }
        let arrays = points(arrays.get(1..).unwrap_or_default(), header.points, header.arrays);
        let ledger = header.ledger.as_ref().map(|entries| ledger(entries).ok_or_else(damaged));
        Ok(Self {
            version: header.version,
            scene: header.scene,
            steps: header.steps,
            steps_per_frame: header.steps_per_frame,
            counters: header.counters,
            ledger: ledger.transpose()?,
            seen: header.seen,
            arrays: arrays.ok_or_else(damaged)?,
        })
    }
}

/// An entry of the ledger. JSON has no numbers for what is infinite or NaN.
fn entry(joules: f64) -> Value {
    if joules.is_finite() { json!(joules) } else { json!(joules.to_string()) }
}

/// The ledger of so many entries.
fn ledger(entries: &[Value]) -> Option<Ledger> {
    let number = |entry: &Value| entry.as_f64().or_else(|| entry.as_str()?.parse().ok());
    Ledger::from_entries(&entries.iter().map(number).collect::<Option<Vec<f64>>>()?)
}

/// What the line of every format says.
#[derive(Deserialize)]
struct Format {
    drape_state: u32,
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut hash = StateHash::default();
    hash.write(bytes);
    hash.finish().to_le_bytes()
}

/// So many arrays of so many points; nothing if there are more or fewer bytes.
fn points(bytes: &[u8], points: usize, arrays: usize) -> Option<Vec<Points>> {
    if points.checked_mul(arrays)?.checked_mul(24)? != bytes.len() {
        return None;
    }
    let (numbers, _) = bytes.as_chunks::<8>();
    let numbers: Vec<f64> = numbers.iter().map(|&number| f64::from_le_bytes(number)).collect();
    let array = |n: usize| {
        let component =
            |c: usize| Some(numbers.get((3 * n + c) * points..(3 * n + c + 1) * points)?.to_vec());
        Some(Points { x: component(0)?, y: component(1)?, z: component(2)? })
    };
    (0..arrays).map(array).collect()
}

fn no_state() -> Error {
    Error::new(Kind::Io, "this is no state file").with_help("--save-state writes one")
}

fn damaged() -> Error {
    Error::new(Kind::Io, "the state file is damaged or not whole").with_help("simulate from the start")
}
