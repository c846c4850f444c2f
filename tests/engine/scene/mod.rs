//! Scene files: values, errors, schema.

mod changes;
mod errors;
mod robust;
mod page;
mod schema;
mod values;
mod without_effect;
