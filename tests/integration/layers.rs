//! The order of the modules: each uses only what stands below it, and every file says what it is.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules of `src/`, lowest first.
const LAYERS: [&str; 18] = [
    "random", "picture", "camera", "tour", "solve", "suggest", "depth", "scene", "wind", "water", "motion",
    "maps", "assemble", "bake", "trace", "plugin", "headless", "editor",
];

/// Every file below `folder` with this ending, in order.
fn files_below(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files_below(&path, ending));
        } else if path.extension().is_some_and(|found| found == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn src() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The first step of every `crate::…` path of a line of code.
fn modules_used(line: &str) -> impl Iterator<Item = &str> {
    line.split("crate::").skip(1).map(|rest| {
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        &rest[..end]
    })
}

fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with("//")
}

#[test]
fn modules_use_only_what_stands_below_them() {
    let mut uses = 0;
    let mut wrong = Vec::new();
    for (rank, module) in LAYERS.iter().enumerate() {
        let files = files_below(&src().join(module), "rs");
        assert!(!files.is_empty(), "src/{module} has no file");
        // Tests may ask what stands above whether it can use what they made.
        for file in files.iter().filter(|file| !file.iter().any(|step| step == "tests")) {
            let source = fs::read_to_string(file).unwrap();
            for (number, line) in source.lines().enumerate().filter(|(_, line)| !is_comment(line)) {
                for used in modules_used(line) {
                    uses += 1;
                    if !LAYERS[..=rank].contains(&used) {
                        wrong.push(format!("{}:{}: {module} uses crate::{used}", file.display(), number + 1));
                    }
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "each module may use only those before it, one path at a time:\n{}",
        wrong.join("\n")
    );
    assert!(uses > 100, "only {uses} uses were found, so the search is broken");
}

#[test]
fn every_module_has_its_layer() {
    let mut modules: Vec<String> = fs::read_dir(src())
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|name| !["lib", "bin"].contains(&name.as_str()))
        .collect();
    modules.sort();
    let mut layers = LAYERS.map(str::to_owned);
    layers.sort();
    assert_eq!(modules, layers, "modules of src/ and layers of this test differ");
}

#[test]
fn the_program_uses_only_what_everybody_may() {
    for file in files_below(&src().join("bin"), "rs") {
        let source = fs::read_to_string(&file).unwrap();
        for module in LAYERS {
            let path = format!("src/{module}/");
            assert!(!source.contains(&path), "{} reaches into {path}", file.display());
        }
    }
}

#[test]
fn every_file_opens_with_what_it_is() {
    for file in files_below(&src(), "rs") {
        let source = fs::read_to_string(&file).unwrap();
        let opens = source.starts_with("//! ") || source.starts_with("#![doc = include_str!(");
        assert!(opens, "{} does not open with `//!`", file.display());
    }
    for file in files_below(&src(), "wgsl") {
        let source = fs::read_to_string(&file).unwrap();
        assert!(source.starts_with("// "), "{} does not open with a comment", file.display());
    }
}
