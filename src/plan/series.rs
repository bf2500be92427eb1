//! A flight group on a tape: its motion as power series.

use super::Binding;
use crate::effect::AnyEffect;
use crate::effect::series::{SeriesBody, SeriesLoad, add};
use crate::freedom::Chart;
use crate::math::series::Tape;
use crate::state::{BodyMotion, Load, Moment};

/// Whether the load of an effect has a series.
pub(super) fn has_series(effect: &AnyEffect) -> bool {
    let effect = effect.as_effect();
    effect.is_constant() || effect.has_series()
}

/// The recurrences of bodies with these coordinates, as loads are from the moment `at` on: constant ones, and those of
/// the effects that are not left out.
pub(super) fn tape(
    charts: &[Chart],
    motions: &[BodyMotion],
    (constant, bindings, off): (&[Load], &[Binding], &[usize]),
    at: Moment,
    order: usize,
) -> Tape {
    let mut tape = Tape::new(order);
    let mut first = 0;
    let mut bodies: Vec<Option<SeriesBody>> = Vec::with_capacity(charts.len());
    for (chart, motion) in charts.iter().zip(motions) {
        bodies.push(chart.begin_series(first, motion, &mut tape));
        first += chart.dimension();
    }
    for (i, (chart, body)) in charts.iter().zip(&mut bodies).enumerate() {
        let Some(body) = body else { continue };
        let mut load = SeriesLoad::default();
        let [force, torque] = [constant[i].force, constant[i].torque].map(|v| tape.constant(v));
        add(&mut tape, &mut load.force, force);
        add(&mut tape, &mut load.torque, torque);
        for binding in bindings.iter().filter(|b| b.members.contains(&i) && !off.contains(&b.effect_index)) {
            binding.effect.as_effect().add_series(at, body, &mut load, &mut tape);
        }
        chart.end_series(body, load, &mut tape);
    }
    tape
}
