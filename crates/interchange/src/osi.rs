//! Messages of ASAM OSI 3.8: the fields that are read or written here, by the numbers of the standard
//! (`docs/decisions/osi.md`). A missing field is `None`.

pub(crate) mod common;
pub(crate) mod moving_object;
pub(crate) mod sensor_data;
pub(crate) mod sensor_view;
pub(crate) mod descriptors;
