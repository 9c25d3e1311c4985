//! Rows: what a block of shape Point or Gather reads and writes.

use super::store::Store;
use crate::{math::simd::SimdLevel, value::MAX_PLANES};

/// The most inputs of a block.
pub(crate) const MAX_INPUTS: usize = 16;

/// The most planes of all outputs of a block that writes rows.
pub(crate) const MAX_OUTPUT_PLANES: usize = 8;

/// A part of a row of one input image: one slice a plane, none if the input is not connected.
#[derive(Debug, Clone, Copy, Default)]
pub struct PortRow<'a> {
    planes: [&'a [f32]; MAX_PLANES],
    count: usize,
}

impl<'a> PortRow<'a> {
    /// A row of as many planes as `planes` gives.
    #[inline]
    pub fn new(planes: impl IntoIterator<Item = &'a [f32]>) -> Self {
        let mut row = Self::default();
        for plane in planes {
            row.planes[row.count] = plane;
            row.count += 1;
        }
        row
    }
}

/// The rows of all inputs that the block reads at the same position.
#[derive(Debug, Clone, Copy)]
pub struct InputRows<'a> {
    ports: &'a [PortRow<'a>],
}

impl<'a> InputRows<'a> {
    /// The rows of all ports, in their order.
    #[inline]
    #[must_use]
    pub fn new(ports: &'a [PortRow<'a>]) -> Self {
        Self { ports }
    }

    /// Whether input `port` is connected.
    #[inline]
    #[must_use]
    pub fn is_connected(&self, port: usize) -> bool {
        self.ports.get(port).is_some_and(|row| row.count > 0)
    }

    /// The number of planes of input `port`; 0 if it is not connected.
    #[inline]
    #[must_use]
    pub fn planes(&self, port: usize) -> usize {
        self.ports.get(port).map_or(0, |row| row.count)
    }

    /// Channel `channel` of input `port`, which is connected. A grey image has its one plane as
    /// red, green and blue.
    #[inline]
    #[must_use]
    pub fn channel(&self, port: usize, channel: usize) -> &'a [f32] {
        let row = &self.ports[port];
        row.planes[if row.count == 1 { 0 } else { channel }]
    }

    /// Red, green and blue of input `port`, which is connected.
    #[inline]
    #[must_use]
    pub fn rgb(&self, port: usize) -> [&'a [f32]; 3] {
        std::array::from_fn(|channel| self.channel(port, channel))
    }
}

/// The part of a row to write: one slice a plane, all outputs one after the other.
#[derive(Debug)]
pub struct OutputRow<'a> {
    planes: [&'a mut [f32]; MAX_OUTPUT_PLANES],
    count: usize,
    /// How each plane is stored.
    stores: &'a [Store],
    /// Which planes are stored already.
    is_stored: [bool; MAX_OUTPUT_PLANES],
    /// How many values of those were not finite.
    strange: u32,
}

impl<'a> OutputRow<'a> {
    /// A row of as many planes as `planes` gives, with the store of each.
    #[inline]
    pub(crate) fn new(
        planes: impl IntoIterator<Item = &'a mut [f32]>,
        stores: &'a [Store],
    ) -> Self {
        let mut row = Self {
            planes: Default::default(),
            count: 0,
            stores,
            is_stored: [false; MAX_OUTPUT_PLANES],
            strange: 0,
        };
        for plane in planes {
            row.planes[row.count] = plane;
            row.count += 1;
        }
        row
    }

    /// The number of planes.
    #[inline]
    #[must_use]
    pub fn planes(&self) -> usize {
        self.count
    }

    /// Plane `plane`.
    #[inline]
    pub fn plane(&mut self, plane: usize) -> &mut [f32] {
        self.is_stored[plane] = false;
        self.planes[plane]
    }

    /// The one plane of a grey output.
    #[inline]
    pub fn grey(&mut self) -> &mut [f32] {
        self.plane(0)
    }

    /// The three planes of a colour output.
    #[inline]
    pub fn rgb(&mut self) -> [&mut [f32]; 3] {
        self.is_stored = [false; MAX_OUTPUT_PLANES];
        let [red, green, blue, ..] = &mut self.planes;
        [red, green, blue]
    }

    /// All planes, in order.
    #[inline]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut [f32]> {
        self.is_stored = [false; MAX_OUTPUT_PLANES];
        self.planes[..self.count].iter_mut().map(|plane| &mut **plane)
    }

    /// Writes each plane from the same channel of input `port`, value by value.
    #[inline(always)]
    pub fn map(&mut self, inputs: &InputRows<'_>, port: usize, f: impl Fn(f32) -> f32) {
        for channel in 0..self.count {
            let (input, out) = (inputs.channel(port, channel), &mut *self.planes[channel]);
            self.strange += self.stores[channel].map(input, out, &f);
            self.is_stored[channel] = true;
        }
    }

    /// Changes what is in each plane, value by value. The last thing that a block does to a row is
    /// best done so: the values are stored in the same pass.
    #[inline(always)]
    pub fn change(&mut self, f: impl Fn(f32) -> f32) {
        for channel in 0..self.count {
            let plane = &mut *self.planes[channel];
            self.strange += self.stores[channel].change(plane, &f);
            self.is_stored[channel] = true;
        }
    }

    /// Stores what the block wrote. Returns how many values were not finite.
    #[inline]
    pub(crate) fn finish(self, simd: SimdLevel) -> u64 {
        let planes = self.planes.into_iter().zip(self.stores).zip(self.is_stored).take(self.count);
        let late = planes.filter(|(_, is_stored)| !is_stored);
        let strange: u32 = late.map(|((plane, store), _)| store.apply(simd, plane)).sum();
        u64::from(self.strange + strange)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_plane_is_stored_once_it_is_written() {
        let stores = [Store::Unit, Store::Unit, Store::Free];
        let input = [0.25, 1.0, f32::NAN];
        let port = [PortRow::new([&input[..]])];
        let (mut red, mut green, mut blue) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        let planes = [&mut red[..], &mut green, &mut blue];
        let mut row = OutputRow::new(planes, &stores);
        row.map(&InputRows::new(&port), 0, |value| value * 2.0);
        row.change(|value| value * 0.5);
        // Changed after it was stored: it is stored again.
        row.plane(1).fill(-3.0);
        assert_eq!(row.finish(SimdLevel::best()), 3);
        assert_eq!((red, green, blue), ([0.25, 0.5, 0.0], [0.0; 3], [0.25, 1.0, 0.0]));
    }
}
