//! Fewer points for a curve, its extremes kept.

/// A curve with more points than this is thinned to at most so many.
const MOST: usize = 1000;

/// Takes a curve point by point and keeps, of each of a number of equal stretches, the lowest and the highest.
///
/// A stretch with a point that is not defined gives a gap there, unless something in it is defined.
#[derive(Debug)]
pub struct Thinner {
    stretch: usize,
    seen: usize,
    low: Option<(usize, [f64; 2])>,
    high: Option<(usize, [f64; 2])>,
    last_x: f64,
    points: Vec<[f64; 2]>,
}

impl Thinner {
    /// For a curve of at most `total` points.
    #[must_use]
    pub fn new(total: usize) -> Self {
        // Two points of each stretch are kept, and a curve that is short enough keeps all.
        let stretch = if total <= MOST { 1 } else { total.div_ceil(MOST / 2) };
        Self { stretch, seen: 0, low: None, high: None, last_x: 0.0, points: Vec::new() }
    }

    /// The next point.
    pub fn push(&mut self, point: [f64; 2]) {
        if !point[1].is_nan() {
            if self.low.is_none_or(|(_, low)| point[1] < low[1]) {
                self.low = Some((self.seen, point));
            }
            if self.high.is_none_or(|(_, high)| point[1] > high[1]) {
                self.high = Some((self.seen, point));
            }
        }
        self.last_x = point[0];
        self.seen += 1;
        if self.seen.is_multiple_of(self.stretch) {
            self.close();
        }
    }

    fn close(&mut self) {
        match (self.low.take(), self.high.take()) {
            (Some((i, low)), Some((j, high))) => {
                let (first, second) = if i < j { (low, high) } else { (high, low) };
                self.points.push(first);
                if i != j {
                    self.points.push(second);
                }
            }
            _ => {
                // One gap is as good as many.
                if self.points.last().is_some_and(|last| !last[1].is_nan()) {
                    self.points.push([self.last_x, f64::NAN]);
                }
            }
        }
    }

    /// The curve.
    #[must_use]
    pub fn finish(mut self) -> Vec<[f64; 2]> {
        if !self.seen.is_multiple_of(self.stretch) {
            self.close();
        }
        while self.points.last().is_some_and(|last| last[1].is_nan()) {
            self.points.pop();
        }
        self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thinned(values: &[f64]) -> Vec<[f64; 2]> {
        let mut thinner = Thinner::new(values.len());
        values.iter().enumerate().for_each(|(k, y)| thinner.push([k as f64, *y]));
        thinner.finish()
    }

    #[test]
    fn extremes_and_order_survive() {
        let mut values: Vec<f64> = (0..10_001).map(|k| f64::from(k % 7)).collect();
        values[5003] = 100.0;
        values[777] = -100.0;
        let points = thinned(&values);
        assert!(points.len() <= MOST && points.len() > MOST / 2, "{}", points.len());
        assert!(points.contains(&[5003.0, 100.0]) && points.contains(&[777.0, -100.0]));
        assert!(points.windows(2).all(|pair| pair[0][0] < pair[1][0]));
    }

    #[test]
    fn a_short_curve_keeps_every_point_and_gaps_stay() {
        assert_eq!(thinned(&[1.0, 2.0]), [[0.0, 1.0], [1.0, 2.0]]);
        let points = thinned(&[f64::NAN, 1.0, f64::NAN, f64::NAN, 2.0, f64::NAN]);
        assert_eq!(points.len(), 3);
        assert!(points[0] == [1.0, 1.0] && points[1][1].is_nan() && points[2] == [4.0, 2.0], "{points:?}");
    }
}
