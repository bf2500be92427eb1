//! What the fuzzers of `fuzz/` call, driven by seeded random bytes.
//!
//! ```text
//! RUNS=10000000 cargo test --release --test fuzz -- --ignored --nocapture
//! ```

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]

mod targets;

/// Calls a target with strings of random bytes, of 8 to 600, of which some are small so that numbers fall
/// on grids.
fn drive(target: fn(&[u8]), runs: u64, seed: u64) {
    let mut state = seed;
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state >> 33
    };
    let mut data = Vec::new();
    for _ in 0..runs {
        data.clear();
        let (length, coarse) = (8 + random() % 592, random() % 3 == 0);
        data.extend((0..length).map(|_| {
            let byte = u8::try_from(random() % 256).unwrap();
            if coarse { byte / 16 * 16 + 1 } else { byte }
        }));
        target(&data);
    }
}

fn runs(few: u64) -> u64 {
    std::env::var("RUNS").ok().and_then(|n| n.parse().ok()).unwrap_or(few)
}

/// Calls a target with what its fuzzer keeps: a sample of what it has reached, and all that it has found.
fn replay(target: fn(&[u8]), name: &str) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus").join(name);
    let files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(files.len() >= 40, "{} files of {name}", files.len());
    for file in files {
        target(&std::fs::read(file).unwrap());
    }
}

#[test]
fn what_the_fuzzers_keep() {
    replay(targets::hull, "hull");
    replay(targets::query, "query");
}

#[test]
fn hulls_of_random_bytes() {
    drive(targets::hull, 4_000, 1);
}

#[test]
fn queries_of_random_bytes() {
    drive(targets::query, 4_000, 2);
}

#[test]
#[ignore = "as long as RUNS says"]
fn hulls_of_random_bytes_at_length() {
    drive(targets::hull, runs(1_000_000), 3);
}

#[test]
#[ignore = "as long as RUNS says"]
fn queries_of_random_bytes_at_length() {
    drive(targets::query, runs(1_000_000), 4);
}
