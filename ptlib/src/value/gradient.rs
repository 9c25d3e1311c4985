//! Gradients: colours along a line from 0 to 1.

/// A colour at a position of a [`Gradient`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradientStop {
    /// Where, 0..1.
    pub position: f32,
    /// Red, green, blue, each 0..1.
    pub color: [f32; 3],
}

/// Colours along a line from 0 to 1: constant before the first stop and after the last, linear
/// between. Without stops, the middle grey 128/255 everywhere (specification 2.43).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gradient {
    stops: Vec<GradientStop>,
}

impl Gradient {
    /// A gradient of `stops`, sorted by position; of stops at one position the first counts.
    #[must_use]
    pub fn new(mut stops: Vec<GradientStop>) -> Self {
        stops.sort_by(|a, b| a.position.total_cmp(&b.position));
        stops.dedup_by(|later, earlier| later.position == earlier.position);
        Self { stops }
    }

    /// The stops, by rising position.
    #[must_use]
    pub fn stops(&self) -> &[GradientStop] {
        &self.stops
    }

    /// The colour at `position`.
    #[must_use]
    pub fn color_at(&self, position: f32) -> [f32; 3] {
        let after = self.stops.partition_point(|stop| stop.position <= position);
        match (after.checked_sub(1).map(|i| self.stops[i]), self.stops.get(after)) {
            (None, None) => [128.0 / 255.0; 3],
            (Some(stop), None) => stop.color,
            (None, Some(stop)) => stop.color,
            (Some(a), Some(b)) => {
                let t = (position - a.position) / (b.position - a.position);
                std::array::from_fn(|c| a.color[c] * (1.0 - t) + b.color[c] * t)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stop(position: f32, grey: f32) -> GradientStop {
        GradientStop { position, color: [grey; 3] }
    }

    #[test]
    fn first_of_equal_positions_counts() {
        let gradient = Gradient::new(vec![stop(0.5, 0.1), stop(0.5, 0.9), stop(0.0, 0.3)]);
        assert_eq!(gradient.stops(), &[stop(0.0, 0.3), stop(0.5, 0.1)]);
    }

    #[test]
    fn constant_outside_and_linear_inside() {
        let gradient = Gradient::new(vec![stop(0.25, 0.0), stop(0.75, 1.0)]);
        assert_eq!(gradient.color_at(0.0), [0.0; 3]);
        assert_eq!(gradient.color_at(0.5), [0.5; 3]);
        assert_eq!(gradient.color_at(1.0), [1.0; 3]);
        assert_eq!(Gradient::default().color_at(0.3), [128.0 / 255.0; 3]);
    }
}
