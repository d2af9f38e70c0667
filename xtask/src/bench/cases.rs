//! The comparisons by room.

mod timing;
mod echo;
mod maps;
mod scattering;

use crate::bench::comparison::Comparison;
pub(crate) use timing::{CHARTED, FULL, QUICK, Sizes};
use wayside::host::failure::Failure;

pub(crate) fn all(sizes: Sizes) -> Result<Vec<Comparison>, Failure> {
    let mut list = scattering::all(sizes)?;
    list.extend(echo::all(sizes)?);
    list.extend(maps::all(sizes)?);
    Ok(list)
}
