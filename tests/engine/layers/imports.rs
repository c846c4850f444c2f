//! Which file of a crate names what of which other, read off the text of its sources.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of a crate by their paths; the root has the empty one.
pub(super) struct Crate {
    modules: BTreeMap<Vec<String>, Module>,
}

/// A module: its file, the paths that it names, and what it hands on from modules below.
pub(super) struct Module {
    pub(super) file: PathBuf,
    pub(super) lines: usize,
    /// The modules that it declares, in order.
    pub(super) declared: Vec<String>,
    used: Vec<Vec<String>>,
    handed_on: Vec<Vec<String>>,
}

impl Crate {
    /// The crate whose root file is `root`.
    pub(super) fn read(root: &Path) -> Self {
        let mut found = Self { modules: BTreeMap::new() };
        found.add(root, Vec::new());
        found
    }

    fn add(&mut self, file: &Path, path: Vec<String>) {
        let module = Module::new(file, &path);
        let inside = if path.is_empty() || file.ends_with("mod.rs") {
            file.parent().unwrap().to_owned()
        } else {
            file.with_extension("")
        };
        for child in &module.declared {
            let files = [inside.join(format!("{child}.rs")), inside.join(child).join("mod.rs")];
            if let Some(file) = files.iter().find(|file| file.exists()) {
                self.add(file, [&path[..], std::slice::from_ref(child)].concat());
            }
        }
        self.modules.insert(path, module);
    }

    pub(super) fn modules(&self) -> impl Iterator<Item = (&[String], &Module)> {
        self.modules.iter().map(|(path, module)| (&path[..], module))
    }

    /// The modules in which stands what the module at `path` names, itself left out.
    pub(super) fn imports(&self, path: &[String]) -> Vec<&[String]> {
        let mut found: Vec<_> = self.modules[path].used.iter().map(|used| self.resolve(used)).collect();
        found.retain(|to| *to != path);
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The module that holds what `used` names: the last that the path names, or one below that hands
    /// the next name on.
    fn resolve(&self, used: &[String]) -> &[String] {
        let is_module = |depth: &usize| self.modules.contains_key(&used[..*depth]);
        let depth = (0..=used.len()).rev().find(is_module).unwrap_or(0);
        let (path, module) = self.modules.get_key_value(&used[..depth]).unwrap();
        let on = used.get(depth).and_then(|name| module.handed_on.iter().find(|on| on.last() == Some(name)));
        on.map_or(path, |on| self.resolve(on))
    }
}

impl Module {
    fn new(file: &Path, path: &[String]) -> Self {
        let text = fs::read_to_string(file).unwrap();
        let lines = text.lines().count();
        let code = without_comments_and_tests(&text);
        let declared =
            statements(&code, "mod ").into_iter().map(|(_, name)| name.trim().to_owned()).collect();
        let mut module =
            Self { file: file.to_owned(), lines, declared, used: Vec::new(), handed_on: Vec::new() };
        let mut rest = code.clone();
        for (public, tree) in statements(&code, "use ") {
            rest = rest.replacen(&tree, "", 1);
            let paths = leaves(&tree).into_iter().filter_map(|leaf| module.absolute(path, &leaf));
            let paths: Vec<_> = paths.collect();
            if public { module.handed_on.extend(paths) } else { module.used.extend(paths) }
        }
        for start in ["crate::", "super::"] {
            for (at, _) in rest.match_indices(start).filter(|(at, _)| !rest[..*at].ends_with("::")) {
                let word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
                let end = rest[at..].find(|c| !word(c)).map_or(rest.len(), |length| at + length);
                module.used.extend(module.absolute(path, rest[at..end].trim_end_matches(':')));
            }
        }
        module
    }

    /// A path as it is written in the module at `here`, from the root; none for one of another crate.
    fn absolute(&self, here: &[String], written: &str) -> Option<Vec<String>> {
        let mut segments = written.split("::").map(str::to_owned).peekable();
        let mut path = match segments.peek()?.as_str() {
            "crate" => Vec::new(),
            "super" | "self" => here.to_vec(),
            first if self.declared.iter().any(|child| child == first) => here.to_vec(),
            _ => return None,
        };
        for segment in segments {
            match segment.as_str() {
                "crate" | "self" => {}
                "super" => drop(path.pop()),
                _ => path.push(segment),
            }
        }
        Some(path)
    }
}

/// The text without comment lines, and without what follows the first `#[cfg(test)]`.
fn without_comments_and_tests(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or(text);
    code.lines().filter(|line| !line.trim_start().starts_with("//")).map(|line| format!("{line}\n")).collect()
}

/// What stands between `keyword` and the semicolon of each such statement; whether it is public.
fn statements(code: &str, keyword: &str) -> Vec<(bool, String)> {
    let starts = code.match_indices(keyword).filter_map(|(at, _)| {
        let line = code[..at].rfind('\n').map_or(0, |end| end + 1);
        let before = code[line..at].trim();
        let body = &code[at + keyword.len()..];
        let end = body.find(';')?;
        let whole =
            before.is_empty() || before == "pub" || before.starts_with("pub(") && before.ends_with(')');
        let is_path = !body[..end].contains(['=', '"', '#']);
        (whole && is_path).then(|| (!before.is_empty(), body[..end].to_owned()))
    });
    starts.collect()
}

/// The paths of a tree of imports such as `a::{b, c::{self, d}}`.
fn leaves(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((prefix, group)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or(tree);
        return vec![path.trim_end_matches("::self").trim_end_matches("::*").to_owned()];
    };
    let group = group.strip_suffix('}').unwrap_or(group);
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in group.char_indices().chain([(group.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                items.push(group[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    let inside = items.into_iter().filter(|item| !item.is_empty());
    inside.flat_map(|item| leaves(&format!("{prefix}{item}"))).collect()
}

#[test]
fn imports_are_read_as_the_compiler_reads_them() {
    assert_eq!(
        leaves("crate::a::{self, b, c::{D, E as F}}"),
        ["crate::a", "crate::a::b", "crate::a::c::D", "crate::a::c::E"]
    );
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, text).unwrap();
    };
    write("lib.rs", "pub mod a;\nmod b;\n");
    write("a/mod.rs", "mod c;\npub use c::Thing;\nfn f() { crate::b::g() }\n");
    write("a/c.rs", "// use crate::b;\npub struct Thing;\n#[cfg(test)]\nmod tests { use crate::b; }\n");
    write("b.rs", "use crate::a::Thing;\npub fn g() {}\n");
    let found = Crate::read(&folder.path().join("lib.rs"));
    let imports = |path: &[&str]| -> Vec<String> {
        let path: Vec<String> = path.iter().map(|part| (*part).to_owned()).collect();
        found.imports(&path).iter().map(|to| to.join("::")).collect()
    };
    assert_eq!(imports(&["b"]), ["a::c"], "through what is handed on");
    assert_eq!(imports(&["a"]), ["b"], "in the middle of code");
    assert_eq!(imports(&["a", "c"]), Vec::<String>::new(), "comments and tests do not count");
}
