//! Axes: which values they span, where these lie, and which of them are labelled.

/// What the steps between labels are multiples of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// 1, 2 or 5 times a power of ten.
    Decimal,
    /// Parts of a right angle.
    Degrees,
    /// Powers of ten, on a logarithmic axis.
    Decades,
}

/// An axis from one side of a frame to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Least and greatest value.
    pub span: [f64; 2],
    /// Where these lie in the picture.
    pub sides: [f64; 2],
    steps: Steps,
    /// The step to which the span was widened, so that both its ends are labelled.
    step: Option<f64>,
}

/// A value that is labelled, and its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// Its label; what follows `^` is to be raised.
    pub label: String,
}

impl Axis {
    /// An axis over a span that is not empty, and positive for [`Steps::Decades`].
    pub fn new(span: [f64; 2], sides: [f64; 2], steps: Steps) -> Self {
        Self { span, sides, steps, step: None }
    }

    /// An axis whose span is widened to the labels around it, about `count` of them.
    pub fn widened(span: [f64; 2], sides: [f64; 2], steps: Steps, count: f64) -> Self {
        let [low, high] = span;
        if steps == Steps::Decades {
            let first = low.log10().floor();
            let span = [first, high.log10().ceil().max(first + 1.0)].map(|exponent| 10_f64.powf(exponent));
            return Self::new(span, sides, steps);
        }
        let step = step(span, steps, count);
        let span = [(low / step + 1e-9).floor() * step, (high / step - 1e-9).ceil() * step];
        Self { span, sides, steps, step: Some(step) }
    }

    /// What places along the axis are proportional to: a value itself, or its decimal logarithm. Not finite where a
    /// logarithmic axis has no place for the value.
    pub fn coordinate(&self, value: f64) -> f64 {
        match self.steps {
            Steps::Decades => value.log10(),
            _ => value,
        }
    }

    /// Where a value lies; none where the axis has no place for it.
    pub fn at(&self, value: f64) -> Option<f64> {
        let [low, high] = self.span.map(|end| self.coordinate(end));
        let share = (self.coordinate(value) - low) / (high - low);
        Some(self.sides[0] + share * (self.sides[1] - self.sides[0])).filter(|place| place.is_finite())
    }

    /// The value that lies at a place: the inverse of [`Self::at`].
    pub fn value_at(&self, place: f64) -> f64 {
        let share = (place - self.sides[0]) / (self.sides[1] - self.sides[0]);
        let [low, high] = self.span;
        match self.steps {
            Steps::Decades => low * (high / low).powf(share),
            _ => low + share * (high - low),
        }
    }

    /// Labels at round values, about `count` of them.
    pub fn ticks(&self, count: f64) -> Vec<Tick> {
        match self.steps {
            Steps::Decades => self.decades(count),
            _ => {
                let step = self.step.unwrap_or_else(|| step(self.span, self.steps, count));
                let multiples =
                    whole((self.span[0] / step - 1e-9).ceil())..=whole((self.span[1] / step + 1e-9).floor());
                multiples.map(|i| tick(f64::from(i) * step, step)).collect()
            }
        }
    }

    /// Powers of ten, with 2 and 5 times them where few lie in the span, and leaving some out where many do.
    fn decades(&self, count: f64) -> Vec<Tick> {
        let [low, high] = self.span.map(f64::log10);
        let exponents = whole((low - 1.0).floor())..=whole(high.ceil());
        let every = whole(((high - low) / count).ceil()).max(1);
        let factors: &[f64] = if high - low <= 0.5 * count { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let inside = |value: &f64| (self.span[0] * (1.0 - 1e-9)..=self.span[1] * (1.0 + 1e-9)).contains(value);
        exponents
            .filter(|exponent| exponent.rem_euclid(every) == 0)
            .flat_map(|exponent| factors.iter().map(move |factor| factor * 10_f64.powi(exponent)))
            .filter(inside)
            .map(|value| tick(value, value))
            .collect()
    }
}

/// The step between about `count` labels.
fn step([low, high]: [f64; 2], steps: Steps, count: f64) -> f64 {
    let least = (high - low) / count;
    let power = 10_f64.powf(least.log10().floor());
    let decimal = [1.0, 2.0, 5.0].map(|factor| factor * power);
    let degrees = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0];
    let choices = if steps == Steps::Degrees && least > 0.5 { &degrees[..] } else { &decimal[..] };
    let otherwise = if steps == Steps::Degrees && least > 90.0 { 180.0 } else { 10.0 * power };
    choices.iter().copied().find(|choice| *choice >= least * (1.0 - 1e-9)).unwrap_or(otherwise)
}

/// A label with the decimals that `step` has.
fn tick(value: f64, step: f64) -> Tick {
    let exponent = whole((step * (1.0 + 1e-9)).log10().floor());
    let decimals = usize::try_from(-exponent).unwrap_or(0);
    let label = match exponent {
        _ if value == 0.0 => "0".to_owned(),
        -4..=5 if value.abs() < 1e5 => signed(&format!("{value:.decimals$}")),
        _ => scientific(value, 2),
    };
    Tick { value, label }
}

/// A number with three digits that count.
pub fn three_digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = whole(value.abs().log10().floor());
    match exponent {
        -3..=5 => signed(&format!("{value:.*}", usize::try_from(2 - exponent).unwrap_or(0))),
        _ => scientific(value, 1),
    }
}

/// A number as a mantissa, without zeros at its end, and a power of ten, `10^n`.
fn scientific(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    let power = signed(exponent);
    match mantissa {
        "1" => format!("10^{power}"),
        "-1" => format!("\u{2212}10^{power}"),
        _ => format!("{}·10^{power}", signed(mantissa)),
    }
}

/// A number's text with minus signs in place of hyphens.
fn signed(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

#[expect(clippy::cast_possible_truncation, reason = "labels and decades of f64 are few; `as` saturates beyond")]
fn whole(value: f64) -> i32 {
    value as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(span: [f64; 2], steps: Steps, count: f64, expected: &str) {
        let ticks = Axis::new(span, [0.0, 1.0], steps).ticks(count);
        let labels: Vec<_> = ticks.into_iter().map(|tick| tick.label).collect();
        assert_eq!(labels.join(" "), expected, "{span:?}");
    }

    #[test]
    fn labels_stand_at_round_values() {
        check([0.0, 1234.0], Steps::Decimal, 6.0, "0 500 1000");
        check([-0.3, 0.3], Steps::Decimal, 6.0, "\u{2212}0.3 \u{2212}0.2 \u{2212}0.1 0 0.1 0.2 0.3");
        check([0.0, 4e-9], Steps::Decimal, 4.0, "0 10^\u{2212}9 2·10^\u{2212}9 3·10^\u{2212}9 4·10^\u{2212}9");
        check([0.0, 3e7], Steps::Decimal, 3.0, "0 10^7 2·10^7 3·10^7");
        check([-90.0, 90.0], Steps::Degrees, 6.0, "\u{2212}90 \u{2212}60 \u{2212}30 0 30 60 90");
        check([0.0, 0.3], Steps::Degrees, 3.0, "0 0.1 0.2 0.3");
        check([-360.0, 360.0], Steps::Degrees, 4.0, "\u{2212}360 \u{2212}180 0 180 360");
        check([0.1, 20.0], Steps::Decades, 6.0, "0.1 0.2 0.5 1 2 5 10 20");
        check([0.001, 1e6], Steps::Decades, 5.0, "0.01 1 100 10000 10^6");
    }

    #[test]
    fn both_ends_of_a_widened_axis_are_labelled() {
        for high in [0.3, 0.9, 1.1, 3.9, 7.3, 41.0] {
            for count in [4.0, 6.0] {
                let axis = Axis::widened([-0.9 * high, high], [0.0, 1.0], Steps::Decimal, count);
                let ticks = axis.ticks(count);
                let ends = [ticks.first(), ticks.last()].map(|tick| tick.expect("labels").value);
                let apart = (ends[0] - axis.span[0]).abs().max((ends[1] - axis.span[1]).abs());
                assert!(apart < 1e-9 * high, "{ends:?} of {:?}", axis.span);
            }
        }
    }

    #[test]
    fn values_lie_between_the_sides() {
        let linear = Axis::widened([-0.1, 9.2], [100.0, 0.0], Steps::Decimal, 5.0);
        assert_eq!(linear.span, [-2.0, 10.0], "widened");
        assert_eq!(Axis::widened([-1e-13, 500.0], [0.0, 1.0], Steps::Decimal, 5.0).span, [0.0, 500.0], "as it is");
        assert_eq!([linear.at(-2.0), linear.at(4.0), linear.at(10.0)], [Some(100.0), Some(50.0), Some(0.0)], "linear");
        let decades = Axis::widened([0.2, 50.0], [0.0, 3.0], Steps::Decades, 5.0);
        assert_eq!(decades.span, [0.1, 100.0], "widened");
        assert!((decades.at(10.0).unwrap() - 2.0).abs() < 1e-12, "logarithmic");
        assert_eq!([decades.at(0.0), decades.at(-1.0)], [None, None], "no place");
        for (axis, value) in [(linear, 4.0), (decades, 20.0)] {
            let place = axis.at(value).expect("a place");
            assert!((axis.value_at(place) / value - 1.0).abs() < 1e-12, "{value} from its place {place}");
        }
    }

    #[test]
    fn figures_have_three_digits() {
        for (value, expected) in [
            (0.0, "0"),
            (415.838, "416"),
            (18.0, "18.0"),
            (0.01234, "0.0123"),
            (123_456.0, "123456"),
            (3.2e7, "3.2·10^7"),
            (-2e-12, "\u{2212}2·10^\u{2212}12"),
        ] {
            assert_eq!(three_digits(value), expected, "{value}");
        }
    }
}
