//! Checks the paths of the source against the table of allowed imports in `ARCHITECTURE.md`, and finds circles of imports between files.
//!
//! Paths are read from words and signs, without comments, strings and items that are compiled for tests only. A path is followed through
//! re-exports to the file that defines the name: a `mod.rs` that only declares and re-exports depends on nothing, and nothing depends on
//! it.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The rows `| `module` | ... | imports |` of the table: modules in order, each with those that it may import.
fn table() -> Vec<(String, BTreeSet<String>)> {
    let text = std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let words =
        |cell: &str| -> Vec<String> { cell.split('`').skip(1).step_by(2).map(str::to_owned).collect() };
    let rows = text.lines().filter(|l| l.starts_with("| `"));
    let table: Vec<_> = rows
        .filter_map(|row| {
            let cells: Vec<&str> = row.trim_matches('|').split('|').collect();
            let module = words(cells.first()?).into_iter().next()?;
            Some((module, words(cells.last()?).into_iter().collect()))
        })
        .collect();
    assert!(table.len() > 10, "the table of modules was not found");
    table
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

/// The words, `::` and other signs of a source text, without comments, strings, characters and lifetimes.
fn tokens(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let word = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let raw = rest.strip_prefix('r').map(|r| r.len() - r.trim_start_matches('#').len());
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(hashes) = raw.filter(|hashes| rest[1 + hashes..].starts_with('"')) {
            let end = format!("\"{}", "#".repeat(hashes));
            let inside = 2 + hashes;
            rest[inside..].find(&end).map_or(rest.len(), |at| inside + at + end.len())
        } else if c == '"' {
            quoted(rest, '"')
        } else if c == '\'' {
            // A character ends with a quote; a lifetime does not.
            let is_character = rest[1..].starts_with('\\') || rest.chars().nth(2) == Some('\'');
            if is_character { quoted(rest, '\'') } else { 1 }
        } else if word > 0 {
            found.push(rest[..word].to_owned());
            word
        } else if rest.starts_with("::") {
            found.push("::".to_owned());
            2
        } else {
            if !c.is_whitespace() {
                found.push(c.to_string());
            }
            c.len_utf8()
        };
        rest = &rest[skipped..];
    }
    found
}

/// The length of a literal with its quotes, in bytes.
fn quoted(text: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if c == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// The tokens without those of items for tests, since tests may use everything.
fn without_tests(tokens: &[String]) -> Vec<String> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if !tokens[at..].iter().take(MARK.len()).eq(MARK.iter()) {
            kept.push(tokens[at].clone());
            at += 1;
            continue;
        }
        at += MARK.len();
        let mut depth = 0_i32;
        while let Some(token) = tokens.get(at) {
            at += 1;
            match token.as_str() {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => depth -= 1,
                _ => {}
            }
            if depth == 0 && (token == ";" || token == "}") {
                break;
            }
        }
    }
    kept
}

/// A name brought into a file.
struct Import {
    path: Vec<String>,
    /// The name in the file; `*` for all names.
    name: String,
    is_public: bool,
}

/// The imports, paths and words of a source file.
struct Source {
    file: String,
    imports: Vec<Import>,
    /// Paths of at least two words outside of imports.
    paths: Vec<Vec<String>>,
    /// All words outside of imports.
    words: BTreeSet<String>,
}

fn is_word(token: &str) -> bool {
    token.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_')
}

impl Source {
    fn new(file: String, text: &str) -> Self {
        let tokens = without_tests(&tokens(text));
        let mut source = Self { file, imports: Vec::new(), paths: Vec::new(), words: BTreeSet::new() };
        let mut at = 0;
        while at < tokens.len() {
            let is_import = tokens[at] == "use" && tokens.get(at + 1).is_some_and(|next| next != "<");
            if is_import {
                let is_public = at > 0 && (tokens[at - 1] == "pub" || tokens[at - 1] == ")");
                at = source.read_import(&tokens, at + 1, &[], is_public);
            } else if tokens[at] == "mod" {
                at += 1;
            } else if is_word(&tokens[at]) {
                let mut path = vec![tokens[at].clone()];
                while tokens.get(at + 1).is_some_and(|t| t == "::")
                    && tokens.get(at + 2).is_some_and(|t| is_word(t))
                {
                    path.push(tokens[at + 2].clone());
                    at += 2;
                }
                source.words.extend(path.iter().cloned());
                if path.len() > 1 {
                    source.paths.push(path);
                }
            }
            at += 1;
        }
        source
    }

    /// Reads one tree of an import from the token `at` on, and returns the number of the token after it.
    fn read_import(&mut self, tokens: &[String], mut at: usize, prefix: &[String], is_public: bool) -> usize {
        let mut path = prefix.to_vec();
        loop {
            match tokens[at].as_str() {
                "::" => at += 1,
                "{" => {
                    at += 1;
                    while tokens[at] != "}" {
                        at = self.read_import(tokens, at, &path, is_public);
                        if tokens[at] == "," {
                            at += 1;
                        }
                    }
                    return at + 1;
                }
                "as" => {
                    self.imports.push(Import { path, name: tokens[at + 1].clone(), is_public });
                    return at + 2;
                }
                "," | "}" | ";" => {
                    if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
                        path.pop();
                    }
                    let name = path.last().cloned().unwrap_or_default();
                    self.imports.push(Import { path, name, is_public });
                    return at;
                }
                word => {
                    path.push(word.to_owned());
                    at += 1;
                }
            }
        }
    }
}

/// The library and the command line: source files by the paths of their modules. The first word is the crate.
struct House {
    sources: BTreeMap<Vec<String>, Source>,
}

const LIBRARY: &str = "conemap";
const COMMAND_LINE: &str = "bin";

impl House {
    fn read() -> Self {
        let folder = root().join("src");
        let mut files = Vec::new();
        rust_files(&folder, &mut files);
        files.retain(|file| file.file_name().is_some_and(|name| name != "tests.rs"));
        let sources = files.iter().map(|file| {
            let inside = file.strip_prefix(&folder).expect("inside src").to_string_lossy().replace('\\', "/");
            let mut module: Vec<String> =
                inside.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
            if module[0] == COMMAND_LINE {
                module.remove(1);
            } else {
                module.insert(0, LIBRARY.to_owned());
            }
            module.retain(|word| word != "mod" && word != "lib");
            (module, Source::new(inside, &std::fs::read_to_string(file).expect("source file")))
        });
        Self { sources: sources.collect() }
    }

    /// A path in the file of a module, completed from its crate on; `None` for paths outside of this project.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Vec<String>> {
        self.absolute_within(module, path, 8)
    }

    fn absolute_within(&self, module: &[String], path: &[String], depth: usize) -> Option<Vec<String>> {
        let (first, rest) = path.split_first()?;
        let below = |base: &[String]| Some([base, rest].concat());
        match first.as_str() {
            "crate" => below(&module[..1]),
            "self" => below(module),
            "super" => {
                let supers = path.iter().take_while(|word| *word == "super").count();
                let base = module.len().checked_sub(supers).filter(|length| *length > 0)?;
                Some([&module[..base], &path[supers..]].concat())
            }
            LIBRARY if module[0] == COMMAND_LINE => Some(path.to_vec()),
            _ => {
                let child = [module, &path[..1]].concat();
                if self.sources.contains_key(&child) {
                    return below(&child);
                }
                let source = &self.sources[module];
                let import = source.imports.iter().find(|import| import.name == *first)?;
                if depth == 0 || import.path.first() == Some(first) {
                    return None;
                }
                below(&self.absolute_within(module, &import.path, depth - 1)?)
            }
        }
    }

    /// The module that defines the end of an absolute path, and whether the path says more than the module.
    fn definition(&self, path: &[String], depth: usize) -> Option<(Vec<String>, bool)> {
        let length = (1..=path.len()).rev().find(|&k| self.sources.contains_key(&path[..k]))?;
        let (module, rest) = path.split_at(length);
        let Some((name, onwards)) = rest.split_first() else { return Some((module.to_vec(), false)) };
        let imports = &self.sources[module].imports;
        let named = imports.iter().filter(|import| import.name == *name);
        for import in named.filter(|_| depth > 0) {
            let path = [&import.path[..], onwards].concat();
            if let Some(found) = self.absolute(module, &path).and_then(|p| self.definition(&p, depth - 1)) {
                return Some(found);
            }
        }
        Some((module.to_vec(), true))
    }

    /// The dependencies of each file: the files that define the names that it uses.
    fn dependencies(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let mut all = BTreeMap::new();
        for (module, source) in &self.sources {
            // A name that is only re-exported is no dependency.
            let used = |import: &&Import| !import.is_public || source.words.contains(&import.name);
            let imports = source.imports.iter().filter(used).map(|import| &import.path);
            let paths = imports.chain(&source.paths).filter_map(|path| self.absolute(module, path));
            let mut found = BTreeSet::new();
            for (definition, is_item) in paths.filter_map(|path| self.definition(&path, 8)) {
                if is_item && definition != *module {
                    found.insert(self.sources[&definition].file.as_str());
                }
            }
            all.insert(source.file.as_str(), found);
        }
        all
    }
}

/// The shortest way along dependencies from a file back to itself.
fn circle<'a>(all: &BTreeMap<&'a str, BTreeSet<&'a str>>, start: &'a str) -> Option<Vec<&'a str>> {
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(file) = queue.pop_front() {
        for &next in &all[file] {
            if next == start {
                let mut way = vec![start, file];
                while let Some(&earlier) = before.get(way[way.len() - 1]) {
                    way.push(earlier);
                }
                way.dedup();
                way.reverse();
                return Some(way);
            }
            if !before.contains_key(next) {
                before.insert(next, file);
                queue.push_back(next);
            }
        }
    }
    None
}

/// The top module that a file of `src` belongs to.
fn module_of(file: &str) -> &str {
    file.split('/').next().unwrap_or(file).trim_end_matches(".rs")
}

#[test]
fn imports_follow_the_table() {
    let table = table();
    let rows: BTreeMap<_, _> = table.iter().map(|(module, allowed)| (module.as_str(), allowed)).collect();
    let house = House::read();
    let mut faults = Vec::new();
    let mut used: BTreeSet<(&str, String)> = BTreeSet::new();
    for (module, source) in house.sources.iter().filter(|(module, _)| module[..] != [LIBRARY.to_owned()]) {
        let own = module_of(&source.file);
        let Some(allowed) = rows.get(own) else {
            faults.push(format!("module `{own}` is not in the table"));
            continue;
        };
        for path in source.imports.iter().map(|import| &import.path).chain(&source.paths) {
            let Some(path) = house.absolute(module, path) else { continue };
            let Some(top) = path.get(1).filter(|_| path[0] == LIBRARY) else { continue };
            used.insert((own, top.clone()));
            if top != own && rows.contains_key(top.as_str()) && !allowed.contains(top) {
                faults.push(format!("{}: `{own}` must not import `{top}`", source.file));
            }
        }
    }
    faults.dedup();
    for (own, allowed) in &rows {
        let unused = allowed.iter().filter(|top| !used.contains(&(*own, (*top).clone())));
        faults.extend(unused.map(|top| format!("`{own}` may import `{top}`, but does not")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_table_allows_no_import_upward() {
    let table = table();
    for (row, (module, allowed)) in table.iter().enumerate() {
        for import in allowed {
            let is_above = table[..row].iter().any(|(other, _)| other == import);
            assert!(is_above, "`{module}` may import `{import}`, which is no row above it");
        }
    }
}

#[test]
fn module_files_only_declare_and_re_export() {
    const ITEMS: [&str; 9] =
        ["fn", "struct", "enum", "trait", "impl", "const", "static", "type", "macro_rules"];
    let mut files = Vec::new();
    rust_files(&root().join("src"), &mut files);
    for file in files.iter().filter(|file| file.file_name().is_some_and(|name| name == "mod.rs")) {
        let text = std::fs::read_to_string(file).expect("source file");
        let tokens = without_tests(&tokens(&text));
        let item = tokens.iter().find(|token| ITEMS.contains(&token.as_str()));
        assert!(item.is_none(), "{} holds a `{}`", file.display(), item.map_or("", |i| i));
    }
}

#[test]
fn files_make_no_circles() {
    let house = House::read();
    let all = house.dependencies();
    assert!(all.values().map(BTreeSet::len).sum::<usize>() > 300, "the dependencies were not found");
    let circles: BTreeSet<Vec<&str>> = all.keys().filter_map(|file| circle(&all, file)).collect();
    let faults: Vec<String> = circles.iter().map(|circle| circle.join(" -> ")).collect();
    assert!(faults.is_empty(), "files depend on each other in circles:\n{}", faults.join("\n"));
}

#[test]
fn paths_are_followed_through_re_exports() {
    let module = |words: &str| -> Vec<String> { words.split("::").map(str::to_owned).collect() };
    let texts = [
        ("conemap", "lib.rs", "pub mod a;"),
        ("conemap::a", "a/mod.rs", "mod b; mod c; pub use b::Item; // use c::Other;"),
        (
            "conemap::a::b",
            "a/b.rs",
            "pub struct Item; #[cfg(test)] mod tests { use super::super::c::Other; }",
        ),
        ("conemap::a::c", "a/c.rs", "use crate::a::{self, Item}; fn f() { a::b::g('\"', \"super::x\") }"),
    ];
    let sources = texts.map(|(path, file, text)| (module(path), Source::new(file.to_owned(), text)));
    let all = House { sources: sources.into() };
    let all = all.dependencies();
    assert!(all["a/mod.rs"].is_empty() && all["a/b.rs"].is_empty(), "{all:?}");
    assert_eq!(all["a/c.rs"], BTreeSet::from(["a/b.rs"]));
    assert_eq!(
        circle(&BTreeMap::from([("x", ["y"].into()), ("y", ["x"].into())]), "x"),
        Some(vec!["x", "y", "x"])
    );
}

#[test]
fn the_core_names_no_browser_gpu_clock_or_thread() {
    let forbidden = ["web_sys", "js_sys", "wasm_bindgen", "wgpu", "std::time", "std::thread", "std::env"];
    let folder = root().join("src");
    let mut files = Vec::new();
    rust_files(&folder, &mut files);
    for file in files {
        let inside = file.strip_prefix(&folder).expect("inside src").to_string_lossy().replace('\\', "/");
        if ["web", "gpu", "bin"].contains(&module_of(&inside)) {
            continue;
        }
        let text = std::fs::read_to_string(&file).expect("source file");
        for name in forbidden {
            assert!(!text.contains(name), "{inside} names {name}");
        }
    }
}

#[test]
fn the_second_certificate_shares_no_code() {
    let folder = root().join("verify");
    let manifest =
        std::fs::read_to_string(folder.join("Cargo.toml")).expect("the crate of the second certificate");
    let dependencies = manifest.split("dependencies]").nth(1).expect("dependencies");
    assert!(!dependencies.contains("conemap") && !manifest.contains("path ="), "it depends on this project");
    let mut files = Vec::new();
    rust_files(&folder.join("src"), &mut files);
    assert!(files.len() > 8, "its files were not found");
    for file in files {
        let text = std::fs::read_to_string(&file).expect("source file");
        for word in ["#[path", "include!", "conemap::"] {
            assert!(!text.contains(word), "{} has `{word}`", file.display());
        }
    }
}
