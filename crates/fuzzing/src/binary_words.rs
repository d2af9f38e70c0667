//! Numbers within bytes.

use crate::rng::FuzzRng;

/// Changes a word of 32 bits anywhere to one that is strange as a float, or to any.
pub fn mutate_word32(rng: &mut FuzzRng, bytes: &mut [u8]) {
    let strange =
        [f32::NAN, f32::INFINITY, -f32::MAX, f32::MIN_POSITIVE, 1e-45, 1e19, 0.0, -0.0].map(f32::to_bits);
    let (words, at) = (bytes.len() / 4, rng.below(bytes.len() / 4));
    let word = if rng.one_in(2) { strange[rng.below(8)] } else { rng.next_u64() as u32 >> rng.below(32) };
    if words > 0 {
        bytes[4 * at..4 * at + 4].copy_from_slice(&word.to_le_bytes());
    }
}
