//! The time of contact: between two instants, when does a gap close (lecture §7)?
//!
//! The finders here keep the lecture's terms: they see a collision where the interval ends in
//! overlap. A pass-through within the interval leaves no change of sign, and is not seen.

/// How the time of contact is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Finder {
    /// Halve the interval, keep the half with the change of sign.
    Bisection,
    /// The straight line through both ends, with halvings between so that it cannot stall.
    #[default]
    Secant,
}

impl Finder {
    /// Every finder.
    pub const ALL: &'static [Self] = &[Self::Bisection, Self::Secant];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bisection => "bisection",
            Self::Secant => "secant",
        }
    }
}

/// How a search for an impact ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The interval ends free: no impact that these finders can see.
    Clear,
    /// The gap is in 0..=ε at this time from the interval's start [s].
    At(f64),
    /// The gap never leaves 0..=ε before it closes: the bodies rest on each other, or bounce too low
    /// to be told apart from resting.
    AlreadyTouching,
    /// The interval starts in overlap of this depth [m].
    Overlap(f64),
    /// The interval has shrunk to this time [s] without a gap in 0..=ε.
    Stalled(f64),
}

/// The end of a search, and what it cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// How it ended.
    pub outcome: Outcome,
    /// Rounds of the finder.
    pub iterations: u32,
    /// Evaluations of the gap.
    pub queries: u32,
}

/// Finds the impact in 0..=`h` [s], given the gap [m] as a function of time from the start. Accepted
/// is only a gap in 0..=`eps` [m], never an overlap.
pub fn find_impact(mut gap: impl FnMut(f64) -> f64, h: f64, eps: f64, finder: Finder) -> Impact {
    let mut queries = 0;
    let mut gap = |t: f64| {
        queries += 1;
        gap(t)
    };
    let mut iterations = 0;
    let outcome = search(&mut gap, h, eps, finder, &mut iterations);
    Impact { outcome, iterations, queries }
}

fn search(gap: &mut impl FnMut(f64) -> f64, h: f64, eps: f64, finder: Finder, iterations: &mut u32) -> Outcome {
    // the state of affairs at both ends
    let (mut a, mut gap_a) = (0.0, gap(0.0));
    let (mut b, mut gap_b) = (h, gap(h));
    if gap_a < -eps {
        return Outcome::Overlap(-gap_a);
    }
    if gap_b > eps {
        return Outcome::Clear;
    }

    // a body that has just bounced starts within ε: the search begins where it has left
    if gap_a <= eps {
        a = h / SHORTEST_STAY;
        gap_a = gap(a);
        while gap_a <= eps && a < h {
            a *= 2.0;
            gap_a = gap(a);
        }
        if gap_a <= eps {
            return if gap_b >= 0.0 { Outcome::Clear } else { Outcome::AlreadyTouching };
        }
    }
    if gap_b >= 0.0 {
        return Outcome::At(b);
    }

    // the root stays in [a, b]; the secant aims at the middle of what is accepted
    for round in 0..ROUNDS {
        *iterations = round + 1;
        let halve = finder == Finder::Bisection || round % 2 == 1;
        let t = if halve { 0.5 * (a + b) } else { a + (gap_a - 0.5 * eps) * (b - a) / (gap_a - gap_b) };
        if t <= a || t >= b {
            break;
        }
        let gap_t = gap(t);
        if (0.0..=eps).contains(&gap_t) {
            return Outcome::At(t);
        }
        if gap_t > 0.0 {
            (a, gap_a) = (t, gap_t);
        } else {
            (b, gap_b) = (t, gap_t);
        }
    }
    Outcome::Stalled(a)
}

/// A bounce is looked for from this part of a step on, doubling [-]: a body that leaves ε and is back
/// within the same doubling counts as touching.
const SHORTEST_STAY: f64 = (1_u64 << 40) as f64;
/// Rounds of a finder [-]: bisection from 1 to the smallest subnormal needs 1074, from a step to its
/// last bit 53, and the secant halves in every second round.
const ROUNDS: u32 = 128;

#[cfg(test)]
mod tests {
    use super::*;

    const EPS: f64 = 1e-12;

    #[test]
    fn a_falling_point_is_found_by_both_finders_and_never_below_the_plane() {
        // gap = 1 − t − 5 t²: root t = (√21 − 1)/10; the time may be early by ε/speed
        let root = (21f64.sqrt() - 1.0) / 10.0;
        for &finder in Finder::ALL {
            let gap = |t: f64| 1.0 - t - 5.0 * t * t;
            let Impact { outcome: Outcome::At(t), .. } = find_impact(gap, 1.0, EPS, finder) else {
                panic!("{finder:?} found nothing")
            };
            assert!((0.0..=EPS).contains(&gap(t)));
            assert!((t - root).abs() <= EPS);
        }
    }

    #[test]
    fn the_secant_is_the_faster_one() {
        let gap = |t: f64| 1.0 - t - 5.0 * t * t;
        let [bisection, secant] = [Finder::Bisection, Finder::Secant].map(|f| find_impact(gap, 1.0, EPS, f).iterations);
        // bisection gains a digit in 3.3 rounds: 1e-12 of 1 takes about 40
        assert!((36..=44).contains(&bisection), "{bisection}");
        assert!(secant < bisection / 2, "{secant}");
    }

    #[test]
    fn every_way_to_end_has_its_name() {
        let end = |gap: fn(f64) -> f64| find_impact(gap, 1.0, EPS, Finder::Secant).outcome;
        assert_eq!(end(|_| 1.0), Outcome::Clear);
        assert_eq!(end(|t| t - 0.5), Outcome::Overlap(0.5));
        assert_eq!(end(|t| -t), Outcome::AlreadyTouching);
        assert_eq!(end(|t| 1.0 - t), Outcome::At(1.0));
        // a jump over the band leaves no gap to accept
        let Outcome::Stalled(t) = end(|t| if t < 0.3 { 1.0 } else { -1.0 }) else { panic!("a jump was accepted") };
        assert!((t - 0.3).abs() < 1e-15);
    }

    #[test]
    fn a_body_that_has_just_bounced_is_found_again_where_it_lands() {
        // up from the plane with 1, down with 5 t²: back at t = 1/5
        let Outcome::At(t) = find_impact(|t| t - 5.0 * t * t, 0.3, EPS, Finder::Secant).outcome else {
            panic!("the second contact is missed")
        };
        assert!((t - 0.2).abs() <= EPS);
    }
}
