//! How large bumps are, and how many of each size there are (specification 2.3).

use super::bump_noise::Params;
use crate::block::prelude::*;

/// The radii of the sizes of bumps, in pixels.
pub(super) fn radii(params: &Params, width: u32) -> impl Iterator<Item = u32> {
    let widest = convert::wrap(convert::truncate64(params.from * f64::from(width)), u32::MAX);
    let narrowest = params.to * f64::from(width);
    std::iter::successors(Some(widest), |radius| Some(radius / 2))
        .take_while(move |radius| f64::from(*radius) >= narrowest)
}

/// The number of bumps of a radius in pixels.
pub(super) fn bumps(params: &Params, width: u32, radius: u32) -> u32 {
    width / radius * params.quantity.unsigned_abs()
}

/// The number of bumps of a radius that is that share of the width; never more than
/// [`bumps`] of the radius rounded down.
pub(super) fn exact_bumps(params: &Params, share: f64) -> u32 {
    convert::wrap(convert::truncate64(1.0 / share), u32::MAX) * params.quantity.unsigned_abs()
}
