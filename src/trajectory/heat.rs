//! Energy that passes in contacts.

/// Energy that passes in contacts, over a time or at once: heat of friction and of gentle impacts, work of bodies
/// that are moved.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Heat {
    /// When it begins [s].
    pub(crate) from: f64,
    /// When it ends [s].
    pub(crate) to: f64,
    /// How much [J].
    pub(crate) joules: f64,
    /// Power at both ends [W].
    pub(crate) power: [f64; 2],
}

impl Heat {
    /// What passes at an instant [s], [J].
    pub(crate) fn at(time: f64, joules: f64) -> Self {
        Self { from: time, to: time, joules, power: [0.0; 2] }
    }

    /// Ends it at a time within it [s], by what has come till then.
    pub(crate) fn cut(&mut self, t: f64) {
        let joules = self.until(t);
        let near = 1e-3 * (self.to - self.from);
        let last = (self.until(t) - self.until(t - near)) / near;
        *self = Self { to: t, joules, power: [self.power[0], last], ..*self };
    }

    /// What has come by a time within it [s]: the cubic through both ends and their powers [J].
    pub(super) fn until(&self, t: f64) -> f64 {
        let h = self.to - self.from;
        let s = ((t - self.from) / h).clamp(0.0, 1.0);
        let [p0, p1] = self.power.map(|p| h * p);
        s * (p0 + s * (3.0 * self.joules - 2.0 * p0 - p1 + s * (p0 + p1 - 2.0 * self.joules)))
    }
}
