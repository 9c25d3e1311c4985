//! What other crates offer for work that a row of ours does: whom a user would take in our place.
//!
//! Both sides get the same picture, the same size and one thread, run by turns in one process, and
//! write into memory of their own. A peer need not give the same bits, and hardly one does: what
//! differs stands in [`Peer::does`], and results that should be alike are compared all the same,
//! since a fast wrong answer is none on their side either. Peers are built as their users build
//! them: for any CPU, choosing instructions at run time if they can.

mod filters;
mod noises;
mod resampling;

use std::fs;

use ptlib::Image;

use crate::{Result, definition::home};

/// What is to be done.
pub(crate) struct Task {
    /// The size of the result.
    pub(crate) size: (u32, u32),
    /// The picture that ours reads; its first plane is taken.
    pub(crate) picture: Option<Image>,
}

/// Work that can be repeated.
pub(crate) trait Contender {
    /// Does it once more.
    fn run(&mut self) -> Result;
    /// What it gave: brightnesses 0..1, or for noise any numbers.
    fn values(&self) -> Vec<f32>;
}

/// A peer.
pub(crate) struct Peer {
    /// What definitions call it: the crate, and which work of it.
    name: &'static str,
    /// What it does, and in what that differs from ours.
    pub(crate) does: &'static str,
    /// How far its values may be from ours, if they mean the same.
    near: Option<f32>,
    /// Makes it ready.
    pub(crate) make: fn(&Task) -> Result<Box<dyn Contender>>,
}

/// The peer of that name.
pub(crate) fn find(name: &str) -> Result<&'static Peer> {
    let all = || noises::PEERS.iter().chain(filters::PEERS).chain(resampling::PEERS);
    let known = || all().map(|peer| peer.name).collect::<Vec<_>>().join("\", \"");
    let found = all().find(|peer| peer.name == name);
    Ok(found.ok_or_else(|| format!("no peer \"{name}\", but \"{}\"", known()))?)
}

/// Pixels at the edges that are not compared: ours read beyond them around the picture, others
/// may repeat the last pixel.
const EDGE: usize = 104;

impl Peer {
    /// The crate and the version of it that this program was built with.
    pub(crate) fn release(&self) -> String {
        let name = self.name.split(',').next().unwrap_or(self.name);
        let lock = fs::read_to_string(home().join("../Cargo.lock")).unwrap_or_default();
        let entry = format!("name = \"{name}\"\nversion = \"");
        let version = lock.split_once(&entry).and_then(|(_, rest)| rest.split('"').next());
        format!("{name} {}", version.unwrap_or("of an unknown version"))
    }

    /// Whether a peer's result is one.
    pub(crate) fn check(&self, contender: &dyn Contender, ours: &Image) -> Result {
        let (theirs, ours_values) = (contender.values(), ours.channel(0));
        let finite = theirs.iter().all(|value| value.is_finite());
        let range = theirs.iter().fold((f32::MAX, f32::MIN), |(least, most), value| {
            (least.min(*value), most.max(*value))
        });
        if theirs.len() != ours_values.len() || !finite || range.1 - range.0 < 0.1 {
            return Err(format!("gives {} numbers within {range:?}", theirs.len()).into());
        }
        let Some(near) = self.near else { return Ok(()) };
        let (width, height) = (ours.width() as usize, ours.height() as usize);
        for y in EDGE..height.saturating_sub(EDGE) {
            for x in EDGE..width.saturating_sub(EDGE) {
                let (their, our) = (theirs[y * width + x], ours_values[y * width + x]);
                if (their - our).abs() > near {
                    return Err(format!("gives {their} at {x}, {y}, where we give {our}").into());
                }
            }
        }
        Ok(())
    }
}

/// A sample of a picture.
trait Sample: Copy {
    fn brightness(self) -> f32;
}

impl Sample for f32 {
    fn brightness(self) -> f32 {
        self
    }
}

impl Sample for u8 {
    fn brightness(self) -> f32 {
        f32::from(self) / 255.0
    }
}

/// Work on samples of one plane.
struct Samples<T, F> {
    out: Vec<T>,
    work: F,
}

impl<T: Sample, F: FnMut(&mut Vec<T>) -> Result> Contender for Samples<T, F> {
    fn run(&mut self) -> Result {
        (self.work)(&mut self.out)
    }

    fn values(&self) -> Vec<f32> {
        self.out.iter().map(|sample| sample.brightness()).collect()
    }
}

/// Work that writes into memory that is there, or puts other memory in its place.
fn samples<T: Sample + Default + 'static>(
    task: &Task,
    work: impl FnMut(&mut Vec<T>) -> Result + 'static,
) -> Box<dyn Contender> {
    let (width, height) = task.size;
    let out = vec![T::default(); width as usize * height as usize];
    Box::new(Samples { out, work })
}

impl Task {
    /// The picture's first plane.
    fn plane(&self) -> Result<Vec<f32>> {
        let picture = self.picture.as_ref().ok_or("the graph reads no picture")?;
        Ok(picture.channel(0).to_vec())
    }

    /// The same in 8 bits.
    fn bytes(&self) -> Result<Vec<u8>> {
        Ok(self.plane()?.into_iter().map(byte).collect())
    }
}

fn byte(value: f32) -> u8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is clamped")]
    let byte = (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    byte
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{definition, options::Options};

    #[test]
    fn every_peer_does_what_the_row_does() {
        let options = Options::read(&["--runs", "1"].map(str::to_owned)).unwrap();
        let mut count = 0;
        for mut definition in definition::all(&[]).unwrap() {
            if definition.peers.is_empty() {
                continue;
            }
            let side = 2 * u32::try_from(EDGE).unwrap() + 48;
            definition.size = [side; 2];
            definition.picture = definition.picture.map(|_| [side / 2; 2]);
            let (rows, _) = definition.measure_peers(&options).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(rows.len(), definition.peers.len());
            assert!(rows.iter().all(|row| row.ratio > 0.0 && row.peer.contains('.')), "{rows:?}");
            count += rows.len();
        }
        assert!(count >= noises::PEERS.len() + filters::PEERS.len() + resampling::PEERS.len());
    }

    #[test]
    fn a_wrong_answer_is_no_result() {
        struct Black;
        impl Contender for Black {
            fn run(&mut self) -> Result {
                Ok(())
            }
            fn values(&self) -> Vec<f32> {
                vec![0.0; 64]
            }
        }
        let ours = crate::given::card((8, 8)).unwrap();
        let peer = find("noise, value").unwrap();
        assert!(peer.check(&Black, &ours).is_err());
        assert!(find("noise, brown").err().unwrap().to_string().contains("noise, value"));
    }
}
