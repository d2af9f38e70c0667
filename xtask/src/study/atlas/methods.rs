//! Methods of the stages in the atlas.

use crate::study::atlas::verdict::Trial;

/// Method of a stage.
#[derive(Debug, Clone, Copy)]
pub(super) struct Method {
    stage: &'static str,
    name: &'static str,
}

pub(super) const READ: Method = Method { stage: "scene", name: "read" };
pub(super) const MOTION: Method = Method { stage: "scene", name: "motion" };
pub(super) const MESH: Method = Method { stage: "scene", name: "mesh" };

pub(super) const BART: Method = Method { stage: "bart-rcs", name: "bart" };
pub(super) const EDGES: Method = Method { stage: "bart-rcs", name: "edges" };
pub(super) const PATHS: Method = Method { stage: "bart-rcs", name: "paths" };
pub(super) const SBR: Method = Method { stage: "bart-rcs", name: "sbr" };
pub(super) const PO: Method = Method { stage: "bart-rcs", name: "po" };
pub(super) const RCS_TABLE: Method = Method { stage: "bart-rcs", name: "rcs-table" };
pub(super) const ROAD: Method = Method { stage: "bart-rcs", name: "road" };

pub(super) const FAST_SUM: Method = Method { stage: "fmcw-echo", name: "fast sum" };
pub(super) const RECURRENCE: Method = Method { stage: "fmcw-echo", name: "recurrence" };
pub(super) const INTERFERER: Method = Method { stage: "fmcw-echo", name: "interferer" };
pub(super) const ADC: Method = Method { stage: "fmcw-echo", name: "adc" };

pub(super) const MAP: Method = Method { stage: "dsp", name: "map" };
pub(super) const CA_CFAR: Method = Method { stage: "dsp", name: "ca-cfar" };
pub(super) const ANGLE: Method = Method { stage: "dsp", name: "angle" };
pub(super) const TRACKS: Method = Method { stage: "dsp", name: "tracks" };
pub(super) const DDM: Method = Method { stage: "dsp", name: "ddm" };
pub(super) const BPM: Method = Method { stage: "dsp", name: "bpm" };
pub(super) const CFAR: Method = Method { stage: "dsp", name: "cfar" };
pub(super) const OBJECTS: Method = Method { stage: "dsp", name: "objects" };

pub(super) const TREES: Method = Method { stage: "classifier", name: "trees" };

impl Method {
    /// A case of this method, with one parameter that varies over its rows.
    pub(super) const fn trial(self, case: &'static str, parameter: &'static str) -> Trial {
        Trial { stage: self.stage, method: self.name, case, parameter }
    }
}
