//! Range-Doppler maps of the frames of a cube or of a file, which Python holds and the library reads.

use crate::arrays;
use crate::shared::samples::Samples;
use crate::shared::values::Values;
use artifact::Provenance;
use artifact::cube::CubeHeader;
use artifact::rdm::{Rdm, RdmFrame};
use ndarray::{Ix3, Ix4};
use num_complex::Complex32;
use pyo3::prelude::*;
use std::sync::Arc;
use wayside::stepwise::{CompleteArtifact, Processing};

/// Maps and what they were made of.
pub(crate) struct Maps {
    /// Origin of the maps.
    pub(crate) from: Provenance,
    /// The radar and the settings of its processing.
    pub(crate) header: CubeHeader,
    /// Samples that they are of; `None` of a file.
    pub(crate) samples: Option<Arc<Samples>>,
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
        recorded: CompleteArtifact<Rdm>,
        processing: Processing,
        samples: Option<Arc<Samples>>,
    ) -> PyResult<Self> {
        let CompleteArtifact { from, header, mut frames } = recorded;
        let [channels, doppler, range] = artifact::rdm::shape(&header);
        let count = frames.len();
        let values = joined(&mut frames, |frame| &mut frame.values);
        let masks = joined(&mut frames, |frame| &mut frame.mask);
        let values = arrays::shaped(py, values, [count, channels, doppler, range])?;
        let mask = arrays::shaped(py, masks, [count, doppler, range])?;
        let (values, mask) = (Values::of("values", &values), Values::of("mask", &mask));
        Ok(Self { from, header, samples, processing: Arc::new(processing), values, mask, frames })
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

    /// Artifact of the maps.
    pub(crate) fn recorded(&self, py: Python<'_>) -> PyResult<CompleteArtifact<Rdm>> {
        Ok(CompleteArtifact {
            from: self.from.clone(),
            header: self.header.clone(),
            frames: self.frames(py)?,
        })
    }
}

/// Values of all frames one behind the other, taken out of them; those of a single frame as they are.
fn joined<T>(frames: &mut [RdmFrame], part: impl Fn(&mut RdmFrame) -> &mut Vec<T>) -> Vec<T> {
    match frames {
        [only] => std::mem::take(part(only)),
        several => several.iter_mut().flat_map(|frame| std::mem::take(part(frame))).collect(),
    }
}
