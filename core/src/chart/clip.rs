//! What of a line lies within a rectangle.

/// A place on the page, points: x to the right and y down.
pub type Spot = [f64; 2];

/// A rectangle of the page, points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Least x.
    pub left: f64,
    /// Least y.
    pub top: f64,
    /// Greatest x.
    pub right: f64,
    /// Greatest y.
    pub bottom: f64,
}

/// How far outside a point may lie that still counts as inside, points.
const SLACK: f64 = 0.5;

impl Rect {
    /// Its width.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    /// Its height.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Its middle.
    #[must_use]
    pub fn center(&self) -> Spot {
        [0.5 * (self.left + self.right), 0.5 * (self.top + self.bottom)]
    }

    /// Whether a point lies inside, or a hair outside.
    #[must_use]
    pub fn holds(&self, [x, y]: Spot) -> bool {
        (self.left - SLACK..=self.right + SLACK).contains(&x) && (self.top - SLACK..=self.bottom + SLACK).contains(&y)
    }

    /// The nearest point inside.
    #[must_use]
    pub fn nearest(&self, [x, y]: Spot) -> Spot {
        [x.max(self.left).min(self.right), y.max(self.top).min(self.bottom)]
    }

    /// The part of a stretch between two points that lies inside (Liang and Barsky).
    fn clipped(&self, a: Spot, b: Spot) -> Option<[Spot; 2]> {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let (mut from, mut to) = (0.0f64, 1.0f64);
        let sides =
            [(-dx, a[0] - self.left), (dx, self.right - a[0]), (-dy, a[1] - self.top), (dy, self.bottom - a[1])];
        for (step, room) in sides {
            if step == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if step < 0.0 {
                from = from.max(room / step);
            } else {
                to = to.min(room / step);
            }
        }
        (from <= to).then(|| [from, to].map(|share| [a[0] + share * dx, a[1] + share * dy]))
    }

    /// The parts of a line that lie inside.
    #[must_use]
    pub fn inside(&self, line: &[Spot]) -> Vec<Vec<Spot>> {
        let mut parts: Vec<Vec<Spot>> = Vec::new();
        for pair in line.windows(2) {
            let Some([a, b]) = self.clipped(pair[0], pair[1]) else { continue };
            match parts.last_mut() {
                Some(part) if part.last() == Some(&a) => part.push(b),
                _ => parts.push(vec![a, b]),
            }
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_edge() {
        let rect = Rect { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };
        let parts = rect.inside(&[[-5.0, 5.0], [5.0, 5.0], [5.0, 20.0], [8.0, 20.0], [8.0, 5.0]]);
        assert_eq!(parts, vec![vec![[0.0, 5.0], [5.0, 5.0], [5.0, 10.0]], vec![[8.0, 10.0], [8.0, 5.0]]]);
        assert_eq!(rect.inside(&[[-1.0, -1.0], [-5.0, 30.0]]), Vec::<Vec<Spot>>::new());
        assert_eq!(rect.nearest([-3.0, 4.0]), [0.0, 4.0]);
    }
}
