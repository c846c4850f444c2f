//! Data flows one way, in each of the three crates: a module uses only modules that the root
//! declares above it, and no files import each other in a circle. Cargo keeps the crates in order.

mod imports;

use std::collections::BTreeSet;

use imports::Crate;

/// The longest file that may be, in lines; tables of data are longer.
const LONGEST: usize = 300;

fn crates() -> [(&'static str, Crate); 3] {
    ["src/lib.rs", "lab/src/lib.rs", "cli/src/lib.rs"]
        .map(|root| (root, Crate::read(&crate::repository::path(root))))
}

#[test]
fn a_module_uses_only_modules_that_are_declared_above_it() {
    for (root, found) in crates() {
        let (_, top) = found.modules().next().unwrap();
        assert!(top.declared.len() > 3, "{root} declares {:?}", top.declared);
        let place = |path: &[String]| top.declared.iter().position(|module| Some(module) == path.first());
        let mut wrong = Vec::new();
        for (path, module) in found.modules().filter(|(path, _)| !path.is_empty()) {
            let below = found.imports(path).into_iter().filter(|to| place(to) > place(path));
            wrong.extend(below.map(|to| format!("{} uses {}", module.file.display(), to.join("::"))));
        }
        assert_eq!(wrong, Vec::<String>::new(), "{root}");
    }
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    for (root, found) in crates() {
        let mut circles = Vec::new();
        for (path, _) in found.modules() {
            let mut reached = BTreeSet::new();
            let mut ahead = found.imports(path);
            while let Some(next) = ahead.pop() {
                if reached.insert(next) {
                    ahead.extend(found.imports(next));
                }
            }
            if reached.contains(path) {
                circles.push(path.join("::"));
            }
        }
        assert_eq!(circles, Vec::<String>::new(), "{root}");
    }
}

#[test]
fn files_are_short_enough_to_be_read_in_one_go() {
    for (root, found) in crates() {
        let mut lines: Vec<usize> = found.modules().map(|(_, module)| module.lines).collect();
        lines.sort_unstable();
        let median = lines[lines.len() / 2];
        assert!(median <= 130, "{root}: half of the files have more than {median} lines");
        let long = found.modules().filter(|(_, module)| module.lines > LONGEST);
        let long: Vec<_> =
            long.map(|(_, module)| (module.file.display().to_string(), module.lines)).collect();
        assert_eq!(long, [], "{root}");
    }
}
