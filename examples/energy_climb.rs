//! The lecture's point, as a figure: with Euler's method the energy of a free body climbs, and with
//! Heun's it still does, only later. Halving the step halves the one and divides the other by eight.
//!
//! `cargo run --release --features figure --example energy_climb`, which writes `examples/energy_climb.svg`

use bryla::{Body, Cuboid, Method, Record, RunOptions, Scene};
use plotters::prelude::*;

/// Span of the run [s], and its samples.
const SPAN: f64 = 30.0;
const SAMPLES: u32 = 600;

/// Relative change of the kinetic energy of a tumbling block over time.
fn climb(method: Method, step: f64) -> Result<Vec<(f64, f64)>, Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let block = Body::new("block", Cuboid::new([0.15, 0.10, 0.05])).density(1000.0);
    scene.add(block.angular_velocity([6.0, 5.0, 4.0]))?;
    let times: Vec<f64> = (0..=SAMPLES).map(|i| f64::from(i) * SPAN / f64::from(SAMPLES)).collect();
    let options = RunOptions::method(method).step(step).estimate(false).t_eval(times).record(Record::Samples);
    let run = scene.run(0.0..SPAN, &options)?;
    let energy = run.energy()?.kinetic;
    Ok(run.times().iter().zip(&energy).map(|(&t, e)| (t, (e - energy[0]).abs() / energy[0])).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/energy_climb.svg");
    let root = SVGBackend::new(path, (860, 480)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .caption("Energy of a free body: Euler climbs, Heun climbs later", ("sans-serif", 19))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d(0.0..SPAN, (1e-9..2.0).log_scale())?;
    chart
        .configure_mesh()
        .x_desc("time [s]")
        .y_desc("|E − E₀| / E₀")
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .light_line_style(WHITE)
        .draw()?;
    let lines = [
        (Method::Euler, 1.0 / 128.0, RGBColor(213, 94, 0)),
        (Method::Euler, 1.0 / 256.0, RGBColor(240, 170, 120)),
        (Method::Heun, 1.0 / 128.0, RGBColor(0, 114, 178)),
        (Method::Heun, 1.0 / 256.0, RGBColor(120, 180, 220)),
        (Method::Rk4, 1.0 / 128.0, RGBColor(0, 158, 115)),
    ];
    for (method, step, colour) in lines {
        let points = climb(method, step)?.into_iter().filter(|&(_, e)| e > 0.0);
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
            .label(format!("{method}, h = 1/{:.0} s", 1.0 / step))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerRight)
        .background_style(WHITE.mix(0.9))
        .border_style(RGBColor(190, 190, 190))
        .draw()?;
    root.present()?;
    Ok(())
}
