//! What accuracy costs: every scene of the catalogue, every method, every step; error and time of the
//! same run. Writes `benches/results/work_precision.csv`, and a figure of each scene beside it.
//!
//! `cargo bench --all-features --bench work_precision [-- SCENE …]`

use std::fmt::Write;
use std::process::Command;

use bryla::compare::{CompareOptions, Row};
use bryla::{ComparisonTable, Method, RunOptions, catalogue};

/// Where the table and the figures go.
const RESULTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/results");

/// Steps of each method, as halvings of the span's thousandth part, from 8 times as long on.
const HALVINGS: i32 = 9;
/// Methods in the figures: more lines are not told apart.
const SHOWN: [Method; 8] = [
    Method::Euler,
    Method::Heun,
    Method::Rk4,
    Method::Tsit5,
    Method::Dop853,
    Method::Split4,
    Method::Cf4,
    Method::Taylor,
];
/// Tolerances of the methods that choose their steps by them.
const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked: Vec<_> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let said = |program: &str, args: &[&str]| {
        let output = Command::new(program).args(args).output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).trim().replace(',', " "))
    };
    let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split(':').nth(1)?.trim().replace(',', " "))
    });
    let processor = processor.unwrap_or_else(|| std::env::consts::ARCH.to_owned());
    let compiler = said("rustc", &["--version"]).unwrap_or_default();
    let date = said("date", &["-u", "+%Y-%m-%d"]).unwrap_or_default();

    let mut csv =
        "scene,method,step_s,tolerance,error,evaluations,steps,seconds_min,seconds_median,cpu,rustc,date\n".to_owned();
    // dice that meet each other diverge: the end of one run says nothing of another's error
    for name in catalogue::NAMES.iter().filter(|name| **name != "dice") {
        if !asked.is_empty() && !asked.iter().any(|a| a == name) {
            continue;
        }
        let scene = catalogue::scene(name).ok_or("a name without a scene")??;
        let span = scene.run.t_span.ok_or("a scene without a span")?;
        let unit = (span[1] - span[0]) / 1000.0;
        let steps: Vec<f64> = (0..HALVINGS).map(|k| 8.0 * unit / f64::from(1 << k)).collect();
        let mut shown: Option<ComparisonTable> = None;
        for &method in Method::ALL {
            let options = CompareOptions {
                methods: vec![method],
                steps: steps.clone(),
                tolerances: TOLERANCES.to_vec(),
                repeats: 3,
                run: RunOptions { method: None, step: None, ..scene.run.clone() },
            };
            // a method that the scene does not allow, such as the closed form of what has none
            let Ok(table) = scene.compare(span, &options) else { continue };
            for row in &table.rows {
                let [error, tolerance] =
                    [row.error, row.tolerance].map(|x| x.map(|x| format!("{x:e}")).unwrap_or_default());
                writeln!(
                    csv,
                    "{name},{},{:e},{tolerance},{error},{},{},{:e},{:e},{processor},{compiler},{date}",
                    row.method, row.step, row.evaluations, row.steps, row.seconds_min, row.seconds_median
                )?;
            }
            let least = table.rows.iter().filter_map(|row| row.error).fold(f64::INFINITY, f64::min);
            println!("{name:<16} {:<20} least error {least:.1e} against {}", method.name(), table.reference);

            // of the methods by tolerance, the best two
            let by_tolerance =
                |row: &Row| row.tolerance.is_none() || [Method::Dop853, Method::Taylor].contains(&method);
            if SHOWN.contains(&method) {
                let rows = table.rows.iter().filter(|row| by_tolerance(row)).cloned();
                match &mut shown {
                    Some(shown) => shown.rows.extend(rows),
                    None => shown = Some(ComparisonTable { rows: rows.collect(), ..table.clone() }),
                }
            }
        }
        if let Some(shown) = shown {
            let path = format!("{RESULTS}/work_precision_{name}.svg");
            std::fs::write(path, shown.to_svg(&format!("What accuracy costs: {name}"))?)?;
        }
    }
    let path = format!("{RESULTS}/work_precision.csv");
    std::fs::write(&path, csv)?;
    println!("written: {path}");
    Ok(())
}
