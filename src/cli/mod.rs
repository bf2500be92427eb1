//! The command line: one program, reached as `cargo bryla …` and, after `pip install`, as `bryla …`.
//!
//! | exit code | meaning |
//! |---|---|
//! | 0 | done |
//! | 1 | the run broke off; what was computed is written |
//! | 2 | bad input, or bad usage |
//! | 3 | the tolerance was not met over the whole span; the run is written |
//! | 4 | a file could not be written |

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, Parser, Subcommand};

use crate::compare::CompareOptions;
use crate::error::{Error, Result};
use crate::integrator::Method;
use crate::plan::cost::{BodyKind, CostTable};
use crate::scene::{Orientation, RunOptions, Scene, Span};
use crate::simulation::{Progress, RunError};
use crate::text::short;
use crate::trajectory::{Event, EventKind, Trajectory};

/// Everything went well.
const DONE: i32 = 0;
/// The run broke off.
const BROKE_OFF: i32 = 1;
/// Bad input.
const BAD_INPUT: i32 = 2;
/// The tolerance was not met.
const NOT_MET: i32 = 3;
/// A file could not be written.
const NOT_WRITTEN: i32 = 4;

#[derive(Debug, Parser)]
#[command(name = "bryla", version, about = "Rigid bodies, simulated with an accuracy that you choose", after_help = EXIT_CODES)]
struct Command {
    #[command(subcommand)]
    verb: Verb,
}

const EXIT_CODES: &str =
    "Exit codes: 0 done, 1 the run broke off, 2 bad input, 3 tolerance not met, 4 a file could not be written";

#[derive(Debug, Subcommand)]
enum Verb {
    /// Run a scene: print its plan and a summary, write its trajectory
    Run {
        /// Scene file, .toml or .json
        scene: PathBuf,
        #[command(flatten)]
        options: Options,
        /// Where the trajectory goes: .csv, .json or .npz [default: out/NAME.csv]
        #[arg(long)]
        out: Option<PathBuf>,
        /// Print nothing but errors
        #[arg(long, short)]
        quiet: bool,
    },
    /// Say what a scene calls for, what is left out, and why
    Explain {
        /// Scene file, .toml or .json
        scene: PathBuf,
        #[command(flatten)]
        options: Options,
    },
    /// Show what accuracy costs: error against time for several methods and steps
    Compare {
        /// Scene file, .toml or .json
        scene: PathBuf,
        /// Methods to compare, by commas [default: all]
        #[arg(long, value_delimiter = ',')]
        methods: Vec<Method>,
        /// Steps to compare [s], by commas [default: ten halvings, where there are no tolerances]
        #[arg(long, value_delimiter = ',')]
        steps: Vec<f64>,
        /// Tolerances to compare, by commas, for the methods that control their error
        #[arg(long, value_delimiter = ',')]
        tolerances: Vec<f64>,
        /// How often each run is timed
        #[arg(long, default_value_t = 5)]
        repeats: u32,
        /// Start and end [s] [default: the scene's]
        #[arg(long, num_args = 2, value_names = ["START", "END"], allow_negative_numbers = true)]
        span: Option<Vec<f64>>,
        /// Where the table or figure goes: .csv or .svg; may be given twice
        #[arg(long)]
        out: Vec<PathBuf>,
    },
    /// Check scene files without running them
    Check {
        /// Scene files, .toml or .json
        #[arg(required = true)]
        scenes: Vec<PathBuf>,
    },
    /// Measure what a step of each method costs on this machine, for the predictions of `explain` and `run`
    Calibrate {
        /// Where the table goes [default: bryla/costs.toml in the folder for configuration]
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Print the JSON Schema of scene files
    Schema,
}

/// What overrides the scene's own run options.
#[derive(Debug, Args)]
struct Options {
    /// Error that the result may have
    #[arg(long, conflicts_with = "step")]
    tolerance: Option<f64>,
    /// Method of integration
    #[arg(long)]
    method: Option<Method>,
    /// Order of the method taylor
    #[arg(long, requires = "method")]
    order: Option<u32>,
    /// Length of a step [s]
    #[arg(long, requires = "method")]
    step: Option<f64>,
    /// Start and end [s] [default: the scene's]
    #[arg(long, num_args = 2, value_names = ["START", "END"], allow_negative_numbers = true)]
    span: Option<Vec<f64>>,
    /// Write orientations as a matrix R instead of a quaternion q (methods in world axes)
    #[arg(long)]
    matrix: bool,
    /// Do not estimate the error
    #[arg(long)]
    no_estimate: bool,
}

impl Options {
    /// The scene's options with these on top: a tolerance drives out a step, a step a tolerance, a method its order.
    fn over(&self, scene: &RunOptions) -> RunOptions {
        let mut options = scene.clone();
        if self.tolerance.is_some() {
            (options.tolerance, options.step) = (self.tolerance, None);
        }
        if self.step.is_some() {
            (options.tolerance, options.step) = (None, self.step);
        }
        if self.method.is_some() {
            (options.method, options.order) = (self.method, self.order);
        }
        if self.matrix {
            options.orientation = Orientation::Matrix;
        }
        options.estimate &= !self.no_estimate;
        options
    }
}

/// Runs the program with these arguments, the first being its own name; returns the exit code.
pub fn main(args: impl IntoIterator<Item = OsString>) -> i32 {
    let command = match Command::try_parse_from(args) {
        Ok(command) => command,
        Err(error) => {
            // help goes to standard output with code 0, mistakes to standard error with code 2
            let _ = error.print();
            return error.exit_code();
        }
    };
    let code = match command.verb {
        Verb::Run { scene, options, out, quiet } => run(&scene, &options, out, quiet),
        Verb::Explain { scene, options } => explain(&scene, &options),
        Verb::Compare { scene, methods, steps, tolerances, repeats, span, out } => {
            let options = CompareOptions { methods, steps, tolerances, repeats, run: RunOptions::default() };
            compare(&scene, options, span.as_ref(), &out)
        }
        Verb::Check { scenes } => Ok(check(&scenes)),
        Verb::Calibrate { out } => calibrate(out),
        Verb::Schema => {
            print(&format!("{:#}", Scene::schema()));
            Ok(DONE)
        }
    };
    code.unwrap_or_else(|error| {
        complain(&error);
        BAD_INPUT
    })
}

/// A line on standard output; a reader that has left is no error.
fn print(text: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{text}");
}

/// A line on standard error.
fn complain(error: &dyn std::fmt::Display) {
    let _ = writeln!(std::io::stderr().lock(), "error: {error}");
}

/// The span asked for, or the scene's.
fn span_of(given: Option<&Vec<f64>>, scene: &RunOptions) -> Result<Span> {
    match (given.map(Vec::as_slice), scene.t_span) {
        (Some(&[start, end]), _) => Ok(Span { start, end }),
        (_, Some(span)) => Ok(span.into()),
        _ => Err(Error::refused("run", "the scene names no t_span; give --span START END")),
    }
}

fn run(path: &Path, options: &Options, out: Option<PathBuf>, quiet: bool) -> Result<i32> {
    let scene = Scene::load(path)?;
    let span = span_of(options.span.as_ref(), &scene.run)?;
    let run_options = RunOptions { t_span: Some([span.start, span.end]), ..options.over(&scene.run) };
    let out = out.unwrap_or_else(|| {
        let name = path.file_stem().map_or_else(|| "run".to_owned(), |stem| stem.to_string_lossy().into_owned());
        Path::new("out").join(format!("{name}.csv"))
    });
    let plan = scene.compile(&run_options)?;
    if !quiet {
        print(&plan.explain_priced(&CostTable::of_user()?));
        print("");
    }

    // a bar where a person watches, nothing in a pipe
    let watched = !quiet && std::io::stderr().is_terminal();
    let bar = if watched { indicatif::ProgressBar::new(u64::from(BAR)) } else { indicatif::ProgressBar::hidden() };
    bar.set_style(bar_style());
    bar.enable_steady_tick(Duration::from_millis(100));
    let mut observer = |progress: Progress| {
        if watched {
            bar.set_position(whole_part(progress.fraction * f64::from(BAR)));
            bar.set_message(format!("pass {}", progress.pass));
        }
        ControlFlow::Continue(())
    };
    let result = scene.run_observed(span, &run_options, &mut observer);
    bar.finish_and_clear();

    let (trajectory, mut code) = match result {
        Ok(trajectory) => (trajectory, DONE),
        Err(RunError::Input(error)) => return Err(error),
        Err(RunError::Simulation(error)) => {
            complain(&error);
            match error.trajectory {
                Some(trajectory) => (*trajectory, BROKE_OFF),
                None => return Ok(BROKE_OFF),
            }
        }
    };
    if code == DONE && trajectory.report().met == Some(false) {
        code = NOT_MET;
    }
    if !quiet {
        print(&summary(&trajectory)?);
    }
    if let Err(error) = trajectory.write(&out) {
        complain(&error);
        return Ok(NOT_WRITTEN);
    }
    if !quiet {
        print(&format!("\nwritten: {} ({} samples)", out.display(), trajectory.times().len()));
    }
    Ok(code)
}

/// The whole part of a position on the bar.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and the bar's length")]
fn whole_part(position: f64) -> u64 {
    position as u64
}

/// Measures the costs of steps and writes them down.
fn calibrate(out: Option<PathBuf>) -> Result<i32> {
    let nowhere = || Error::refused("calibrate", "the system names no folder for configuration; give --out FILE");
    let path = out.or_else(CostTable::user_path).ok_or_else(nowhere)?;
    let table = CostTable::measure()?;
    if let Err(error) = table.save(&path) {
        complain(&error);
        return Ok(NOT_WRITTEN);
    }
    print(&format!("{:<20} ns a step of a body: free, loaded, pivot, planar, grouped", table.machine));
    for costs in &table.methods {
        let columns: Vec<_> = BodyKind::ALL.iter().map(|&kind| format!("{:7.0}", 1e9 * costs.step.of(kind))).collect();
        print(&format!("  {:<20}{}", costs.method.name(), columns.join("")));
    }
    print(&format!("written: {}", path.display()));
    Ok(DONE)
}

/// Positions of the progress bar.
const BAR: u32 = 1000;

fn bar_style() -> indicatif::ProgressStyle {
    let style = indicatif::ProgressStyle::with_template("{msg} [{bar:40}] {percent:>3} % {elapsed}");
    style.unwrap_or_else(|_| indicatif::ProgressStyle::default_bar()).progress_chars("=> ")
}

/// End state, energy, events and report.
fn summary(run: &Trajectory) -> Result<String> {
    let by = run.ended_by().map_or_else(String::new, |name| format!(", by the event {name}"));
    let mut text = format!("End: t = {} s{by}\n", short(run.end()));
    let Some(last) = run.times().len().checked_sub(1) else { return Ok(text + "no sample was reached") };
    let vector = |v: &[f64]| v.iter().map(|&x| short(x)).collect::<Vec<_>>().join(", ");
    for (body, motion) in run.plan().bodies().iter().zip(run.motions(last)).filter(|(body, _)| !body.fixed) {
        let q = crate::math::quaternion::to_scalar_first(&motion.orientation);
        text += &format!(
            "  {:<10} position ({}) m, orientation ({})\n",
            body.name,
            vector(motion.position.as_slice()),
            vector(&q)
        );
        text += &format!(
            "  {:<10} velocity ({}) m/s, angular velocity ({}) rad/s\n",
            "",
            vector(motion.velocity.as_slice()),
            vector(motion.angular_velocity.as_slice())
        );
    }
    let energy = run.energy()?;
    text += &format!(
        "  {:<10} kinetic {} J, potential {} J, dissipated {} J, work {} J; balance off by {} J at most\n",
        "energy",
        short(energy.kinetic[last]),
        short(energy.potential[last]),
        short(energy.dissipated[last]),
        short(energy.work[last]),
        short(energy.drift())
    );
    for event in run.events().iter().take(EVENTS) {
        text += &line_of(run, event);
    }
    if run.events().len() > EVENTS {
        text += &format!("  {:<10} {} more events: --out to .json keeps all\n", "…", run.events().len() - EVENTS);
    }
    text += &run.report().to_string();
    Ok(text)
}

/// Events that the summary shows [-]: what falls and comes to rest bounces a hundred times.
const EVENTS: usize = 24;

/// An event as a line of the summary.
fn line_of(run: &Trajectory, event: &Event) -> String {
    if let Some(passage) = event.passage {
        return format!("  {:<10} t = {} s, {}\n", event.name, short(event.time), passage.name());
    }
    let [first, second] = event.bodies.map(|i| run.plan().bodies()[i].name.as_str());
    if event.kind == EventKind::Break {
        let (time, force, torque) = (short(event.time), short(event.force.norm()), short(event.torque.norm()));
        return format!("  {:<10} t = {time} s, {first}–{second}: under {force} N, {torque} N·m\n", event.kind.name());
    }
    format!(
        "  {:<10} t = {} s, {first}–{second}, {}: impulse {} N·s, {} J lost\n",
        event.kind.name(),
        short(event.time),
        event.features,
        short(event.impulse.norm()),
        short(event.energy_lost)
    )
}

fn explain(path: &Path, options: &Options) -> Result<i32> {
    let scene = Scene::load(path)?;
    let mut run_options = options.over(&scene.run);
    if let Some(&[start, end]) = options.span.as_deref() {
        run_options.t_span = Some([start, end]);
    }
    print(&scene.compile(&run_options)?.explain_priced(&CostTable::of_user()?));
    Ok(DONE)
}

fn compare(path: &Path, options: CompareOptions, span: Option<&Vec<f64>>, out: &[PathBuf]) -> Result<i32> {
    let scene = Scene::load(path)?;
    let span = span_of(span, &scene.run)?;
    let options = CompareOptions { run: RunOptions { method: None, step: None, ..scene.run.clone() }, ..options };
    let table = match scene.compare(span, &options) {
        Ok(table) => table,
        Err(RunError::Input(error)) => return Err(error),
        Err(RunError::Simulation(error)) => {
            complain(&error);
            return Ok(BROKE_OFF);
        }
    };
    print(table.to_string().trim_end());
    for path in out {
        let text = match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => table.to_csv(),
            Some("svg") => table
                .to_svg(&format!("What accuracy costs: {}", path.file_stem().unwrap_or_default().to_string_lossy()))?,
            _ => {
                return Err(Error::File {
                    path: path.display().to_string(),
                    reason: "a comparison is written as .csv or .svg".into(),
                });
            }
        };
        if let Err(error) = std::fs::write(path, text) {
            complain(&format!("{}: {error}", path.display()));
            return Ok(NOT_WRITTEN);
        }
        print(&format!("written: {}", path.display()));
    }
    Ok(DONE)
}

fn check(paths: &[PathBuf]) -> i32 {
    let mut code = DONE;
    for path in paths {
        match Scene::load(path).and_then(|scene| scene.compile(&scene.run)) {
            Ok(_) => print(&format!("{}: ok", path.display())),
            Err(error) => {
                complain(&error);
                code = BAD_INPUT;
            }
        }
    }
    code
}
