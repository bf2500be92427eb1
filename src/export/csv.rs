//! Comma-separated values: one line a sample, one column a number, full precision.

use std::fmt::Write;

use super::arrays;
use crate::error::Result;
use crate::trajectory::Trajectory;

/// The samples as text; columns are called `t`, `die.position.x`, …, `work`.
pub(super) fn write(run: &Trajectory) -> Result<String> {
    let arrays = arrays(run)?;
    let mut names = Vec::new();
    for array in &arrays {
        if array.components.is_empty() {
            names.push(array.name.to_owned());
            continue;
        }
        for body in run.plan().bodies() {
            names.extend(array.components.iter().map(|c| quoted(&format!("{}.{}.{c}", body.name, array.name))));
        }
    }
    let mut text = names.join(",");
    text.push('\n');
    for sample in 0..run.times().len() {
        for (i, array) in arrays.iter().enumerate() {
            let width = array.data.len() / run.times().len();
            for (j, x) in array.data[sample * width..(sample + 1) * width].iter().enumerate() {
                // writing to a string cannot fail
                let _ = write!(text, "{}{x:?}", if i + j == 0 { "" } else { "," });
            }
        }
        text.push('\n');
    }
    Ok(text)
}

/// A field as RFC 4180 wants it.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}
