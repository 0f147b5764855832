//! Ten thousand samples into a few hundred columns of pixels, losing no peak and closing no gap.

use super::scale::Scale;

/// What one column of pixels shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// The column's place, points.
    pub x: f64,
    /// Smallest value in it.
    pub low: f64,
    /// Largest value in it.
    pub high: f64,
    /// Whether the smallest came before the largest.
    pub rising: bool,
}

impl Column {
    /// The one or two values that a line through the column passes, in the order of time.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        let (first, second) = if self.rising { (self.low, self.high) } else { (self.high, self.low) };
        std::iter::once(first).chain((second != first).then_some(second))
    }
}

/// Samples `(time, value)` in the order of time, as unbroken stretches of columns, one per pixel.
///
/// A value that is not a number ends a stretch. `pixel` is a pixel's width in points.
#[must_use]
pub fn columns(samples: impl Iterator<Item = (f64, f64)>, time: &Scale, pixel: f64) -> Vec<Vec<Column>> {
    let mut stretches = Vec::new();
    let mut stretch: Vec<Column> = Vec::new();
    let (mut x, mut until) = (0.0, f64::NEG_INFINITY);
    for (t, value) in samples {
        if value.is_nan() {
            if !stretch.is_empty() {
                stretches.push(std::mem::take(&mut stretch));
            }
            continue;
        }
        // The column's end is kept as a time, so that few samples are mapped.
        if t >= until {
            let left = libm::floor(time.at(t) / pixel) * pixel;
            x = left + 0.5 * pixel;
            until = time.unbounded(left + pixel);
        }
        match stretch.last_mut() {
            Some(column) if column.x == x => {
                if value < column.low {
                    (column.low, column.rising) = (value, false);
                } else if value > column.high {
                    (column.high, column.rising) = (value, true);
                }
            }
            _ => stretch.push(Column { x, low: value, high: value, rising: true }),
        }
    }
    if !stretch.is_empty() {
        stretches.push(stretch);
    }
    stretches
}

/// Stretches of columns in which a predicate holds, as `(first x, last x)`.
#[must_use]
pub fn spans(stretches: &[Vec<Column>], holds: impl Fn(&Column) -> bool) -> Vec<(f64, f64)> {
    let mut spans: Vec<(f64, f64)> = Vec::new();
    for stretch in stretches {
        let mut open = false;
        for column in stretch {
            let inside = holds(column);
            match spans.last_mut() {
                Some(span) if inside && open => span.1 = column.x,
                _ if inside => spans.push((column.x, column.x)),
                _ => {}
            }
            open = inside;
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis() -> Scale {
        Scale::new([0.0, 10.0], [0.0, 100.0])
    }

    #[test]
    fn no_peak_is_lost() {
        let samples = (0..=10_000).map(|k| (f64::from(k) * 1e-3, if k == 5_432 { 9.0 } else { f64::from(k % 3) }));
        let stretches = columns(samples, &axis(), 1.0);
        assert_eq!(stretches.len(), 1);
        assert!(stretches[0].len() <= 101);
        let highest = stretches[0].iter().max_by(|a, b| a.high.total_cmp(&b.high)).expect("columns");
        assert_eq!((highest.high, highest.x), (9.0, 54.5));
        assert!(stretches[0].iter().all(|column| column.low == 0.0 || column.x > 99.0));
    }

    #[test]
    fn what_is_not_defined_is_a_gap_and_never_zero() {
        let samples = [(0.0, f64::NAN), (1.0, 5.0), (2.0, 6.0), (3.0, f64::NAN), (4.0, 7.0), (5.0, f64::NAN)];
        let stretches = columns(samples.into_iter(), &axis(), 1.0);
        assert_eq!(stretches.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
        assert!(stretches.iter().flatten().all(|column| column.low >= 5.0));
        assert!(columns([(1.0, f64::NAN)].into_iter(), &axis(), 1.0).is_empty());
    }

    #[test]
    fn a_column_keeps_the_order_of_its_extremes() {
        let falling = columns([(0.01, 5.0), (0.02, 8.0), (0.03, 1.0)].into_iter(), &axis(), 1.0);
        assert_eq!(falling[0][0].values().collect::<Vec<_>>(), [8.0, 1.0]);
        let single = columns([(0.01, 5.0)].into_iter(), &axis(), 1.0);
        assert_eq!(single[0][0].values().collect::<Vec<_>>(), [5.0]);
    }

    #[test]
    fn spans_name_what_is_outside() {
        let samples = (0..100).map(|k| (f64::from(k) * 0.1, if (20..30).contains(&k) || k > 90 { 9.0 } else { 1.0 }));
        let stretches = columns(samples, &axis(), 1.0);
        let spans = spans(&stretches, |column| column.high > 5.0);
        assert_eq!(spans.len(), 2);
        assert!(spans[0].0 < spans[0].1 && spans[0].1 < spans[1].0);
    }

    #[test]
    fn ten_thousand_samples_become_one_column_a_pixel() {
        let samples: Vec<(f64, f64)> = (0..=10_000).map(|k| (f64::from(k) * 1e-3, f64::from(k % 17))).collect();
        let axis = Scale::new([0.0, 10.0], [0.0, 1000.0]);
        let stretches = columns(samples.iter().copied(), &axis, 1.0);
        let places: Vec<f64> = stretches.iter().flatten().map(|column| column.x).collect();
        assert_eq!(places, (0..=1000).map(|pixel| f64::from(pixel) + 0.5).collect::<Vec<_>>());
    }
}
