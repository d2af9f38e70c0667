//! Serialization of settings of `artifact` under the names in `summary.json`: their serde names are those of
//! the binary records.

use artifact::radar::Sampling;
use artifact::settings::{Detail, StaticEchoes};
use artifact::tracks::TrackState;
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
#[serde(remote = "StaticEchoes", rename_all = "lowercase")]
pub(super) enum StaticWord {
    Keep,
    Mark,
    Remove,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Sampling", rename_all = "lowercase")]
pub(super) enum SamplingWord {
    Complex,
    Real,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Detail", rename_all = "lowercase")]
pub(super) enum DetailWord {
    Auto,
    Paths,
    Merged,
    Centres,
    Statistical,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "TrackState", rename_all = "lowercase")]
pub(super) enum TrackWord {
    Tentative,
    Confirmed,
    Coasting,
}
