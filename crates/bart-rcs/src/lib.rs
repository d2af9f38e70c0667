//! Scattering of vehicles at millimetre waves by bidirectional analytic ray tracing (BART)
