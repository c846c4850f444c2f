//! The table of an object's keys: one row a key, from which its field, its documentation, its rule
//! and its default are made.

/// Makes a struct, the function that reads it from an object of a document, and the one that lists its values.
///
/// A row is `/// meaning`, then `key: Type => [default] rule;`. The field has the name of the key.
/// - `[required]` is for a key that must be given.
/// - `[inherited]` is for an object whose keys default to those of the document's object of that name;
///   then a function that reads it stands in the place of the rule.
/// - `, local` after the rule is for a name that means something else in other objects.
///
/// The first paragraph of the meaning is for users: it stands in the schema and in the tables of keys.
macro_rules! keys {
    ($(#[$attribute:meta])* pub struct $object:ident {
        $($(#[doc = $doc:literal])* $key:ident: $type:ty => [$($default:tt)*] $rule:expr $(, $local:ident)?;)*
    }) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $object {
            $(
                $(#[doc = $doc])*
                #[doc = ""]
                #[doc = concat!("Default: `", stringify!($($default)*), "`; rule: `", stringify!($rule), "`.")]
                pub $key: $type,
            )*
        }

        impl $crate::scene::json::key::Listed for $object {
            fn list(&self, path: &str, list: &mut Vec<(String, serde_json::Value)>) {
                $($crate::scene::json::keys::keys!(@list self, path, list, $key, [$($default)*] $rule);)*
            }
        }

        impl $object {
            /// Reads every key of an object.
            pub(super) fn read(at: &mut $crate::scene::json::object::Object) -> Self {
                Self {
                    $($key: $crate::scene::json::keys::keys!(
                        @read at, $crate::scene::json::key::Row {
                            name: stringify!($key),
                            doc: &[$($doc),*],
                            local: !stringify!($($local)?).is_empty(),
                        }, [$($default)*] $rule
                    ),)*
                }
            }
        }
    };
    (@list $self:ident, $path:ident, $list:ident, $key:ident, [inherited] $rule:expr) => {};
    (@list $self:ident, $path:ident, $list:ident, $key:ident, [$($default:tt)*] $rule:expr) => {
        $list.push((
            $crate::scene::json::text::join($path, stringify!($key)),
            $crate::scene::json::rule::Rule::json(&$rule, &$self.$key),
        ))
    };
    (@read $at:ident, $row:expr, [required] $rule:expr) => { $at.required($row, $rule) };
    (@read $at:ident, $row:expr, [inherited] $read:expr) => { $at.inherited($row, $read).unwrap_or_default() };
    (@read $at:ident, $row:expr, [$default:expr] $rule:expr) => { $at.optional($row, $default, $rule) };
}
pub(crate) use keys;
