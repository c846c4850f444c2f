//! Scene files: values, errors, schema.

mod errors;
mod robust;
mod schema;
mod values;
