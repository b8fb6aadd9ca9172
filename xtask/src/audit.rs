//! Known weaknesses of the page's packages, where the registry answers.

use crate::run::root;
use serde_json::Value;
use std::process::{Command, Stdio};

/// Fails where a package that the page is made of has a known weakness of a high or critical degree; others are told. Where the registry does
/// not answer, that is told, and nothing is judged.
pub fn check() -> Result<(), String> {
    // Short waits: a machine without a network should not stand still.
    let arguments = ["audit", "--json", "--omit=dev", "--fetch-timeout=20000", "--fetch-retries=0"];
    let output = Command::new("npm").args(arguments).current_dir(root()).stdin(Stdio::null()).output();
    let printed = output.map(|output| output.stdout).unwrap_or_default();
    match verdict(serde_json::from_slice(&printed).ok().as_ref()) {
        Verdict::Judged(sentence) => {
            eprintln!("{sentence}");
            Ok(())
        }
        Verdict::Unanswered(why) => {
            eprintln!("the page's packages were not compared with known weaknesses: {why}");
            Ok(())
        }
        Verdict::Weak(sentence) => Err(sentence),
    }
}

#[derive(Debug, PartialEq)]
enum Verdict {
    Judged(String),
    Unanswered(String),
    Weak(String),
}

/// What `npm audit --json` printed, judged.
fn verdict(printed: Option<&Value>) -> Verdict {
    let Some(counts) = printed.and_then(|answer| answer["metadata"]["vulnerabilities"].as_object()) else {
        let why = printed.and_then(|answer| answer["message"].as_str());
        return Verdict::Unanswered(why.unwrap_or("npm gave no answer").to_owned());
    };
    let of = |degree: &str| counts.get(degree).and_then(Value::as_u64).unwrap_or(0);
    let [all, weak] = [of("total"), of("high") + of("critical")];
    if weak == 0 {
        return Verdict::Judged(format!(
            "{all} weaknesses of the page's packages are known, none of a high degree"
        ));
    }
    let packages = printed.and_then(|answer| answer["vulnerabilities"].as_object());
    let names: Vec<&str> = packages
        .into_iter()
        .flatten()
        .filter(|(_, package)| matches!(package["severity"].as_str(), Some("high" | "critical")))
        .map(|(name, _)| name.as_str())
        .collect();
    Verdict::Weak(format!("npm audit: {} have known weaknesses of a high degree", names.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_an_answer_is_judged() {
        let refused = json!({ "message": "405 Method Not Allowed", "statusCode": 405 });
        assert_eq!(verdict(Some(&refused)), Verdict::Unanswered("405 Method Not Allowed".into()));
        assert_eq!(verdict(None), Verdict::Unanswered("npm gave no answer".into()));
        let of = |low: u32, high: u32| {
            json!({
                "vulnerabilities": { "a": { "severity": "low" }, "b": { "severity": "high" } },
                "metadata": { "vulnerabilities": { "low": low, "high": high, "critical": 0, "total": low + high } },
            })
        };
        assert!(matches!(verdict(Some(&of(2, 0))), Verdict::Judged(sentence) if sentence.starts_with("2 ")));
        assert!(matches!(verdict(Some(&of(2, 1))), Verdict::Weak(sentence) if sentence.contains(": b have")));
    }

    #[test]
    fn without_an_answer_nothing_fails() {
        assert!(!matches!(verdict(Some(&json!({ "error": { "code": "ENOTFOUND" } }))), Verdict::Weak(_)));
    }
}
