//! JSON merge patches (RFC 7396).

use std::collections::BTreeMap;

use super::node::{Json, Member, Node};

/// `target` changed by a JSON merge patch (RFC 7396): objects are merged, `null` removes, anything
/// else replaces.
pub(crate) fn merge(target: Node, patch: Node) -> Node {
    let Json::Object(changes) = patch.json else { return patch };
    let (span, members) = match target.json {
        Json::Object(members) => (target.span, members),
        _ => (patch.span, Vec::new()),
    };
    let mut places: BTreeMap<String, usize> =
        members.iter().enumerate().map(|(i, member)| (member.key.clone(), i)).collect();
    let mut slots: Vec<Option<Member>> = members.into_iter().map(Some).collect();
    for change in changes {
        let place = *places.entry(change.key.clone()).or_insert_with(|| {
            slots.push(None);
            slots.len() - 1
        });
        if let Some(slot) = slots.get_mut(place) {
            *slot = merged_member(slot.take(), change);
        }
    }
    Node { span, json: Json::Object(slots.into_iter().flatten().collect()) }
}

fn merged_member(old: Option<Member>, change: Member) -> Option<Member> {
    if change.value.json == Json::Null {
        return None;
    }
    let absent = Node { span: change.value.span, json: Json::Null };
    Some(match old {
        Some(old) => Member { value: merge(old.value, change.value), ..old },
        None => Member { value: merge(absent, change.value), ..change },
    })
}

#[cfg(test)]
mod tests {
    use super::super::testing::node;
    use super::*;

    #[test]
    fn merge_gives_every_example_of_rfc_7396() {
        // Appendix A: original, patch, result.
        let examples = [
            (r#"{"a":"b"}"#, r#"{"a":"c"}"#, r#"{"a":"c"}"#),
            (r#"{"a":"b"}"#, r#"{"b":"c"}"#, r#"{"a":"b","b":"c"}"#),
            (r#"{"a":"b"}"#, r#"{"a":null}"#, r#"{}"#),
            (r#"{"a":"b","b":"c"}"#, r#"{"a":null}"#, r#"{"b":"c"}"#),
            (r#"{"a":["b"]}"#, r#"{"a":"c"}"#, r#"{"a":"c"}"#),
            (r#"{"a":"c"}"#, r#"{"a":["b"]}"#, r#"{"a":["b"]}"#),
            (r#"{"a":{"b":"c"}}"#, r#"{"a":{"b":"d","c":null}}"#, r#"{"a":{"b":"d"}}"#),
            (r#"{"a":[{"b":"c"}]}"#, r#"{"a":[1]}"#, r#"{"a":[1]}"#),
            (r#"["a","b"]"#, r#"["c","d"]"#, r#"["c","d"]"#),
            (r#"{"a":"b"}"#, r#"["c"]"#, r#"["c"]"#),
            (r#"{"a":"foo"}"#, r#"null"#, r#"null"#),
            (r#"{"a":"foo"}"#, r#""bar""#, r#""bar""#),
            (r#"{"e":null}"#, r#"{"a":1}"#, r#"{"e":null,"a":1}"#),
            (r#"[1,2]"#, r#"{"a":"b","c":null}"#, r#"{"a":"b"}"#),
            (r#"{}"#, r#"{"a":{"bb":{"ccc":null}}}"#, r#"{"a":{"bb":{}}}"#),
        ];
        for (original, patch, result) in examples {
            let merged = merge(node(original), node(patch));
            assert_eq!(merged.plain(), node(result).plain(), "{original} with {patch}");
        }
    }
}
