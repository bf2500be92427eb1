//! Small dense systems: Cholesky's factor, and the solution of least norm.
//!
//! Vectors stand on the stack up to four contacts of three rows, which is what most clusters have.
//!
//! Written out here because the products of a general library pick their kernels, and so their last
//! digits, by the processor they run on. Matrices are square, stored by columns.
//!
//! The least-norm solution of `A x = b` answers redundant contacts: a cube on four corners has a system
//! of rank three, and of all its solutions the shortest is the one that shares its symmetry. By a
//! complete orthogonal decomposition (Golub & Van Loan 2013, §5.5):
//!
//! ```text
//! Qᵀ A P = [R₁₁ R₁₂; 0 0]        Householder, the largest remaining column first; rank = size of R₁₁
//! [R₁₁ R₁₂]ᵀ = Z [T; 0]          Householder again
//! x = P Z [T⁻ᵀ (Qᵀ b)₁; 0]
//! ```

use smallvec::SmallVec;

/// A vector of a small system.
pub type Vector = SmallVec<[f64; 12]>;

/// A square matrix, by columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    size: usize,
    entries: Vec<f64>,
}

impl Dense {
    /// A matrix of zeros.
    pub fn zeros(size: usize) -> Self {
        Self { size, entries: vec![0.0; size * size] }
    }

    /// A matrix from its entries by row and column.
    pub fn from_fn(size: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Self::zeros(size);
        for c in 0..size {
            for r in 0..size {
                matrix.set(r, c, entry(r, c));
            }
        }
        matrix
    }

    /// Number of rows, which is that of columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The entry of row `r` and column `c`.
    #[inline]
    pub fn at(&self, r: usize, c: usize) -> f64 {
        self.entries[c * self.size + r]
    }

    /// Sets the entry of row `r` and column `c`.
    #[inline]
    pub fn set(&mut self, r: usize, c: usize, value: f64) {
        self.entries[c * self.size + r] = value;
    }

    /// The column `c`.
    #[inline]
    fn column(&self, c: usize) -> &[f64] {
        &self.entries[c * self.size..(c + 1) * self.size]
    }

    /// Multiplies the entry (r, c) by `size[r / block] · size[c / block]`.
    pub(crate) fn scale(&mut self, size: &[f64], block: usize) {
        for (c, column) in self.entries.chunks_exact_mut(self.size.max(1)).enumerate() {
            for (part, s) in column.chunks_mut(block).zip(size) {
                for x in part {
                    *x = s * *x * size[c / block];
                }
            }
        }
    }

    /// Exchanges two columns.
    fn swap_columns(&mut self, c: usize, d: usize) {
        for row in 0..self.size {
            self.entries.swap(c * self.size + row, d * self.size + row);
        }
    }

    /// `A x + b`.
    pub fn times_plus(&self, x: &[f64], b: &[f64]) -> Vector {
        let mut y = Vector::from_slice(b);
        for (c, &factor) in x.iter().enumerate() {
            if factor != 0.0 {
                for (y, a) in y.iter_mut().zip(self.column(c)) {
                    *y += a * factor;
                }
            }
        }
        y
    }

    /// `xᵀ A x`.
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        dot(x, &self.times_plus(x, &zeros(self.size)))
    }

    /// The rows and columns in `kept`.
    #[must_use]
    pub fn part(&self, kept: &[usize]) -> Self {
        Self::from_fn(kept.len(), |r, c| self.at(kept[r], kept[c]))
    }

    /// The same matrix with `shift` added to the diagonal.
    #[must_use]
    pub fn shifted(&self, shift: f64) -> Self {
        let mut shifted = self.clone();
        for k in 0..self.size {
            shifted.entries[k * self.size + k] += shift;
        }
        shifted
    }
}

/// A vector of zeros.
pub fn zeros(size: usize) -> Vector {
    Vector::from_elem(0.0, size)
}

/// `a · b`, added in order.
#[inline]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The largest magnitude; infinite if an entry is not a number, so that no comparison takes it for small.
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, x| if x.is_nan() { f64::INFINITY } else { m.max(x.abs()) })
}

/// Cholesky's factor of a symmetric positive definite matrix.
#[derive(Debug, Clone)]
pub struct Cholesky(Dense);

impl Cholesky {
    /// Factors `A = L Lᵀ`; `None` if A is not positive definite in the arithmetic used.
    pub fn new(a: &Dense) -> Option<Self> {
        let n = a.size;
        let mut l = a.clone();
        for c in 0..n {
            let pivot = l.at(c, c);
            if pivot.is_nan() || pivot <= 0.0 {
                return None;
            }
            let root = pivot.sqrt();
            for r in c..n {
                l.set(r, c, l.at(r, c) / root);
            }
            for k in c + 1..n {
                let factor = l.at(k, c);
                if factor != 0.0 {
                    for r in k..n {
                        l.set(r, k, l.at(r, k) - factor * l.at(r, c));
                    }
                }
            }
        }
        Some(Self(l))
    }

    /// Solves `A x = b`.
    pub fn solve(&self, b: &[f64]) -> Vector {
        let (l, n) = (&self.0, self.0.size);
        let mut x = Vector::from_slice(b);
        for c in 0..n {
            x[c] /= l.at(c, c);
            for r in c + 1..n {
                x[r] -= l.at(r, c) * x[c];
            }
        }
        for c in (0..n).rev() {
            for r in c + 1..n {
                x[c] -= l.at(r, c) * x[r];
            }
            x[c] /= l.at(c, c);
        }
        x
    }
}

/// How small a column may become before it counts as dependent on those before it, as a fraction of the
/// largest [-]. Contact systems come scaled to a unit diagonal; a mass ratio of 1e6 leaves independent
/// contacts at 1e-6, rounding leaves dependent ones at 1e-15. Larger: heavy bodies on light ones are taken
/// for redundant. Smaller: redundant contacts get impulses of rounding over rounding.
const RANK: f64 = 1.0e-12;

/// The shortest `x` of those that bring `A x` nearest to `b`; refined twice against the given matrix.
pub fn least_norm(a: &Dense, b: &[f64]) -> Vector {
    if let Some(x) = solve_small(a, b) {
        return x;
    }
    let factors = Orthogonal::new(a);
    let mut x = factors.solve(b);
    for _ in 0..2 {
        let minus: Vector = x.iter().map(|x| -x).collect();
        let rest = a.times_plus(&minus, b);
        for (x, dx) in x.iter_mut().zip(factors.solve(&rest)) {
            *x += dx;
        }
    }
    x
}

/// The solution for up to three unknowns, by elimination with the largest pivot of all first, refined once; none
/// where the rank is deficient.
fn solve_small(a: &Dense, b: &[f64]) -> Option<Vector> {
    let n = a.size;
    if n > SMALL {
        return None;
    }
    let mut right = [0.0; SMALL];
    right[..n].copy_from_slice(b);
    let x = eliminate(a, right)?;
    let mut rest = right;
    for (r, rest) in rest[..n].iter_mut().enumerate() {
        *rest -= (0..n).map(|c| a.at(r, c) * x[c]).sum::<f64>();
    }
    let correction = eliminate(a, rest)?;
    Some((0..n).map(|k| x[k] + correction[k]).collect())
}

/// One elimination of up to three unknowns.
fn eliminate(a: &Dense, b: [f64; SMALL]) -> Option<[f64; SMALL]> {
    let (n, mut rows, mut order) = (a.size, [[0.0; SMALL + 1]; SMALL], [0, 1, 2]);
    for (r, row) in rows[..n].iter_mut().enumerate() {
        (0..n).for_each(|c| row[c] = a.at(r, c));
        row[SMALL] = b[r];
    }
    let mut first = 0.0;
    for k in 0..n {
        // the largest pivot; of equal ones the first
        let (mut best, mut at) = (0.0, (k, k));
        for (r, row) in rows[..n].iter().enumerate().skip(k) {
            for (c, entry) in row[..n].iter().enumerate().skip(k) {
                if entry.abs() > best * (1.0 + 1e-12) {
                    (best, at) = (entry.abs(), (r, c));
                }
            }
        }
        first = if k == 0 { best } else { first };
        if best <= RANK * first || !best.is_finite() {
            return None;
        }
        rows.swap(k, at.0);
        rows[..n].iter_mut().for_each(|row| row.swap(k, at.1));
        order.swap(k, at.1);
        let pivot = rows[k];
        for row in &mut rows[k + 1..n] {
            let factor = row[k] / pivot[k];
            (k..=SMALL).for_each(|c| row[c] -= factor * pivot[c]);
        }
    }
    let mut x = [0.0; SMALL];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|c| rows[k][c] * x[order[c]]).sum();
        x[order[k]] = (rows[k][SMALL] - known) / rows[k][k];
    }
    Some(x)
}

/// Unknowns that are solved without a matrix on the heap [-]: those of one contact with friction.
const SMALL: usize = 3;

/// A complete orthogonal decomposition.
struct Orthogonal {
    rank: usize,
    /// R above the diagonal, the reflectors of Q below with their leading entry in `heads`.
    r: Dense,
    heads: Vector,
    order: SmallVec<[usize; 12]>,
    /// The same for `[R₁₁ R₁₂]ᵀ`, where the rank is deficient.
    second: Option<(Dense, Vector)>,
}

impl Orthogonal {
    fn new(a: &Dense) -> Self {
        let n = a.size;
        let mut r = a.clone();
        let mut order: SmallVec<[usize; 12]> = (0..n).collect();
        let mut heads = zeros(n);
        let mut rank = n;
        let mut first = 0.0;
        for (k, head) in heads.iter_mut().enumerate() {
            // the largest remaining column; of equal ones the first
            let size_of = |r: &Dense, c: usize| dot(&r.column(c)[k..], &r.column(c)[k..]);
            let mut best = (k, size_of(&r, k));
            for c in k + 1..n {
                let size = size_of(&r, c);
                if size > best.1 * (1.0 + 1e-12) {
                    best = (c, size);
                }
            }
            let size = best.1.sqrt();
            first = if k == 0 { size } else { first };
            if size <= RANK * first || size == 0.0 {
                rank = k;
                break;
            }
            r.swap_columns(k, best.0);
            order.swap(k, best.0);
            *head = reflect_column(&mut r, k, n, n);
        }

        // the second reduction, of the transposed upper part
        let second = (rank < n).then(|| {
            let mut t = Dense::from_fn(n, |row, c| if c < rank && c <= row { r.at(c, row) } else { 0.0 });
            let heads = (0..rank).map(|k| reflect_column(&mut t, k, n, rank)).collect();
            (t, heads)
        });
        Self { rank, r, heads, order, second }
    }

    fn solve(&self, b: &[f64]) -> Vector {
        let n = b.len();
        let mut y = Vector::from_slice(b);
        for k in 0..self.rank {
            apply_reflector(&self.r, self.heads[k], k, &mut y);
        }
        if let Some((t, heads)) = &self.second {
            // Tᵀ z = (Qᵀ b)₁ from the top, then Z
            y[self.rank..].fill(0.0);
            for k in 0..self.rank {
                let known: f64 = (0..k).map(|j| t.at(j, k) * y[j]).sum();
                y[k] = (y[k] - known) / t.at(k, k);
            }
            for k in (0..self.rank).rev() {
                apply_reflector(t, heads[k], k, &mut y);
            }
        } else {
            for k in (0..n).rev() {
                let known: f64 = (k + 1..n).map(|j| self.r.at(k, j) * y[j]).sum();
                y[k] = (y[k] - known) / self.r.at(k, k);
            }
        }
        let mut x = zeros(n);
        for (k, &place) in self.order.iter().enumerate() {
            x[place] = y[k];
        }
        x
    }
}

/// Reflects column `k` onto its diagonal entry and the columns up to `columns` with it; the reflector stays
/// below the diagonal, its leading entry is returned.
fn reflect_column(a: &mut Dense, k: usize, rows: usize, columns: usize) -> f64 {
    let size = dot(&a.column(k)[k..], &a.column(k)[k..]).sqrt();
    if size == 0.0 {
        return 0.0;
    }
    let diagonal = if a.at(k, k) > 0.0 { -size } else { size };
    let head = a.at(k, k) - diagonal;
    // H = 1 − v vᵀ / (−diagonal · head), v = (head, rest)
    let scale = -diagonal * head;
    let n = a.size;
    let (left, right) = a.entries.split_at_mut((k + 1) * n);
    let below = &left[k * n + k + 1..k * n + rows];
    for column in right[..(columns - k - 1) * n].chunks_exact_mut(n) {
        let factor = (head * column[k] + dot(below, &column[k + 1..rows])) / scale;
        for (x, v) in column[k + 1..rows].iter_mut().zip(below) {
            *x -= factor * v;
        }
        column[k] -= factor * head;
    }
    a.set(k, k, diagonal);
    head
}

/// Applies the reflector of column `k` to a vector.
fn apply_reflector(a: &Dense, head: f64, k: usize, y: &mut [f64]) {
    if head == 0.0 {
        return;
    }
    let below = &a.column(k)[k + 1..];
    let factor = (head * y[k] + dot(below, &y[k + 1..])) / (-a.at(k, k) * head);
    y[k] -= factor * head;
    for (y, v) in y[k + 1..].iter_mut().zip(below) {
        *y -= factor * v;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `A = Bᵀ B` of rank `rank`, with entries from a recurrence.
    fn gram(size: usize, rank: usize) -> Dense {
        let mut seed = 1u64;
        let mut next = move || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        let b: Vec<Vec<f64>> = (0..size).map(|_| (0..rank).map(|_| next()).collect()).collect();
        Dense::from_fn(size, |r, c| dot(&b[r], &b[c]))
    }

    #[test]
    fn the_least_norm_solution_solves_and_lies_in_the_range() {
        for (size, rank) in [(1, 1), (4, 3), (9, 6), (20, 20), (30, 6)] {
            let a = gram(size, rank);
            // b in the range, so that it can be met; the shortest x is in the range of Aᵀ = A: x = A y
            let y: Vec<f64> = (0..size).map(|k| libm::sin(k as f64 + 1.0)).collect();
            let expected = a.times_plus(&y, &vec![0.0; size]);
            let b = a.times_plus(&expected, &vec![0.0; size]);
            let x = least_norm(&a, &b);
            // condition number of these matrices up to 1e4
            let error = x.iter().zip(&expected).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
            assert!(error < 1e-11 * largest(&expected), "{size} of rank {rank}: {error:e}");
        }
    }

    #[test]
    fn equal_columns_share_equally() {
        // one equation, three unknowns: x₁ + x₂ + x₃ = 6
        let a = Dense::from_fn(3, |_, _| 1.0);
        let x = least_norm(&a, &[6.0; 3]);
        assert!(x.iter().all(|x| (x - 2.0).abs() < 8.0 * f64::EPSILON), "{x:?}");
    }

    #[test]
    fn a_definite_matrix_is_solved_and_an_indefinite_one_refused() {
        let a = gram(6, 6).shifted(0.1);
        let b = [1.0, -2.0, 3.0, 0.5, 0.0, 1.0];
        let x = Cholesky::new(&a).unwrap().solve(&b);
        let rest = a.times_plus(&x.iter().map(|x| -x).collect::<Vec<_>>(), &b);
        assert!(largest(&rest) < 1e-14 * 3.0, "{rest:?}");
        assert!(Cholesky::new(&Dense::from_fn(2, |_, _| 1.0).shifted(-0.5)).is_none());
    }
}
