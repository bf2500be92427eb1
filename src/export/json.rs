//! JSON: arrays by name, nested as their shapes, with bodies, events and the report's figures.

use serde_json::{Map, Value, json};

use super::{Array, arrays};
use crate::error::Result;
use crate::math::roots::Passage;
use crate::trajectory::Trajectory;

pub(super) fn write(run: &Trajectory) -> Result<String> {
    let names: Vec<_> = run.plan().bodies().iter().map(|body| body.name.as_str()).collect();
    let samples: Map<_, _> = arrays(run)?.into_iter().map(|a| (a.name.to_owned(), nested(&a))).collect();
    let events: Vec<_> = run
        .events()
        .iter()
        .map(|event| {
            json!({
                "time": event.time,
                "kind": event.kind.name(),
                "name": event.name,
                "passage": event.passage.map(Passage::name),
                "bodies": event.bodies.map(|i| names[i]),
                "point": event.point.as_slice(),
                "normal": event.normal.as_slice(),
                "impulse": event.impulse.as_slice(),
                "force": event.force.as_slice(),
                "torque": event.torque.as_slice(),
                "features": event.features,
                "iterations": event.iterations,
                "energy_lost": event.energy_lost,
            })
        })
        .collect();
    let report = run.report();
    let value = json!({
        "bodies": names,
        "samples": samples,
        "events": events,
        "report": {
            "method": report.method.name(),
            "step": report.step,
            "tolerance": report.tolerance,
            "error_estimate": report.error_estimate,
            "met": report.met,
            "horizon": report.horizon,
            "steps": report.counts.steps,
            "evaluations": report.counts.evaluations,
            "orientation_drift": report.counts.orientation_drift,
        },
    });
    Ok(format!("{value:#}\n"))
}

/// The numbers of an array, nested as its shape.
fn nested(array: &Array) -> Value {
    fn level(shape: &[usize], data: &[f64]) -> Value {
        match shape {
            [] | [_] => data.iter().copied().map(Value::from).collect(),
            [first, rest @ ..] => data.chunks(data.len() / first).map(|part| level(rest, part)).collect(),
        }
    }
    level(&array.shape, &array.data)
}
