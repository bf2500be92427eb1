//! Modules use only what stands before them in the list of layers.

use std::fs;
use std::path::{Path, PathBuf};

/// The list. Modules of one layer stand in order too: each may use those to its left.
const LAYERS: &[&[&str]] = &[
    &["text", "error", "tolerance", "math"],
    &["state", "measure"],
    &["mass"],
    &["shape"],
    &["effect", "freedom", "integrator", "closest"],
    &["impact"],
    &["contact"],
    &["scene"],
    &["plan"],
    &["report", "trajectory"],
    &["simulation"],
    &["reference"],
    &["compare", "batch"],
    &["catalogue", "export"],
    &["cli"],
    &["guide"],
];

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

#[test]
fn modules_use_only_what_stands_before_them() {
    let order: Vec<&str> = LAYERS.concat();
    let rank = |module: &str| order.iter().position(|m| *m == module);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let mut found = 0;
    for file in files {
        let inside = file.strip_prefix(&source).unwrap();
        let first = inside.components().next().unwrap().as_os_str().to_string_lossy().replace(".rs", "");
        if ["lib", "bin"].contains(&first.as_str()) {
            continue;
        }
        let own = rank(&first).unwrap_or_else(|| panic!("{first} is missing from the list of layers"));
        let text = fs::read_to_string(&file).unwrap();
        // code beneath `mod tests` may use what it likes, and docs may point anywhere
        let code = text.split("#[cfg(test)]").next().unwrap();
        for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for used in line.split("crate::").skip(1) {
                let module: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                let Some(other) = rank(&module) else { continue };
                found += 1;
                assert!(
                    other <= own,
                    "{}: {first} uses {module}, which stands after it: {}",
                    inside.display(),
                    line.trim()
                );
            }
        }
    }
    assert!(found > 100, "only {found} uses found: the test reads nothing");
}
