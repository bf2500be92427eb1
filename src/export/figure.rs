//! The figure of a comparison: error against time, log–log, as SVG.

use plotters::prelude::*;

use crate::compare::ComparisonTable;
use crate::error::{Error, Result};
use crate::integrator::Method;

/// Size of the figure [px].
const SIZE: (u32, u32) = (860, 560);

/// Colours that stay apart for most eyes (Okabe, Ito 2008).
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(0, 0, 0),
    RGBColor(120, 120, 120),
];

impl ComparisonTable {
    /// Processor time against error, log–log, one line a method, as SVG.
    ///
    /// # Errors
    /// A table without a single error to show.
    pub fn to_svg(&self, title: &str) -> Result<String> {
        let mut text = String::new();
        self.draw(&mut text, title).map_err(|reason| Error::refused("figure", reason))?;
        Ok(text)
    }

    fn draw(&self, text: &mut String, title: &str) -> std::result::Result<(), String> {
        // a line for the steps of a method, and one for its tolerances
        let points = |&(method, by_tolerance): &(Method, bool)| -> Vec<(f64, f64)> {
            let rows = self.rows.iter().filter(|row| row.method == method && row.tolerance.is_some() == by_tolerance);
            rows.filter_map(|row| Some((row.error.filter(|e| *e > 0.0)?, row.seconds_min)))
                .filter(|p| p.1 > 0.0)
                .collect()
        };
        let mut lines: Vec<(Method, bool)> = Vec::new();
        for row in &self.rows {
            let line = (row.method, row.tolerance.is_some());
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
        let all: Vec<_> = lines.iter().flat_map(points).collect();
        if all.is_empty() {
            return Err("no run of the comparison has an error to show".to_owned());
        }
        let range = |values: Vec<f64>| {
            let (low, high) = values.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &x| (l.min(x), h.max(x)));
            0.5 * low..2.0 * high
        };
        let (errors, seconds) = all.iter().copied().unzip();

        let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
        let failed = |error: &dyn std::fmt::Display| error.to_string();
        root.fill(&WHITE).map_err(|e| failed(&e))?;
        let mut chart = ChartBuilder::on(&root)
            .caption(title, ("sans-serif", 20))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(72)
            .build_cartesian_2d(range(errors).log_scale(), range(seconds).log_scale())
            .map_err(|e| failed(&e))?;
        chart
            .configure_mesh()
            .x_desc("error of the end state")
            .y_desc("processor time [s]")
            .x_label_formatter(&|x| format!("{x:.0e}"))
            .y_label_formatter(&|y| format!("{y:.0e}"))
            .light_line_style(WHITE)
            .draw()
            .map_err(|e| failed(&e))?;
        // a colour for each method; rings where it went by tolerance, discs where by step
        let mut methods: Vec<Method> = Vec::new();
        for (method, _) in &lines {
            if !methods.contains(method) {
                methods.push(*method);
            }
        }
        for line in &lines {
            let (method, by_tolerance) = *line;
            let place = methods.iter().position(|other| *other == method).unwrap_or_default();
            let colour = COLOURS[place % COLOURS.len()];
            let inside = if by_tolerance { WHITE } else { colour };
            let line = points(line);
            let name = if by_tolerance {
                format!("{method}, by tolerance")
            } else {
                format!("{method}, order {}", method.order())
            };
            chart
                .draw_series(LineSeries::new(line.iter().copied(), colour.stroke_width(2)))
                .map_err(|e| failed(&e))?
                .label(name)
                .legend(move |(x, y)| {
                    EmptyElement::at((x, y))
                        + PathElement::new([(0, 0), (18, 0)], colour.stroke_width(2))
                        + Circle::new((9, 0), 4, colour.filled())
                        + Circle::new((9, 0), 2, inside.filled())
                });
            for (size, colour) in [(4, colour), (2, inside)] {
                let dots = line.iter().map(|&p| Circle::new(p, size, colour.filled()));
                chart.draw_series(dots).map_err(|e| failed(&e))?;
            }
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .background_style(WHITE.mix(0.9))
            .border_style(RGBColor(190, 190, 190))
            .draw()
            .map_err(|e| failed(&e))?;
        root.present().map_err(|e| failed(&e))
    }
}
