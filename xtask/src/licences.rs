//! Checks the licences and sources of all crates against `deny.toml` on machines without `cargo deny`.

use crate::run::{cargo, output_of, root};
use serde_json::Value;
use spdx::{Expression, LicenseReq, Licensee, ParseMode};
use std::collections::BTreeMap;

/// The one registry that crates may come from.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Fails where a crate, of any feature and platform, has a licence that `deny.toml` does not allow, or comes from elsewhere.
pub fn check() -> Result<(), String> {
    let policy = root().join("deny.toml");
    let policy = std::fs::read_to_string(&policy).map_err(|e| format!("{}: {e}", policy.display()))?;
    let allowed = allowed(&policy)?;
    let arguments = ["metadata", "--format-version", "1", "--locked", "--all-features"];
    let metadata = output_of(&cargo(), &arguments).ok_or("cargo metadata failed")?;
    let metadata: Value = serde_json::from_str(&metadata).map_err(|e| format!("cargo metadata: {e}"))?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata names no packages")?;
    let faults: Vec<String> = packages.iter().filter_map(|package| fault(package, &allowed)).collect();
    if !faults.is_empty() {
        return Err(faults.join("; "));
    }
    eprintln!("the licences and sources of {} crates are allowed", packages.len());
    let several = several_versions(packages);
    if !several.is_empty() {
        eprintln!("in several versions: {}", several.join(", "));
    }
    Ok(())
}

/// The crates of which more than one version is used, each with its versions.
fn several_versions(packages: &[Value]) -> Vec<String> {
    let mut versions: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for package in packages {
        let text = |field: &str| package[field].as_str().unwrap_or_default();
        versions.entry(text("name")).or_default().push(text("version"));
    }
    versions.retain(|_, versions| versions.len() > 1);
    versions.into_iter().map(|(name, versions)| format!("{name} {}", versions.join(" and "))).collect()
}

/// The licences in the list `allow` of the section `[licenses]` of `deny.toml`.
fn allowed(policy: &str) -> Result<Vec<Licensee>, String> {
    let section = policy.split("\n[").find_map(|section| section.strip_prefix("licenses]"));
    let list = section.and_then(|section| section.split_once("allow = [")?.1.split_once(']'));
    let (list, _) = list.ok_or("deny.toml has no list of allowed licences")?;
    let names = list.split('"').skip(1).step_by(2);
    names.map(|name| Licensee::parse(name).map_err(|e| format!("deny.toml: {name}: {e}"))).collect()
}

/// A sentence about a crate that is not allowed, with its name; `None` for allowed crates and for the project's own.
fn fault(package: &Value, allowed: &[Licensee]) -> Option<String> {
    let source = package["source"].as_str()?;
    let text = |field: &str| package[field].as_str().unwrap_or_default();
    let name = format!("{} {}", text("name"), text("version"));
    if source != REGISTRY {
        return Some(format!("{name} comes from {source}"));
    }
    let licence = text("license");
    let is_allowed = |wanted: &LicenseReq| allowed.iter().any(|licence| licence.satisfies(wanted));
    match Expression::parse_mode(licence, ParseMode::LAX) {
        Ok(expression) if expression.evaluate(is_allowed) => None,
        Ok(_) => Some(format!("{name} is under {licence}, which deny.toml does not allow")),
        Err(error) => Some(format!("{name}: its licence {licence:?} is not understood ({})", error.reason)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn licences_and_sources_are_judged_as_the_policy_says() {
        let policy = "# [no]\n[graph]\nallow = [\"GPL-3.0-only\"]\n[licenses]\nallow = [\n  \"MIT\",\n  \"Zlib\",\n]\n[bans]\n";
        let allowed = allowed(policy).unwrap();
        assert_eq!(allowed.len(), 2);
        let of = |licence: &str, source: &str| {
            let package = json!({ "name": "a", "version": "1.0.0", "license": licence, "source": source });
            fault(&package, &allowed)
        };
        for good in
            ["MIT", "MIT OR GPL-3.0-only", "Apache-2.0/MIT", "MIT AND Zlib", "(GPL-2.0 OR Zlib) AND MIT"]
        {
            assert_eq!(of(good, REGISTRY), None, "{good}");
        }
        for bad in ["GPL-3.0-only", "MIT AND Apache-2.0", "", "my own"] {
            assert!(of(bad, REGISTRY).is_some_and(|fault| fault.contains("a 1.0.0")), "{bad}");
        }
        assert!(of("MIT", "git+https://example.com/a").is_some_and(|fault| fault.contains("comes from")));
        let own = json!({ "name": "conemap", "version": "0.1.0", "license": null, "source": null });
        assert_eq!(fault(&own, &allowed), None);
        assert!(super::allowed("[bans]\n").is_err());
    }

    #[test]
    fn crates_in_several_versions_are_told() {
        let of = |name: &str, version: &str| json!({ "name": name, "version": version });
        let packages = [of("b", "2.0.0"), of("a", "1.0.0"), of("b", "1.4.0")];
        assert_eq!(several_versions(&packages), ["b 2.0.0 and 1.4.0"]);
        assert!(several_versions(&packages[..2]).is_empty());
    }

    #[test]
    fn the_project_keeps_to_its_policy() {
        check().unwrap();
    }
}
