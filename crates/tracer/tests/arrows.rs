//! Inside the tracer imports run downwards only: a module uses those below it, never one above.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of the crate from top to bottom. Modules of one row stand side by side and do not use each other.
const LAYERS: &[&[&str]] = &[
    &["caster", "picture"],
    &["target", "irradiance"],
    &["render", "query", "pick"],
    &["backend"],
    &["integrator"],
    &["shade"],
    &["stream"],
    &["search"],
    &["lamps"],
    &["cull"],
    &["rays", "frame"],
    &["edges"],
    &["snapshot"],
    &["kernel"],
    &["accel"],
    &["display"],
    &["film"],
    &["sample"],
    &["view", "receiver"],
    &["pattern", "filter"],
    &["sampler", "instructions", "stats", "pool"],
    &["lanes", "random"],
    &["numeric"],
];

fn rank(module: &str) -> usize {
    let found = LAYERS.iter().position(|layer| layer.contains(&module));
    found.unwrap_or_else(|| panic!("the module `{module}` has no layer: add it to the list"))
}

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of sources").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files
}

/// The top module that a file belongs to.
fn module_of(file: &Path) -> String {
    let inside = file.strip_prefix(source()).expect("a file of the crate");
    let first = inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_owned()
}

/// The paths of a `use` tree such as `crate::{a::{B, C}, D}`, in full.
fn paths(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else { return vec![tree.to_owned()] };
    let (prefix, inner) = (&tree[..open], &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())]);
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inner[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&inner[start..]);
    let parts = parts.into_iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| paths(part).into_iter().map(|rest| format!("{prefix}{rest}"))).collect()
}

/// All `use` trees of a source text, joined to one line each.
fn uses(text: &str) -> Vec<String> {
    let statements = text.split("\nuse ").skip(1).chain(text.split("\npub use ").skip(1));
    statements.filter_map(|rest| Some(rest.split_once(';')?.0.replace('\n', " "))).collect()
}

/// Which module each name comes from that the crate's root gives on.
fn reexports() -> HashMap<String, String> {
    let root = fs::read_to_string(source().join("lib.rs")).expect("the crate's root");
    let all = uses(&root).into_iter().flat_map(|tree| paths(&tree));
    all.filter_map(|path| {
        let (module, name) = path.split_once("::")?;
        Some((name.trim().to_owned(), module.trim().to_owned()))
    })
    .collect()
}

#[test]
fn imports_run_downwards() {
    let given_on = reexports();
    let mut wrong = Vec::new();
    let mut arrows = 0;
    for file in rust_files(&source()) {
        let module = module_of(&file);
        if module == "lib" || file.ends_with("error_bounds_tests.rs") {
            continue;
        }
        let text = fs::read_to_string(&file).expect("a source file");
        for path in uses(&text).iter().flat_map(|tree| paths(tree)) {
            let Some(rest) = path.trim().strip_prefix("crate::") else { continue };
            let first = rest.split("::").next().unwrap_or(rest).trim();
            let target = given_on.get(first).map_or(first, String::as_str);
            // What another crate is given on from lies below all modules.
            if target == module || target.starts_with("catoptra_") {
                continue;
            }
            arrows += 1;
            if rank(target) <= rank(&module) {
                wrong.push(format!("{} uses {path}", file.display()));
            }
        }
    }
    assert!(arrows > 100, "only {arrows} imports were found: are they read rightly?");
    assert!(wrong.is_empty(), "imports that run upwards or sideways:\n{}", wrong.join("\n"));
}
