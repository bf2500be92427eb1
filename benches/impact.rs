//! What a time of impact costs, beside parry3d's nonlinear cast in the same process.
//!
//! ```text
//! cargo bench --bench impact
//! ```
//!
//! The families of moving pairs are those of `tests/impact_oracle`, which judges the answers. Every pair is
//! searched several times and its least time of this thread counts, so that what else the machine does
//! matters little; a row tells the median and the 99th percentile over the pairs. parry's bodies and motions
//! are made outside of what is timed, and its answers are not judged here.
//!
//! The second table is what ε costs: rounds, queries and time of each finder, on those pairs of `tumble`
//! that end in overlap, where all three see the impact.

#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small counts, never negative")]

#[allow(clippy::unwrap_used, reason = "a bench that cannot set itself up has failed")]
#[path = "../tests/impact_oracle/families.rs"]
mod families;
#[allow(clippy::unwrap_used, reason = "a bench that cannot set itself up has failed")]
#[path = "../tests/impact_oracle/parry.rs"]
mod parry;
#[allow(clippy::unwrap_used, reason = "a bench that cannot set itself up has failed")]
#[path = "../tests/parry/mod.rs"]
mod parry_types;
#[path = "../tests/random/mod.rs"]
mod random;

use std::hint::black_box;
use std::time::Duration;

use bryla::impact::{Finder, Impact, Outcome, time_of_impact};
use cpu_time::ThreadTime;
use families::{Case, FAMILIES, random};

/// Pairs of each family.
const PAIRS: usize = 1000;
/// How often each is searched.
const REPETITIONS: usize = 5;

fn search(case: &Case, eps: Option<f64>, finder: Finder) -> Impact {
    time_of_impact(&case.a, &case.motion_a, &case.b, &case.motion_b, 1.0, eps, finder).expect("the pair is finite")
}

/// Least time of so many repetitions [µs].
fn least_time(mut f: impl FnMut()) -> f64 {
    let mut least = Duration::MAX;
    for _ in 0..REPETITIONS {
        let start = ThreadTime::now();
        f();
        least = least.min(start.elapsed());
    }
    least.as_secs_f64() * 1e6
}

fn quantile(times: &mut [f64], part: f64) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get((times.len() as f64 * part) as usize).copied().unwrap_or(f64::NAN)
}

fn main() {
    println!(
        "{:<15} {:>7} {:>7} | {:>8} {:>8} | {:>9} {:>9}  µs",
        "family", "hits", "rounds", "median", "p99", "parry", "p99"
    );
    for (name, family) in FAMILIES {
        let mut numbers = random(name);
        let (mut times, mut parry_times, mut rounds, mut hits) = (Vec::new(), Vec::new(), 0, 0);
        for _ in 0..PAIRS {
            let case = family(&mut numbers);
            let found = search(&case, None, Finder::Guaranteed);
            rounds += found.iterations;
            hits += usize::from(found.outcome == Outcome::At);
            times.push(least_time(|| _ = black_box(search(&case, None, Finder::Guaranteed))));
            if let Some(pair) = parry::Pair::new(&case) {
                parry_times.push(least_time(|| _ = black_box(pair.cast())));
            }
        }
        println!(
            "{name:<15} {hits:>7} {:>7.2} | {:>8.2} {:>8.2} | {:>9.2} {:>9.2}",
            f64::from(rounds) / PAIRS as f64,
            quantile(&mut times, 0.5),
            quantile(&mut times, 0.99),
            quantile(&mut parry_times, 0.5),
            quantile(&mut parry_times, 0.99),
        );
    }

    println!("\n{:<11} {:>8} {:>7} {:>8} {:>8} {:>9}", "finder", "ε/size", "pairs", "rounds", "queries", "median µs");
    for &finder in Finder::ALL {
        for eps in [1e-3, 1e-6, 1e-9, 1e-12] {
            let mut numbers = random("tumble");
            let (mut times, mut rounds, mut queries) = (Vec::new(), 0, 0);
            for _ in 0..PAIRS {
                let case = FAMILIES[1].1(&mut numbers);
                let eps = Some(eps * (case.a.radius() + case.b.radius()));
                if FAMILIES[1].0 != "tumble" || search(&case, eps, Finder::Bisection).outcome != Outcome::At {
                    continue;
                }
                let found = search(&case, eps, finder);
                rounds += found.iterations;
                queries += found.queries;
                times.push(least_time(|| _ = black_box(search(&case, eps, finder))));
            }
            println!(
                "{:<11} {eps:>8.0e} {:>7} {:>8.2} {:>8.2} {:>9.2}",
                finder.name(),
                times.len(),
                f64::from(rounds) / times.len() as f64,
                f64::from(queries) / times.len() as f64,
                quantile(&mut times, 0.5),
            );
        }
    }
}
