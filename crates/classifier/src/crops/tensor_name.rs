//! Names of tensors in the weights.

/// Weights of the fully connected layer, `[in, out]`.
pub const LINEAR_WEIGHT: &str = "linear.weight";
/// Bias of the fully connected layer, `[out]`.
pub const LINEAR_BIAS: &str = "linear.bias";

/// Weights of the convolution of a block (from 0), `[out, in, row, column]`.
pub fn convolution(block: usize) -> String {
    format!("blocks.{block}.convolution.weight")
}

/// Scale γ of a block's batch normalization.
pub fn scale(block: usize) -> String {
    format!("blocks.{block}.normalization.scale")
}

/// Offset β of a block's batch normalization.
pub fn offset(block: usize) -> String {
    format!("blocks.{block}.normalization.offset")
}

/// Running mean of a block's batch normalization over the training crops.
pub fn mean(block: usize) -> String {
    format!("blocks.{block}.normalization.running_mean")
}

/// Running variance of a block's batch normalization over the training crops.
pub fn variance(block: usize) -> String {
    format!("blocks.{block}.normalization.running_variance")
}
