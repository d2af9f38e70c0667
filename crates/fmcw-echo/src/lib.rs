//! FMCW echoes of scattering paths on an antenna array
