//! Level lines of a map (marching squares).

/// A piece of a level line, in cells: (column, row) of its ends, where (0, 0) is the middle of the first cell.
pub type Piece = [[f64; 2]; 2];

/// The pieces of the line on which `values` (row by row, `columns` to a row) pass `level`. Where a value is NaN there is none.
#[must_use]
pub fn contour(values: &[f64], columns: usize, level: f64) -> Vec<Piece> {
    let rows = values.len().checked_div(columns).unwrap_or(0);
    let mut pieces = Vec::new();
    for row in 0..rows.saturating_sub(1) {
        for column in 0..columns.saturating_sub(1) {
            let at = |x: usize, y: usize| values[(row + y) * columns + column + x] - level;
            // Around the square, so that edge i joins corners i and i + 1.
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
            let heights = corners.map(|(x, y)| at(x, y));
            if heights.iter().any(|height| height.is_nan()) {
                continue;
            }
            let crossing = |i: usize| {
                let (a, b) = (heights[i], heights[(i + 1) % 4]);
                ((a > 0.0) != (b > 0.0)).then(|| {
                    let share = a / (a - b);
                    let ((x0, y0), (x1, y1)) = (corners[i], corners[(i + 1) % 4]);
                    let between = |from: usize, to: usize| from as f64 + (to as f64 - from as f64) * share;
                    [column as f64 + between(x0, x1), row as f64 + between(y0, y1)]
                })
            };
            let points: Vec<[f64; 2]> = (0..4).filter_map(crossing).collect();
            match points[..] {
                [a, b] => pieces.push([a, b]),
                // A saddle: the middle's height says which corners belong together.
                [a, b, c, d] => {
                    let same = (heights.iter().sum::<f64>() > 0.0) == (heights[0] > 0.0);
                    pieces.extend(if same { [[a, b], [c, d]] } else { [[d, a], [b, c]] });
                }
                _ => {}
            }
        }
    }
    pieces
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "what a test compares with need not have the same bits everywhere")]
mod tests {
    use super::*;

    fn map(columns: usize, rows: usize, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        (0..rows).flat_map(|y| (0..columns).map(move |x| (x as f64, y as f64))).map(|(x, y)| f(x, y)).collect()
    }

    #[test]
    fn a_plane_has_a_straight_line_where_it_should_be() {
        let pieces = contour(&map(5, 4, |x, y| x + 2.0 * y), 5, 3.5);
        assert!(!pieces.is_empty());
        assert!(pieces.iter().flatten().all(|[x, y]| (x + 2.0 * y - 3.5).abs() < 1e-12), "{pieces:?}");
        // From x = 3.5 at y = 0 to x = 0 at y = 1.75.
        let length: f64 = pieces.iter().map(|[a, b]| ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()).sum();
        assert!((length - (3.5f64.powi(2) + 1.75f64.powi(2)).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_hill_has_a_closed_line() {
        let pieces = contour(&map(21, 21, |x, y| -(x - 10.0).powi(2) - (y - 10.0).powi(2)), 21, -30.0);
        let ends: Vec<_> = pieces.iter().flatten().map(|p| p.map(|v| (v * 1e9).round() as i64)).collect();
        assert!(pieces.len() > 20);
        assert!(ends.iter().all(|end| ends.iter().filter(|other| *other == end).count() == 2));
    }

    #[test]
    fn what_is_not_known_has_no_line() {
        let values = map(3, 3, |x, y| if x == 1.0 && y == 1.0 { f64::NAN } else { x });
        assert_eq!(contour(&values, 3, 0.5), Vec::<Piece>::new());
        assert_eq!(contour(&[], 0, 0.5), Vec::<Piece>::new());
    }

    #[test]
    fn a_saddle_is_parted_as_its_middle_says() {
        for (high, level) in [(3.0, 1.0), (1.2, 1.0)] {
            // Corners high, 0, high, 0.
            let pieces = contour(&[high, 0.0, 0.0, high], 2, level);
            assert_eq!(pieces.len(), 2);
            let joined = high + high > 4.0 * level;
            // When the middle is high, each line cuts off a low corner: (1, 0) or (0, 1).
            let near_low = pieces.iter().any(|piece| piece.iter().all(|p| p[0] >= 0.5 && p[1] <= 0.5));
            assert_eq!(near_low, joined, "{pieces:?}");
        }
    }
}
