//! Holds every `crate::` path of the source against the table of allowed imports in `ARCHITECTURE.md`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Module -> modules it may import, read from the rows `| `module` | ... | imports |` of the table.
fn table() -> BTreeMap<String, BTreeSet<String>> {
    let text = std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let words =
        |cell: &str| -> Vec<String> { cell.split('`').skip(1).step_by(2).map(str::to_owned).collect() };
    let rows = text.lines().filter(|l| l.starts_with("| `"));
    let table: BTreeMap<_, _> = rows
        .filter_map(|row| {
            let cells: Vec<&str> = row.trim_matches('|').split('|').collect();
            let module = words(cells.first()?).into_iter().next()?;
            Some((module, words(cells.last()?).into_iter().collect()))
        })
        .collect();
    assert!(table.len() > 10, "the table of modules was not found");
    table
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

/// The top module that a file of `src` belongs to.
fn module_of(file: &Path) -> String {
    let inside = file.strip_prefix(root().join("src")).expect("inside src");
    let first = inside.components().next().expect("a component").as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_owned()
}

/// The top modules named by `crate::` paths of a source text, test modules left out: tests may use everything.
fn imports(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = BTreeSet::new();
    for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
        for part in line.split("crate::").skip(1) {
            if let Some(group) = part.strip_prefix('{') {
                let names = group.split(',').map(|p| p.trim().split("::").next().unwrap_or_default());
                found.extend(names.map(word).filter(|w| !w.is_empty()));
            } else {
                found.insert(word(part));
            }
        }
    }
    found
}

fn word(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

#[test]
fn imports_follow_the_table() {
    let table = table();
    let mut files = Vec::new();
    rust_files(&root().join("src"), &mut files);
    let mut faults = Vec::new();
    for file in files {
        let module = module_of(&file);
        if module == "lib" {
            continue;
        }
        let Some(allowed) = table.get(&module) else {
            faults.push(format!("module `{module}` is not in the table"));
            continue;
        };
        let text = std::fs::read_to_string(&file).expect("source file");
        for import in imports(&text) {
            if import != module && !allowed.contains(&import) && table.contains_key(&import) {
                faults.push(format!("{}: `{module}` must not import `{import}`", file.display()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_core_names_no_browser_gpu_clock_or_thread() {
    let forbidden = ["web_sys", "js_sys", "wasm_bindgen", "wgpu", "std::time", "std::thread", "std::env"];
    let mut files = Vec::new();
    rust_files(&root().join("src"), &mut files);
    for file in files.iter().filter(|f| !["web", "gpu", "bin"].contains(&module_of(f).as_str())) {
        let text = std::fs::read_to_string(file).expect("source file");
        for name in forbidden {
            assert!(!text.contains(name), "{} names {name}", file.display());
        }
    }
}
