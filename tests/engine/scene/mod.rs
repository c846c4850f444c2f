//! Scene files: values, errors, schema.

mod errors;
mod robust;
mod page;
mod schema;
mod values;
mod without_effect;
