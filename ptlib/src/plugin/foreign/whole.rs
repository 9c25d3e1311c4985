//! A block of a plug-in that makes everything in one call, and inputs of graphs, which the caller
//! makes.

use std::ptr;

use ptlib_plugin_abi::ptlp_wire;

use super::{
    super::{
        call::{Call, Means},
        making::Making,
        setup::Setup,
        wires::{NO_TILE, NO_WIRE, image_wire, to_write},
    },
    Factory,
};
use crate::{
    block::{Context, Interpolation, WholeContext, WholeFactory},
    error::Error,
    math::levels::{Continuous, EightBit, Levels, Precision},
    params::ParamValue,
    value::{Image, Kind, Resampling, Value},
};

impl WholeFactory for Factory {
    fn compute(
        &self,
        values: &[ParamValue],
        precision: Precision,
        cx: &WholeContext<'_>,
    ) -> Result<Vec<Value>, Error> {
        let setup = Setup::new(values, precision, cx)?;
        let instance = self.0.prepared(&setup, Means::of(cx))?;
        let kinds = &self.0.outputs;
        let making = Making::new(kinds, cx.inputs, cx.pool);
        let images = cx.planes.outputs.iter().map(|planes| match planes {
            0 => Ok(None),
            planes => image(cx, *planes).map(Some),
        });
        let mut images = images.collect::<Result<Vec<_>, _>>()?;
        let tile = |image: &mut Option<Image>| image.as_mut().map_or(NO_TILE, to_write);
        let tiles: Vec<_> = images.iter_mut().map(tile).collect();
        let wires = tiles.iter().zip(kinds).map(|(tile, kind)| match kind {
            Kind::Image => image_wire(tile),
            kind => ptlp_wire { kind: *kind as u32, ..NO_WIRE },
        });
        let wires: Vec<_> = wires.collect();
        let pointers: Vec<_> = wires.iter().map(ptr::from_ref).collect();
        let call = Call::new(Means { making: Some(&making), ..Means::of(cx) });
        instance.compute(&call, setup.inputs(), &pointers)?;
        let made = images.into_iter().enumerate().map(|(output, image)| match image {
            Some(image) => Ok(Value::Image(image)),
            None => making.take(output),
        });
        made.collect()
    }

    fn is_grey(&self, _: &[ParamValue]) -> Result<bool, Error> {
        Ok(true)
    }

    fn scratch_bytes(&self, values: &[ParamValue], width: u32, height: u32) -> Result<u64, Error> {
        self.0.memory(values, width, height)
    }
}

/// An image that is not a number where the plug-in leaves it as it is: so that this is noticed, and
/// what was in the memory before is not seen.
fn image(cx: &Context<'_>, planes: usize) -> Result<Image, Error> {
    let mut image = cx.new_image(planes)?;
    image.planes_mut().for_each(|plane| plane.fill(f32::NAN));
    Ok(image)
}

/// An input of graphs that a plug-in declares: it gives what the caller set, or else what is at its
/// one input, an image stretched to the size of the graph.
pub(in crate::plugin) struct GraphInput;

impl GraphInput {
    fn value<L: Levels>(cx: &WholeContext<'_>) -> Result<Value, Error> {
        match cx.given_or(0)? {
            Value::Image(image) if (image.width(), image.height()) != (cx.width, cx.height) => {
                let stretched = cx.stretched::<L>(image, image.planes(), Interpolation::Linear)?;
                Ok(stretched.into())
            }
            value => Ok(value.clone()),
        }
    }
}

impl WholeFactory for GraphInput {
    fn compute(
        &self,
        _: &[ParamValue],
        precision: Precision,
        cx: &WholeContext<'_>,
    ) -> Result<Vec<Value>, Error> {
        let value = match precision {
            Precision::EightBit => Self::value::<EightBit>(cx),
            Precision::Float => Self::value::<Continuous>(cx),
        };
        value.map(|value| vec![value])
    }

    fn is_grey(&self, _: &[ParamValue]) -> Result<bool, Error> {
        Ok(true)
    }

    fn scratch_bytes(&self, _: &[ParamValue], width: u32, height: u32) -> Result<u64, Error> {
        Ok(Resampling::bytes_of((width, height)))
    }
}
