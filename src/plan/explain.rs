//! The plan in words.

use std::fmt::Write;

use super::{FlightGroup, Plan};
use crate::contact::BreakingLoad;
use crate::freedom::Chart;
use crate::text::{counted, short};

impl Plan {
    /// What runs, what is left out, and why.
    ///
    /// ```text
    /// Plan: 2 bodies (1 fixed), heun, h = 0.001 s
    ///   flight 1   die: free, 13 numbers
    ///              uniform_gravity
    ///              heun: as asked for
    ///   pairs      die–floor: bounce, restitution 0.5
    ///   left out   effect 2 (drag): all its coefficients are 0
    /// ```
    pub fn explain(&self) -> String {
        let mut text = String::new();
        // writing to a string cannot fail
        let _ = self.write(&mut text);
        text.truncate(text.trim_end().len());
        text
    }

    fn write(&self, out: &mut String) -> std::fmt::Result {
        let moved = self.bodies.iter().filter(|body| body.motion.is_some()).count();
        let fixed = self.bodies.iter().filter(|body| body.fixed).count() - moved;
        write!(out, "Plan: {}", counted(self.bodies.len(), "body", "bodies"))?;
        let kinds = [(fixed, "fixed"), (moved, "moved")].into_iter().filter(|(n, _)| *n > 0);
        let kinds: Vec<_> = kinds.map(|(n, kind)| format!("{n} {kind}")).collect();
        if !kinds.is_empty() {
            write!(out, " ({})", kinds.join(", "))?;
        }
        write!(out, ", {}", self.options.method.map_or("auto", crate::integrator::Method::name))?;
        match (self.options.step, self.tolerance()) {
            (Some(step), _) => writeln!(out, ", h = {} s", short(step))?,
            (None, Some(tolerance)) => writeln!(out, ", tolerance {}", short(tolerance))?,
            (None, None) => writeln!(out)?,
        }

        for (number, group) in self.groups.iter().enumerate() {
            self.write_group(out, number, group)?;
        }
        let moved = self.bodies.iter().filter_map(|body| Some((body, body.motion.as_ref()?)));
        for (i, (body, motion)) in moved.enumerate() {
            let numbers = |v: [f64; 3]| v.map(short).join(", ");
            let (v, w) = (numbers(motion.velocity), numbers(motion.angular_velocity));
            write!(out, "  {:<10} {}: velocity ({v}) m/s, angular velocity ({w}) rad/s", label(i, "moved"), body.name)?;
            let schedule = motion.schedule.as_ref().map_or(&[][..], |schedule| &schedule.0);
            let factors: Vec<_> =
                schedule.iter().map(|(t, f)| format!("{} from t = {} s", short(*f), short(*t))).collect();
            writeln!(out, "{}{}", if factors.is_empty() { "" } else { ", times " }, factors.join(", "))?;
        }
        let pairs = self.pairs_in_words();
        for (i, pair) in pairs.iter().enumerate() {
            writeln!(out, "  {:<10} {pair}", label(i, "pairs"))?;
        }
        for (i, left) in self.left_out.iter().enumerate() {
            writeln!(out, "  {:<10} {}: {}", label(i, "left out"), left.what, left.why)?;
        }
        if pairs.is_empty() {
            let label = label(self.left_out.len(), "left out");
            writeln!(out, "  {label:<10} contact: no two bodies can meet")?;
        }
        Ok(())
    }

    /// The pairs that may meet, one a line; of many their number.
    fn pairs_in_words(&self) -> Vec<String> {
        let solid: Vec<usize> = (0..self.bodies.len()).filter(|&i| self.bodies[i].collider.is_some()).collect();
        let moving = solid.iter().filter(|&&i| !self.bodies[i].fixed).count();
        let finder = self.options.finder.name();
        let count = moving * (solid.len() - moving) + moving * moving.saturating_sub(1) / 2;
        if count > MOST_PAIRS {
            let bodies = solid.len();
            return vec![format!(
                "{count} of {bodies} bodies that may meet, found by a tree; time of contact by {finder}"
            )];
        }
        let mut lines = Vec::new();
        for (k, &a) in solid.iter().enumerate() {
            for &b in solid[k + 1..].iter().filter(|&&b| self.may_meet(a, b)) {
                let material = self.material(a, b);
                let what = match material.response {
                    crate::contact::Response::Bounce => format!("bounce, restitution {}", short(material.restitution)),
                    crate::contact::Response::Stick => match self.breaking_load([a, b]) {
                        load if !load.is_finite() => "stick".to_owned(),
                        BreakingLoad { force, torque } if torque.is_infinite() => {
                            format!("stick, up to {} N", short(force))
                        }
                        BreakingLoad { force, torque } if force.is_infinite() => {
                            format!("stick, up to {} N·m", short(torque))
                        }
                        BreakingLoad { force, torque } => {
                            format!("stick, up to {} N and {} N·m", short(force), short(torque))
                        }
                    },
                };
                let friction = match material.friction {
                    0.0 => String::new(),
                    mu => format!(", friction {}", short(mu)),
                };
                let (first, second) = if self.bodies[a].fixed { (b, a) } else { (a, b) };
                let names = [first, second].map(|i| self.bodies[i].name.as_str());
                lines.push(format!("{}–{}: {what}{friction}; time of contact by {finder}", names[0], names[1]));
            }
        }
        lines
    }

    fn write_group(&self, out: &mut String, number: usize, group: &FlightGroup) -> std::fmt::Result {
        let charts = self.charts(number, &[]);
        for (place, (&index, chart)) in group.members.iter().zip(&charts).enumerate() {
            let body = &self.bodies[index];
            let what = match chart {
                Chart::Fixed => "fixed, seen by an effect".to_owned(),
                _ => format!("{}, {} numbers", body.freedom.name(), chart.dimension()),
            };
            let label = if place == 0 { format!("flight {}", number + 1) } else { String::new() };
            writeln!(out, "  {label:<10} {}: {what}", body.name)?;
        }
        let mut names: Vec<(&str, usize)> = Vec::new();
        for binding in &group.bindings {
            let name = binding.effect.name();
            match names.iter_mut().find(|(n, _)| *n == name) {
                Some((_, count)) => *count += 1,
                None => names.push((name, 1)),
            }
        }
        let effects: Vec<_> =
            names.iter().map(|(name, n)| if *n == 1 { (*name).to_owned() } else { format!("{name} ×{n}") }).collect();
        let effects = if effects.is_empty() { "nothing acts on it".to_owned() } else { effects.join(", ") };
        writeln!(out, "  {:<10} {effects}", "")?;
        writeln!(out, "  {:<10} {}: {}", "", group.method, group.why)?;
        for toggle in &group.toggles {
            let (switch, name) = (&toggle.switch, toggle.switch.measure.name());
            let (on, off) = (short(switch.on), short(switch.off));
            writeln!(out, "  {:<10} {} on at {name} {on}, off at {off}", "", toggle.name)?;
        }
        for watch in &group.watches {
            let event = &self.options.events[watch.event];
            let (value, bodies) = (short(event.value), event.bodies.join(", "));
            let ends = if event.terminal { "; ends the run" } else { "" };
            writeln!(
                out,
                "  {:<10} event {}: {} of {bodies} at {value}, {}{ends}",
                "",
                event.name,
                event.measure.name(),
                event.direction.name()
            )?;
        }
        if !group.switches.is_empty() {
            let times: Vec<_> = group.switches.iter().map(|t| short(*t)).collect();
            writeln!(out, "  {:<10} steps end at the switches t = {} s", "", times.join(", "))?;
        }
        Ok(())
    }
}

/// Most pairs that are listed one by one [-].
const MOST_PAIRS: usize = 16;

/// The label on the first line of a block, blanks on the others.
fn label(line: usize, name: &str) -> &str {
    if line == 0 { name } else { "" }
}
