//! Names of tensors in the weights.

/// Of the fully connected layer, `[in, out]`.
pub const LINEAR_WEIGHT: &str = "linear.weight";
/// `[out]`.
pub const LINEAR_BIAS: &str = "linear.bias";

/// `[out, in, row, column]`, of a block from 0.
pub fn convolution(block: usize) -> String {
    format!("blocks.{block}.convolution.weight")
}

/// γ of a block's batch normalization.
pub fn scale(block: usize) -> String {
    format!("blocks.{block}.normalization.scale")
}

/// β.
pub fn offset(block: usize) -> String {
    format!("blocks.{block}.normalization.offset")
}

/// Of the training crops, as it ran.
pub fn mean(block: usize) -> String {
    format!("blocks.{block}.normalization.running_mean")
}

/// Likewise.
pub fn variance(block: usize) -> String {
    format!("blocks.{block}.normalization.running_variance")
}
