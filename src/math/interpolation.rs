//! Interpolation at Chebyshev's nodes, and what an integral becomes when its integrand is interpolated.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes an axis.
pub const NODES: usize = 8;

/// Values at the nodes of a square, row by row.
pub type Grid = [[f64; NODES]; NODES];

/// The nodes and what belongs to them.
#[derive(Debug)]
pub struct Chebyshev {
    /// x_k = cos((k + ½)π/N), on [−1, 1].
    pub nodes: [f64; NODES],
    /// T_j(x_k), j first.
    polynomials: [[f64; NODES]; NODES],
    /// ∫ ℓ_k over [−1, 1]: Fejér's first rule.
    pub weights: [f64; NODES],
}

/// The one set of nodes that there is.
pub static CHEBYSHEV: LazyLock<Chebyshev> = LazyLock::new(Chebyshev::new);

impl Chebyshev {
    fn new() -> Self {
        let nodes = std::array::from_fn(|k| (PI * (k as f64 + 0.5) / NODES as f64).cos());
        let polynomials =
            std::array::from_fn(|j| std::array::from_fn(|k| (PI * j as f64 * (k as f64 + 0.5) / NODES as f64).cos()));
        let mut rule = Self { nodes, polynomials, weights: [0.0; NODES] };
        rule.weights = rule.basis_integrals(-1.0, 1.0);
        rule
    }

    /// ∫ ℓ_k over [a, b], ℓ_k the polynomial that is 1 at node k and 0 at the others.
    pub fn basis_integrals(&self, a: f64, b: f64) -> [f64; NODES] {
        self.combine(std::array::from_fn(|j| antiderivative(j, b) - antiderivative(j, a)))
    }

    /// ℓ_k at x.
    pub fn basis(&self, x: f64) -> [f64; NODES] {
        self.combine(std::array::from_fn(|j| polynomial(j, x)))
    }

    /// ℓ_k = (2/N) Σ′ T_j(x_k) T_j, the first term halved, for what is linear in T_j.
    fn combine(&self, of_polynomials: [f64; NODES]) -> [f64; NODES] {
        std::array::from_fn(|k| {
            let sum: f64 = (1..NODES).map(|j| self.polynomials[j][k] * of_polynomials[j]).sum();
            (of_polynomials[0] + 2.0 * sum) / NODES as f64
        })
    }

    /// The size of the last two coefficients of the polynomial through `values` at the nodes.
    ///
    /// Where the coefficients have begun to fall, each by a factor q < ½ or less, the polynomial is within this of what
    /// it interpolates: the error is no more than twice the sum of the coefficients left out.
    pub fn tail(&self, values: impl Fn(usize) -> f64) -> f64 {
        let coefficient = |j: usize| {
            let polynomial = &self.polynomials[j];
            (0..NODES).map(|k| polynomial[k] * values(k)).sum::<f64>().abs()
        };
        (coefficient(NODES - 1) + coefficient(NODES - 2)) * 2.0 / NODES as f64
    }
}

/// ∫ ℓ_k ℓ_l over [−1, 1]² of a constant density.
pub fn even_weights(density: f64) -> Grid {
    CHEBYSHEV.weights.map(|row| CHEBYSHEV.weights.map(|column| density * row * column))
}

/// T_j(x).
fn polynomial(j: usize, x: f64) -> f64 {
    let (mut value, mut next) = (1.0, x);
    for _ in 0..j {
        (value, next) = (next, 2.0 * x * next - value);
    }
    value
}

/// ∫ T_j.
fn antiderivative(j: usize, x: f64) -> f64 {
    match j {
        0 => x,
        1 => 0.5 * x * x,
        _ => 0.5 * (polynomial(j + 1, x) / (j + 1) as f64 - polynomial(j - 1, x) / (j - 1) as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_below_the_number_of_nodes_are_integrated_to_rounding() {
        let f = |x: f64| 3.0 + x * (1.0 - x * x * (2.0 - 5.0 * x.powi(4)));
        let whole = |x: f64| 3.0 * x + x * x / 2.0 - x.powi(4) / 2.0 + 5.0 * x.powi(8) / 8.0;
        for (a, b) in [(-1.0, 1.0), (0.25, 0.5), (-1.0, -0.9)] {
            let weights = CHEBYSHEV.basis_integrals(a, b);
            let sum: f64 = (0..NODES).map(|k| weights[k] * f(CHEBYSHEV.nodes[k])).sum();
            assert!((sum - (whole(b) - whole(a))).abs() < 1e-14, "[{a}, {b}]: {sum}");
        }
    }

    #[test]
    fn the_basis_is_one_at_its_own_node_and_zero_at_the_others() {
        for (i, node) in CHEBYSHEV.nodes.iter().enumerate() {
            for (k, value) in CHEBYSHEV.basis(*node).into_iter().enumerate() {
                assert!((value - f64::from(u8::from(i == k))).abs() < 1e-14, "{value} of {k} at {i}");
            }
        }
    }

    #[test]
    fn the_tail_bounds_the_error_of_interpolation() {
        for pole in [1.5, 2.0, 4.0] {
            let f = |x: f64| (x - pole).recip();
            let tail = CHEBYSHEV.tail(|k| f(CHEBYSHEV.nodes[k]));
            let error = (0..=100).map(|i| f64::from(i) / 50.0 - 1.0).map(|x| {
                let basis = CHEBYSHEV.basis(x);
                ((0..NODES).map(|k| basis[k] * f(CHEBYSHEV.nodes[k])).sum::<f64>() - f(x)).abs()
            });
            let error = error.fold(0.0, f64::max);
            assert!(error <= tail && tail <= 100.0 * error, "pole {pole}: {error} and {tail}");
        }
    }
}
