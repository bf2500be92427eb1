//! The time of impact of eight families of moving pairs against an independent certified oracle.
//!
//! The suite runs a sample. The documented run of a million pairs, with the times of bryla and of parry's
//! nonlinear cast in the same process:
//!
//! ```text
//! PAIRS=125000 cargo test --release --all-features --test impact_oracle -- --ignored --nocapture
//! ```
//!
//! which is 125,000 pairs of each family. In pieces, with one family's name: `FAMILY=graze`. What is found is in
//! [`benches/results/impact.md`](../../benches/results/impact.md).

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]
#![allow(clippy::disallowed_methods, reason = "no bits are promised of tests")]
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small counts, never negative")]

mod families;
mod oracle;
mod parry;
#[path = "../parry/mod.rs"]
mod parry_types;
#[path = "../random/mod.rs"]
mod random;

use std::time::Instant;

use bryla::impact::{Finder, Impact, Outcome, time_of_impact};
use families::{Case, FAMILIES, Family, random};
use oracle::Verdict;

/// Looks of the oracle at one pair before it gives up; of the grazes 1 in 200 takes more, of others none.
const PIECES: usize = 200_000;

#[derive(Debug, Default)]
struct Tally {
    pairs: usize,
    hits: usize,
    grazing: usize,
    undecided: usize,
    iterations: u64,
    most_iterations: u32,
    widest_gap: f64,
    least_gap: f64,
    times: Vec<u64>,
    parry_times: Vec<u64>,
    parry_missed: usize,
    parry_late: usize,
    parry_false: usize,
    parry_failed: usize,
}

fn solve(case: &Case) -> Impact {
    time_of_impact(&case.a, &case.motion_a, &case.b, &case.motion_b, 1.0, None, Finder::Guaranteed).unwrap()
}

/// ε of the pair: 1e-12 of both radii, and what rounding of the way asks for, which the search adds.
fn eps(case: &Case, t: f64) -> f64 {
    let size = case.a.radius() + case.b.radius();
    let way = oracle::speed(case) * t + case.motion_b.position.norm() + size;
    1e-12 * size + 200.0 * f64::EPSILON * (way + size)
}

/// Judges one pair: nothing missed, nothing late, nothing too early.
fn judge(name: &str, number: usize, case: &Case, found: &Impact, tally: &mut Tally) {
    let label = || format!("{name} {number}: {found:?}");
    tally.pairs += 1;
    tally.iterations += u64::from(found.iterations);
    tally.most_iterations = tally.most_iterations.max(found.iterations);
    let eps = eps(case, found.time);
    let (gap, lower, upper) = oracle::gap(case, found.time);
    match found.outcome {
        Outcome::At | Outcome::Grazing => {
            // at the answer the gap is within (0, ε], and nothing was touched before
            assert!(upper > 0.0 && gap <= eps, "{}: gap {gap:e}, ε {eps:e}", label());
            assert!(found.closest.lower > 0.0, "{}", label());
            let size = case.a.radius() + case.b.radius();
            tally.widest_gap = tally.widest_gap.max(gap / size);
            tally.least_gap = tally.least_gap.min(lower / size);
            match oracle::is_free(case, found.time, PIECES) {
                Verdict::Free => {}
                Verdict::Undecided(_) => tally.undecided += 1,
                Verdict::Overlap(t) => panic!("{}: overlaps at {t:e} already", label()),
            }
            if found.outcome == Outcome::At { tally.hits += 1 } else { tally.grazing += 1 }
        }
        Outcome::Clear => match oracle::is_free(case, 1.0, PIECES) {
            Verdict::Free => {}
            Verdict::Undecided(_) => tally.undecided += 1,
            Verdict::Overlap(t) => panic!("{}: missed, overlaps at {t:e}", label()),
        },
        // some grazes start where they end
        Outcome::Overlap | Outcome::AlreadyTouching => assert!(oracle::gap(case, 0.0).1 <= eps, "{}", label()),
        Outcome::Stalled => panic!("{}", label()),
    }
}

fn run((name, family): &Family, pairs: usize, times: bool) -> Tally {
    let mut random = random(name);
    let mut tally = Tally { least_gap: f64::INFINITY, ..Tally::default() };
    for number in 0..pairs {
        let case = family(&mut random);
        let start = Instant::now();
        let found = solve(&case);
        tally.times.push(u64::try_from(start.elapsed().as_nanos()).unwrap());
        judge(name, number, &case, &found, &mut tally);
        if times && let Some(pair) = parry::Pair::new(&case) {
            let start = Instant::now();
            let answer = pair.cast();
            tally.parry_times.push(u64::try_from(start.elapsed().as_nanos()).unwrap());
            match (answer, found.outcome) {
                (parry::Answer::Failed, _) => tally.parry_failed += 1,
                (parry::Answer::Clear, Outcome::At) => tally.parry_missed += 1,
                (parry::Answer::At(t), Outcome::At) if t > found.time + 1e-6 => tally.parry_late += 1,
                (parry::Answer::At(_), Outcome::Clear) => tally.parry_false += 1,
                _ => {}
            }
        }
    }
    tally.times.sort_unstable();
    tally.parry_times.sort_unstable();
    tally
}

fn quantile(times: &[u64], part: f64) -> f64 {
    times.get(((times.len() as f64 * part) as usize).min(times.len().max(1) - 1)).map_or(f64::NAN, |&t| t as f64 * 1e-3)
}

#[test]
fn no_impact_is_missed_and_none_is_late() {
    for family in FAMILIES {
        let tally = run(family, 150, false);
        assert!(tally.hits > 10, "{}: only {} hits test nothing", family.0, tally.hits);
        assert!(tally.undecided <= 3, "{}: the oracle gave up on {}", family.0, tally.undecided);
    }
}

#[test]
#[ignore = "minutes; see the module"]
fn a_million_pairs() {
    let pairs = std::env::var("PAIRS").map_or(2000, |n| n.parse().unwrap());
    let only = std::env::var("FAMILY").ok();
    assert!(only.as_ref().is_none_or(|only| FAMILIES.iter().any(|family| family.0 == only)), "no family {only:?}");
    println!(
        "{:<15} {:>7} {:>7} {:>7} {:>6} {:>7} {:>6} {:>9} {:>9} | {:>8} {:>8} | {:>8} {:>8} {:>6} {:>6} {:>6} {:>6}",
        "family",
        "pairs",
        "hits",
        "grazing",
        "undec.",
        "rounds",
        "most",
        "least gap",
        "gap/size",
        "median",
        "p99",
        "parry",
        "p99",
        "missed",
        "late",
        "false",
        "failed"
    );
    for family in FAMILIES.iter().filter(|family| only.as_ref().is_none_or(|only| only == family.0)) {
        let t = run(family, pairs, true);
        println!(
            "{:<15} {:>7} {:>7} {:>7} {:>6} {:>7.2} {:>6} {:>9.1e} {:>9.1e} | {:>8.2} {:>8.2} | {:>8.2} {:>8.2} {:>6} {:>6} {:>6} {:>6}",
            family.0,
            t.pairs,
            t.hits,
            t.grazing,
            t.undecided,
            t.iterations as f64 / t.pairs as f64,
            t.most_iterations,
            t.least_gap,
            t.widest_gap,
            quantile(&t.times, 0.5),
            quantile(&t.times, 0.99),
            quantile(&t.parry_times, 0.5),
            quantile(&t.parry_times, 0.99),
            t.parry_missed,
            t.parry_late,
            t.parry_false,
            t.parry_failed,
        );
    }
}
