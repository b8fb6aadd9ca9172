//! Compares the page's packages with the known weaknesses that npm's registry lists, where that answers.

use crate::run::root;
use serde_json::Value;
use std::process::{Command, Stdio};

/// Fails where a package that the page is made of has a known weakness of a high or critical degree; other weaknesses are printed. Where the
/// registry does not answer, the function prints that, and judges nothing.
pub fn check() -> Result<(), String> {
    // The waits are short, so that a machine without a network is not held up.
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

/// What the registry's answer says of the packages.
#[derive(Debug, PartialEq)]
enum Verdict {
    /// There is no weakness of a high or critical degree; the sentence counts the others.
    Judged(String),
    /// The registry did not answer, for this reason.
    Unanswered(String),
    /// The sentence names packages with weaknesses of a high or critical degree.
    Weak(String),
}

/// Judges what `npm audit --json` printed.
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
