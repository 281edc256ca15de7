//! Nonlinear least squares within bounds.

/// Residuals whose sum of squares is to be small.
pub trait Residuals {
    /// The residuals at x.
    fn residuals(&self, x: &[f64]) -> Vec<f64>;

    /// Their derivatives at x, one column a parameter.
    fn jacobian(&self, x: &[f64]) -> Vec<Vec<f64>>;
}

/// A step that lowers the sum by less than this share is the last.
const ENOUGH: f64 = 1e-5;

/// Damping from where no step is worth trying.
const MOST_DAMPING: f64 = 1e7;

/// Moves x, every parameter within its bounds, towards the least sum of squares in its neighbourhood, by at most so many
/// steps; the sum there. None when cancelled.
///
/// Damped Gauss–Newton steps on the parameters that are free: those at a bound which the sum would push across stay.
/// A step is cut at the bounds, and taken only where it lowers the sum, so that the result is never worse than x was.
///
/// **Source:** D. Marquardt, *An Algorithm for Least-Squares Estimation of Nonlinear Parameters*, 1963; the bounds by
/// D. Bertsekas, *Projected Newton Methods*, 1982. **Domain:** finite residuals within the bounds.
pub fn least_squares(
    problem: &impl Residuals,
    x: &mut Vec<f64>,
    bounds: &[[f64; 2]],
    steps: u32,
    is_cancelled: impl Fn() -> bool,
) -> Option<f64> {
    let mut residuals = problem.residuals(x);
    let mut sum = square(&residuals);
    let mut damping = 1e-3;
    for _ in 0..steps {
        let jacobian = problem.jacobian(x);
        let gradient: Vec<f64> = jacobian.iter().map(|column| dot(column, &residuals)).collect();
        let is_free = |i: &usize| {
            let [low, high] = bounds[*i];
            !(x[*i] <= low && gradient[*i] > 0.0 || x[*i] >= high && gradient[*i] < 0.0)
        };
        let free: Vec<usize> = (0..x.len()).filter(is_free).collect();
        let normal = normal_matrix(&jacobian, &free);
        let before = sum;
        while damping < MOST_DAMPING {
            if is_cancelled() {
                return None;
            }
            let step = damped_step(&normal, &gradient, &free, damping);
            let mut trial = x.clone();
            for (i, step) in free.iter().zip(step) {
                trial[*i] = (trial[*i] + step).clamp(bounds[*i][0], bounds[*i][1]);
            }
            let trial_residuals = problem.residuals(&trial);
            let trial_sum = square(&trial_residuals);
            if trial_sum < sum {
                (*x, residuals, sum) = (trial, trial_residuals, trial_sum);
                damping = (damping / 5.0).max(1e-9);
                break;
            }
            damping *= 4.0;
        }
        if before - sum <= ENOUGH * before {
            break;
        }
    }
    Some(sum)
}

/// JᵀJ of the free columns: its lower triangle, row by row.
fn normal_matrix(jacobian: &[Vec<f64>], free: &[usize]) -> Vec<Vec<f64>> {
    let row = |i: usize| free[..=i].iter().map(|j| dot(&jacobian[free[i]], &jacobian[*j])).collect();
    (0..free.len()).map(row).collect()
}

/// The solution of (A + λ·diag A)·step = −gradient, by Cholesky's factors.
fn damped_step(normal: &[Vec<f64>], gradient: &[f64], free: &[usize], damping: f64) -> Vec<f64> {
    let count = free.len();
    let largest = (0..count).map(|i| normal[i][i]).fold(f64::MIN_POSITIVE, f64::max);
    let mut factor: Vec<Vec<f64>> = Vec::with_capacity(count);
    for (i, row) in normal.iter().enumerate() {
        let mut next = row.clone();
        // What no residual depends on must not make the matrix singular.
        next[i] += damping * row[i] + 1e-14 * largest;
        for (j, known) in factor.iter().enumerate() {
            next[j] = (next[j] - dot(&next[..j], &known[..j])) / known[j];
        }
        next[i] = (next[i] - square(&next[..i])).max(1e-16 * largest).sqrt();
        factor.push(next);
    }
    let mut step: Vec<f64> = free.iter().map(|i| -gradient[*i]).collect();
    for (i, row) in factor.iter().enumerate() {
        step[i] = (step[i] - dot(&row[..i], &step[..i])) / row[i];
    }
    for i in (0..count).rev() {
        let above: f64 = (i + 1..count).map(|j| factor[j][i] * step[j]).sum();
        step[i] = (step[i] - above) / factor[i][i];
    }
    step
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn square(a: &[f64]) -> f64 {
    dot(a, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = a·exp(−b·t) at t = 0, 1, …
    struct Decay(Vec<f64>);

    impl Residuals for Decay {
        fn residuals(&self, x: &[f64]) -> Vec<f64> {
            (0_u32..).zip(&self.0).map(|(t, y)| x[0] * (-x[1] * f64::from(t)).exp() - y).collect()
        }

        fn jacobian(&self, x: &[f64]) -> Vec<Vec<f64>> {
            let times = || (0_u32..).zip(&self.0).map(|(t, _)| f64::from(t));
            let of_a = times().map(|t| (-x[1] * t).exp()).collect();
            vec![of_a, times().map(|t| -x[0] * t * (-x[1] * t).exp()).collect()]
        }
    }

    fn decay() -> Decay {
        Decay((0_u32..8).map(|t| 3.0 * (-0.4 * f64::from(t)).exp()).collect())
    }

    #[test]
    fn parameters_are_found_again() {
        let mut x = vec![1.0, 1.5];
        let sum = least_squares(&decay(), &mut x, &[[0.0, 10.0]; 2], 50, || false).expect("nobody cancels");
        assert!(sum < 1e-12 && (x[0] - 3.0).abs() < 1e-6 && (x[1] - 0.4).abs() < 1e-6, "{x:?} with {sum:e}");
    }

    #[test]
    fn a_parameter_stays_at_the_bound_that_it_would_cross_and_the_other_is_best_for_it() {
        let mut x = vec![1.0, 1.5];
        least_squares(&decay(), &mut x, &[[0.0, 10.0], [0.7, 2.0]], 50, || false).expect("nobody cancels");
        let shape: Vec<f64> = (0_u32..8).map(|t| (-0.7 * f64::from(t)).exp()).collect();
        let best = dot(&shape, &decay().0) / square(&shape);
        assert!(x[1] == 0.7 && (x[0] - best).abs() < 1e-6, "{x:?}, not {best}");
    }

    #[test]
    fn a_cancelled_one_has_no_result() {
        assert_eq!(least_squares(&decay(), &mut vec![1.0, 1.5], &[[0.0, 10.0]; 2], 50, || true), None, "cancelled");
    }
}
