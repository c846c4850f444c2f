//! Every key of a scene file, for those who document them.

use serde_json::Value;

use super::Scene;
use super::json::key::Key;
use super::json::{object, schema as json_schema};

/// Every key of a scene file, in the order of the documentation.
pub fn keys() -> Vec<Key> {
    object::list(Scene::read)
}

/// The JSON schema (draft 2020-12) of a scene file.
///
/// It accepts every scene that the reader accepts, and refuses unknown and missing keys, wrong types
/// and numbers out of range. What two values together make wrong (a pin outside the grid, a near
/// plane beyond the far one, a cloth of too many points) only the reader refuses. Each key has its
/// meaning and what it must be as `description`, and its `default` if that is always the same value.
pub fn schema() -> Value {
    json_schema::schema("A scene of drape", &keys())
}
