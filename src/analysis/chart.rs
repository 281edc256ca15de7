//! Charts and tables that are not a scene's own plots.

/// Panels of curves or maps under one title.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// Its panels, in reading order.
    pub panels: Vec<Panel>,
}

/// One pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// What sets it apart from the other panels.
    pub title: String,
    /// What the abscissa is, with its unit.
    pub x_label: String,
    /// What the ordinate is, with its unit.
    pub y_label: String,
    /// What is drawn.
    pub body: Body,
}

/// What a panel holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// Curves over an angle in degrees, from zero upwards.
    Lines(Vec<Line>),
    /// A quantity over two others.
    Map(Map),
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its name in the legend.
    pub label: String,
    /// Whether it is dashed, as papers set one curve apart.
    pub dashed: bool,
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
}

/// Cells of equal size, each with the value at its middle.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Least and greatest abscissa, degrees.
    pub x: [f64; 2],
    /// Least and greatest ordinate.
    pub y: [f64; 2],
    /// Cells in a row.
    pub columns: usize,
    /// Values from the lower left, row by row upwards; not a number where there is none.
    pub values: Vec<f64>,
    /// What the values are.
    pub label: String,
}

/// Rows of text under a heading.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names of the columns.
    pub heading: Vec<String>,
    /// As many cells each as the heading has.
    pub rows: Vec<Vec<String>>,
}

impl Map {
    /// Rows of cells.
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    /// Least and greatest value; none where there is no number.
    pub fn span(&self) -> Option<[f64; 2]> {
        let numbers = self.values.iter().copied().filter(|value| value.is_finite());
        numbers.fold(None, |span, value| {
            let [low, high] = span.unwrap_or([value; 2]);
            Some([value.min(low), value.max(high)])
        })
    }
}

impl Line {
    /// A function over a range, at `samples` abscissae, at least 2.
    pub fn of(label: impl Into<String>, range: [f64; 2], samples: usize, value: impl Fn(f64) -> f64) -> Self {
        let steps = (samples.max(2) - 1) as f64;
        let x: Vec<f64> = (0..samples.max(2)).map(|i| range[0] + (range[1] - range[0]) * i as f64 / steps).collect();
        let y = x.iter().map(|x| value(*x)).collect();
        Self { label: label.into(), dashed: false, x, y }
    }

    /// The same curve dashed.
    pub fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }
}
