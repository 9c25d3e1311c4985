//! Where the nodes of a glTF put their meshes (glTF 2.0, section 3.5.3).

use gltf::json::scene::Node;
use ptlib_plugin::math::single;

/// A linear map, by columns, and a shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transform {
    columns: [[f64; 3]; 3],
    shift: [f64; 3],
}

impl Transform {
    /// Leaves everything where it is.
    pub(super) const IDENTITY: Self =
        Self { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] };

    /// What a node does to its mesh and its children: its matrix, or scaling, turning and shifting.
    pub(super) fn of(node: &Node) -> Self {
        if let Some(matrix) = &node.matrix {
            let column = |i: usize| [0, 1, 2].map(|row| f64::from(matrix[4 * i + row]));
            return Self { columns: [0, 1, 2].map(column), shift: column(3) };
        }
        let scale = node.scale.unwrap_or([1.0; 3]).map(f64::from);
        let turn = node.rotation.map_or([0.0, 0.0, 0.0, 1.0], |rotation| rotation.0);
        let turn = turn.map(f64::from);
        let mut columns = turned(turn);
        for (column, scale) in columns.iter_mut().zip(scale) {
            *column = column.map(|number| number * scale);
        }
        Self { columns, shift: node.translation.unwrap_or_default().map(f64::from) }
    }

    /// First `other`, then this.
    pub(super) fn after(&self, other: &Self) -> Self {
        Self {
            columns: other.columns.map(|column| self.linear(column)),
            shift: self.place(other.shift),
        }
    }

    fn linear(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.columns;
        std::array::from_fn(|row| a[row] * x + b[row] * y + c[row] * z)
    }

    fn place(&self, place: [f64; 3]) -> [f64; 3] {
        let linear = self.linear(place);
        std::array::from_fn(|row| linear[row] + self.shift[row])
    }

    /// Where it puts a position.
    pub(super) fn position(&self, position: [f32; 3]) -> [f32; 3] {
        self.place(position.map(f64::from)).map(single)
    }

    /// Whether it turns left hands into right ones, and so the fronts of triangles to the back.
    pub(super) fn mirrors(&self) -> bool {
        let [a, b, c] = self.columns;
        dot(a, cross(b, c)) < 0.0
    }

    /// The direction of a normal, of any length: the inverse transpose but for a factor.
    pub(super) fn normal(&self, normal: [f32; 3]) -> [f32; 3] {
        let [a, b, c] = self.columns;
        let cofactors = Self { columns: [cross(b, c), cross(c, a), cross(a, b)], shift: [0.0; 3] };
        let sign = if self.mirrors() { -1.0 } else { 1.0 };
        let turned = cofactors.linear(normal.map(f64::from));
        let length = dot(turned, turned).sqrt();
        let factor = if length > 0.0 { sign / length } else { 0.0 };
        turned.map(|number| single(number * factor))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The columns of a turn, given as a quaternion.
fn turned([x, y, z, w]: [f64; 4]) -> [[f64; 3]; 3] {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
        [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
        [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
}
