//! Where the picture is seen from.

use crate::{
    number::{dot, floor, single},
    piece::{GUARD, STEPS},
};

/// A camera with a perspective: right-handed, y up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it is.
    pub eye: [f64; 3],
    /// To the right, up and ahead: perpendicular to each other, of length 1.
    pub axes: [[f64; 3]; 3],
    /// Pixels of a length of 1 that is 1 ahead: half the height through the tangent of half the
    /// vertical angle.
    pub scale: f64,
    /// Width and height of the picture in pixels, at most 65,536.
    pub size: [u32; 2],
    /// What is not so far ahead is not seen. More than 0.
    pub near: f64,
}

/// A vertex in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Column and row in 1/256 pixel, of which the corner of the picture has 0, 0.
    pub at: [i32; 2],
    /// 1 through the distance ahead; 0 for what must be clipped.
    pub inverse: f32,
}

impl Camera {
    /// How far a point lies to the right, up and ahead.
    #[inline]
    #[must_use]
    pub fn to_eye(&self, point: [f64; 3]) -> [f64; 3] {
        let away = [0, 1, 2].map(|axis| point[axis] - self.eye[axis]);
        self.axes.map(|axis| dot(axis, away))
    }

    /// Pixels of a point to the right of the middle and below it, both times the distance ahead,
    /// and that. (From the middle, because far away a move to the corner would swallow the rest.)
    #[inline]
    pub(crate) fn homogeneous(&self, point: [f64; 3]) -> [f64; 3] {
        let [right, up, ahead] = self.to_eye(point);
        [right * self.scale, -up * self.scale, ahead]
    }

    /// Half the width and half the height of the picture.
    #[inline]
    pub(crate) fn half(&self) -> [f64; 2] {
        self.size.map(|side| f64::from(side) / 2.0)
    }

    /// A vertex in the picture.
    #[inline]
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> Place {
        let [x, y, w] = self.homogeneous(point);
        let limit = GUARD * w;
        if w < self.near || x.abs() > limit || y.abs() > limit {
            return Place { at: [0, 0], inverse: 0.0 };
        }
        Place { at: self.snap([x, y, w]), inverse: single(1.0 / w) }
    }

    /// Column and row in steps, kept in the guard band.
    #[inline]
    pub(crate) fn snap(&self, [x, y, w]: [f64; 3]) -> [i32; 2] {
        let [half_x, half_y] = self.half();
        [(x, half_x), (y, half_y)].map(|(x, half)| {
            let pixel = (x / w).clamp(-GUARD, GUARD) + half;
            floor(pixel * f64::from(STEPS) + 0.5)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From (0, 0, 2) along -z, with an angle of 90°.
    fn camera() -> Camera {
        Camera {
            eye: [0.0, 0.0, 2.0],
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
            scale: 50.0,
            size: [200, 100],
            near: 0.01,
        }
    }

    #[test]
    fn the_middle_and_the_upper_edge_are_where_they_belong() {
        let middle = camera().place([0.0; 3]);
        assert_eq!((middle.at, middle.inverse), ([100 * 256, 50 * 256], 0.5));
        assert_eq!(camera().place([0.0, 2.0, 0.0]).at, [100 * 256, 0]);
        assert_eq!(camera().place([1.0, 0.0, 1.0]).at, [150 * 256, 50 * 256]);
    }

    #[test]
    fn what_is_behind_or_far_outside_is_to_be_clipped() {
        let points = [[0.0, 0.0, 3.0], [0.0, 0.0, 1.995], [1e18, 0.0, 0.0], [0.0, -1e18, 1.0]];
        for point in points {
            assert_eq!(camera().place(point).inverse, 0.0, "{point:?}");
        }
    }
}
