//! The lines of the tables of maps, and the sums below them.

use crate::case::{Outcome, Reached};

/// Prints the names of the columns.
pub fn header() {
    println!(
        "{:20} {:14} {:>8} {:>8} {:>7} {:>7} {:>9} {:>8} {:>17} {:>3} {:>3} {:>7} {:>7} {:>7}",
        "pair",
        "variant",
        "E",
        "mean log",
        "mean",
        "p95",
        "max",
        "dented",
        "truth % 50 % 95 %",
        "own",
        "cls",
        "coarse",
        "next",
        "cpu s"
    );
}

/// The line of one map.
pub fn line(outcome: &Outcome) -> String {
    let Outcome { name, variant, reached, seconds } = outcome;
    match reached {
        Ok(r) => format!(
            "{name:20} {variant:14} {:8.4} {:8.5} {:7.3} {:7.2} {:9.1e} {:7.3}% {:>17} {:3} {:3} {:7.5} {:7.5} {seconds:7.2}{}",
            r.energy,
            r.mean_log,
            r.mean,
            r.p95,
            r.max,
            100.0 * r.dented,
            r.truth.map_or(String::new(), |t| {
                let [mean, middle, most] = t.map(|share| 100.0 * share);
                format!("{mean:.3} {middle:.3} {most:.2}")
            }),
            r.own,
            r.judged,
            r.coarse[0],
            r.coarse[1],
            if r.certified { "" } else { "  NOT CERTIFIED" }
        ),
        Err(error) => format!("{name:20} {variant:14} FAILED after {seconds:.1} s: {error}"),
    }
}

/// Prints how many maps are certified, the median and the worst figures, and the processor time of all.
pub fn sum_up(title: &str, outcomes: &[&Outcome]) {
    let reached: Vec<&Reached> = outcomes.iter().filter_map(|o| o.reached.as_ref().ok()).collect();
    let certified = reached.iter().filter(|r| r.certified).count();
    let of = |value: fn(&Reached) -> f64| {
        let mut values: Vec<f64> = reached.iter().map(|r| value(r)).collect();
        values.sort_by(f64::total_cmp);
        (
            values.get(values.len() / 2).copied().unwrap_or(f64::NAN),
            values.last().copied().unwrap_or(f64::NAN),
        )
    };
    let (energy, mean_log, max, dented) =
        (of(|r| r.energy), of(|r| r.mean_log), of(|r| r.max), of(|r| r.dented));
    let seconds: f64 = outcomes.iter().map(|o| o.seconds).sum();
    let slowest = outcomes.iter().map(|o| o.seconds).fold(0.0, f64::max);
    println!(
        "{title}: {certified} of {} certified; E median {:.4}, worst {:.4}; mean log {:.5}, {:.5}; max {:.1e}, {:.1e}; \
         dented {:.3}%, {:.3}%; cpu {seconds:.1} s, slowest {slowest:.1} s",
        outcomes.len(),
        energy.0,
        energy.1,
        mean_log.0,
        mean_log.1,
        max.0,
        max.1,
        100.0 * dented.0,
        100.0 * dented.1,
    );
}

/// Sums up each variant and compares it with the reference variant on the same pairs: ratios of energies and of processor times.
pub fn compare(outcomes: &[Outcome], reference: &str) {
    let mut variants: Vec<&str> = outcomes.iter().map(|o| o.variant.as_str()).collect();
    variants.sort_unstable();
    variants.dedup();
    for variant in variants {
        let mut ratios: Vec<(f64, f64, &str)> = Vec::new();
        for outcome in outcomes.iter().filter(|o| o.variant == variant) {
            let known = outcomes.iter().find(|o| o.name == outcome.name && o.variant == reference);
            let Some(known) = known else { continue };
            if let (Ok(a), Ok(b)) = (&outcome.reached, &known.reached) {
                ratios.push((a.energy / b.energy, outcome.seconds / known.seconds, &outcome.name));
            }
        }
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(worst) = ratios.last().copied() else { continue };
        let middle = ratios[ratios.len() / 2].0;
        let least = ratios[0];
        let mut times: Vec<f64> = ratios.iter().map(|r| r.1).collect();
        times.sort_by(f64::total_cmp);
        let own: Vec<&Outcome> = outcomes.iter().filter(|o| o.variant == variant).collect();
        sum_up(variant, &own);
        println!(
            "{variant} / {reference}: E median {middle:.4}, least {:.4} ({}), most {:.4} ({}); cpu median {:.2}, most {:.2}, all {:.2}",
            least.0,
            least.2,
            worst.0,
            worst.2,
            times[times.len() / 2],
            times[times.len() - 1],
            times.iter().sum::<f64>() / times.len() as f64,
        );
    }
}
