//! Range-Doppler maps of the frames of a cube, which Python holds and the library reads.

use crate::arrays;
use crate::held::samples::Samples;
use crate::held::values::Values;
use artifact::rdm::RdmFrame;
use ndarray::{Ix3, Ix4};
use num_complex::Complex32;
use pyo3::prelude::*;
use std::sync::Arc;
use wayside::stepwise::Processing;

/// Maps and what they were made of.
pub(crate) struct Maps {
    /// Samples that they are of.
    pub(crate) samples: Arc<Samples>,
    /// Receiver of the samples' radar.
    pub(crate) processing: Arc<Processing>,
    /// Values `[frame, channel, doppler, range]`.
    pub(crate) values: Values<Complex32, Ix4>,
    /// State of each cell `[frame, doppler, range]`.
    pub(crate) mask: Values<u8, Ix3>,
    /// Maps without values and masks.
    pub(crate) frames: Vec<RdmFrame>,
}

impl Maps {
    /// Hands the maps over to Python.
    pub(crate) fn of(
        py: Python<'_>,
        samples: Arc<Samples>,
        processing: Processing,
        mut frames: Vec<RdmFrame>,
    ) -> PyResult<Self> {
        let [channels, doppler, range] = artifact::rdm::shape(&samples.header);
        let count = frames.len();
        let values = joined(&mut frames, |frame| &mut frame.values);
        let masks = joined(&mut frames, |frame| &mut frame.mask);
        let values = arrays::shaped(py, values, [count, channels, doppler, range])?;
        let mask = arrays::shaped(py, masks, [count, doppler, range])?;
        let (values, mask) = (Values::of("values", &values), Values::of("mask", &mask));
        Ok(Self { samples, processing: Arc::new(processing), values, mask, frames })
    }

    /// Maps as the library takes them.
    pub(crate) fn frames(&self, py: Python<'_>) -> PyResult<Vec<RdmFrame>> {
        let (values, masks) = (self.values.read(py)?, self.mask.read(py)?);
        let (values, masks) = (values.as_slice()?, masks.as_slice()?);
        let count = self.frames.len().max(1);
        let parts =
            values.chunks((values.len() / count).max(1)).zip(masks.chunks((masks.len() / count).max(1)));
        let frame = |(about, (values, mask)): (&RdmFrame, (&[Complex32], &[u8]))| RdmFrame {
            values: values.to_vec(),
            mask: mask.to_vec(),
            ..about.clone()
        };
        Ok(self.frames.iter().zip(parts).map(frame).collect())
    }
}

/// Values of all frames one behind the other, taken out of them; those of a single frame as they are.
fn joined<T>(frames: &mut [RdmFrame], part: impl Fn(&mut RdmFrame) -> &mut Vec<T>) -> Vec<T> {
    match frames {
        [only] => std::mem::take(part(only)),
        several => several.iter_mut().flat_map(|frame| std::mem::take(part(frame))).collect(),
    }
}
