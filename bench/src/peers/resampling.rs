//! Pictures of another size.

use image::{
    ImageBuffer, Luma,
    imageops::{self, FilterType},
};

use super::{Contender, Peer, Task, samples};
use crate::Result;

pub(super) static PEERS: &[Peer] = &[Peer {
    name: "image, resize",
    does: "linear interpolation; not repeating, and measured from centres of pixels",
    near: None,
    make: resized,
}];

fn resized(task: &Task) -> Result<Box<dyn Contender>> {
    let picture = task.picture.as_ref().ok_or("the graph reads no picture")?;
    let (width, height) = (picture.width(), picture.height());
    let image: ImageBuffer<Luma<f32>, Vec<f32>> =
        ImageBuffer::from_raw(width, height, task.plane()?).ok_or("a plane")?;
    let size = task.size;
    Ok(samples(task, move |out| {
        *out = imageops::resize(&image, size.0, size.1, FilterType::Triangle).into_raw();
        Ok(())
    }))
}
