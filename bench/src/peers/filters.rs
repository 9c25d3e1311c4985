//! Filters that look at the pixels around a pixel.

use image::{GrayImage, ImageBuffer, Luma};
use imageproc::kernel::Kernel;
use libblur::{
    BlurImage, BlurImageMut, BoxBlurParameters, EdgeMode, EdgeMode2D, FastBlurChannels,
    GaussianBlurParams, IeeeBinaryConvolutionMode, KernelShape, Scalar, ThreadingPolicy,
};

use super::{Contender, Peer, Task, samples};
use crate::Result;

/// Two steps of 8 bits, and a little: what is read is rounded, and what is written is cut off.
const STEP: f32 = 2.01 / 255.0;
/// What sums in another order may differ by.
const ORDER: f32 = 1e-4;
/// What kernels of other lengths may differ by.
const LENGTH: f32 = 0.02;

pub(super) static PEERS: &[Peer] = &[
    Peer {
        name: "libblur, box 10",
        does: "mean of 21 × 21 pixels",
        near: Some(ORDER),
        make: |task| blurred(task, 10),
    },
    Peer {
        name: "libblur, box 100",
        does: "mean of 201 × 201 pixels",
        near: Some(ORDER),
        make: |task| blurred(task, 100),
    },
    Peer {
        name: "imageproc, box 10",
        does: "mean of 21 × 21 pixels, of 8 bits",
        near: Some(STEP),
        make: |task| boxed(task, 10),
    },
    Peer {
        name: "imageproc, box 100",
        does: "mean of 201 × 201 pixels, of 8 bits",
        near: Some(STEP),
        make: |task| boxed(task, 100),
    },
    Peer {
        name: "libblur, gaussian",
        does: "13 taps along rows, then along columns; ours takes columns first",
        near: Some(LENGTH),
        make: libblur_gaussian,
    },
    Peer {
        name: "imageproc, gaussian",
        does: "9 taps along rows, then along columns; ours takes 13",
        near: Some(LENGTH),
        make: imageproc_gaussian,
    },
    Peer {
        name: "libblur, convolution 3",
        does: "3 × 3 weights",
        near: Some(ORDER),
        make: |task| libblur_convolution(task, &WEIGHTS_3, 3),
    },
    Peer {
        name: "libblur, convolution 5",
        does: "5 × 5 weights",
        near: Some(ORDER),
        make: |task| libblur_convolution(task, &WEIGHTS_5, 5),
    },
    Peer {
        name: "imageproc, convolution 3",
        does: "3 × 3 weights",
        near: Some(ORDER),
        make: |task| imageproc_convolution(task, &WEIGHTS_3, 3),
    },
    Peer {
        name: "imageproc, convolution 5",
        does: "5 × 5 weights",
        near: Some(ORDER),
        make: |task| imageproc_convolution(task, &WEIGHTS_5, 5),
    },
];

/// The weights of `convolution-3.xml`: no rank of 1, no symmetry that a filter could use.
static WEIGHTS_3: [f32; 9] = [0.05, 0.1, 0.07, 0.12, 0.3, 0.08, 0.06, 0.13, 0.09];

/// The weights of `convolution-5.xml`.
#[rustfmt::skip]
static WEIGHTS_5: [f32; 25] = [
    0.01, 0.02, 0.03, 0.02, 0.015,
    0.02, 0.05, 0.06, 0.04, 0.025,
    0.03, 0.07, 0.11, 0.08, 0.035,
    0.02, 0.04, 0.09, 0.05, 0.02,
    0.01, 0.03, 0.025, 0.02, 0.08,
];

const SIGMA: f32 = 2.0;
const EDGES: EdgeMode2D = EdgeMode2D::new(EdgeMode::Clamp);

type Floats = ImageBuffer<Luma<f32>, Vec<f32>>;

/// Work of libblur: it reads a plane and writes another.
fn libblur(
    task: &Task,
    work: impl Fn(&BlurImage<'_, f32>, &mut BlurImageMut<'_, f32>) -> Result + 'static,
) -> Result<Box<dyn Contender>> {
    let ((width, height), plane) = (task.size, task.plane()?);
    Ok(samples(task, move |out| {
        let source = BlurImage::borrow(&plane, width, height, FastBlurChannels::Plane);
        let mut target = BlurImageMut::borrow(out, width, height, FastBlurChannels::Plane);
        work(&source, &mut target)
    }))
}

fn blurred(task: &Task, radius: u32) -> Result<Box<dyn Contender>> {
    let parameters = BoxBlurParameters::new(2 * radius + 1);
    libblur(task, move |source, target| {
        Ok(libblur::box_blur_f32(source, target, parameters, ThreadingPolicy::Single)?)
    })
}

fn libblur_gaussian(task: &Task) -> Result<Box<dyn Contender>> {
    let parameters = GaussianBlurParams::new(13, f64::from(SIGMA));
    let (threads, sums) = (ThreadingPolicy::Single, IeeeBinaryConvolutionMode::Normal);
    libblur(task, move |source, target| {
        Ok(libblur::gaussian_blur_f32(source, target, parameters, EDGES, threads, sums)?)
    })
}

fn libblur_convolution(
    task: &Task,
    weights: &'static [f32],
    side: usize,
) -> Result<Box<dyn Contender>> {
    libblur(task, move |source, target| {
        let (shape, border) = (KernelShape::new(side, side), Scalar::dup(0.0));
        let threads = ThreadingPolicy::Single;
        Ok(libblur::filter_2d(source, target, weights, shape, EDGES, border, threads)?)
    })
}

fn boxed(task: &Task, radius: u32) -> Result<Box<dyn Contender>> {
    let (width, height) = task.size;
    let image = GrayImage::from_raw(width, height, task.bytes()?).ok_or("a plane")?;
    Ok(samples(task, move |out| {
        *out = imageproc::filter::box_filter(&image, radius, radius).into_raw();
        Ok(())
    }))
}

fn imageproc(
    task: &Task,
    work: impl Fn(&Floats) -> Floats + 'static,
) -> Result<Box<dyn Contender>> {
    let (width, height) = task.size;
    let image = Floats::from_raw(width, height, task.plane()?).ok_or("a plane")?;
    Ok(samples(task, move |out| {
        *out = work(&image).into_raw();
        Ok(())
    }))
}

fn imageproc_gaussian(task: &Task) -> Result<Box<dyn Contender>> {
    imageproc(task, |image| imageproc::filter::gaussian_blur_f32(image, SIGMA))
}

fn imageproc_convolution(
    task: &Task,
    weights: &'static [f32],
    side: u32,
) -> Result<Box<dyn Contender>> {
    imageproc(task, move |image| {
        imageproc::filter::filter(image, Kernel::new(weights, side, side), |sum: f32| sum)
    })
}
