//! Inference with boosted decision trees: every tree adds the values of its leaf to the four logits.

use crate::crops::network::Logits;
use crate::error::ClassifierError;
use artifact::model::{BoostedTrees, Node, Tree};

/// Largest depth of a tree, in nodes.
const DEEPEST: usize = 64;

/// The logits for features in the order of the model's names; `NaN` counts as below every threshold.
pub fn logits(trees: &BoostedTrees, features: &[f32]) -> Logits {
    let mut sum = trees.prior.map(f64::from);
    for tree in &trees.trees {
        let leaf = leaf(tree, features);
        sum.iter_mut().zip(leaf).for_each(|(sum, value)| *sum += f64::from(value));
    }
    sum.map(|logit| (logit / f64::from(trees.temperature)) as f32)
}

/// Leaf of a tree for these features.
pub(crate) fn leaf(tree: &Tree, features: &[f32]) -> Logits {
    let mut at = 0;
    loop {
        match tree.nodes[at] {
            Node::Leaf(values) => return values,
            Node::Split { feature, threshold, below, above } => {
                at = if features[feature as usize] > threshold { above } else { below } as usize;
            }
        }
    }
}

/// Checks that every path through every tree ends in a leaf of finite numbers and uses existing features.
pub(crate) fn check(trees: &BoostedTrees, features: usize) -> Result<(), ClassifierError> {
    let prior_is_finite = trees.prior.iter().all(|v| v.is_finite());
    if !(prior_is_finite && trees.temperature.is_finite() && trees.temperature > 0.0) {
        return Err(ClassifierError::Tree { tree: 0, rule: "a prior and a temperature that are numbers" });
    }
    trees.trees.iter().enumerate().try_for_each(|(number, tree)| {
        check_tree(tree, features).map_err(|rule| ClassifierError::Tree { tree: number, rule })
    })
}

/// Children come after their parents, so there are no cycles.
fn check_tree(tree: &Tree, features: usize) -> Result<(), &'static str> {
    if tree.nodes.is_empty() {
        return Err("at least one node");
    }
    let mut depth = vec![0; tree.nodes.len()];
    for (at, node) in tree.nodes.iter().enumerate() {
        match *node {
            Node::Leaf(values) if values.iter().all(|v| v.is_finite()) => {}
            Node::Leaf(_) => return Err("leaves of finite numbers"),
            Node::Split { feature, threshold, below, above } => {
                if feature as usize >= features || threshold.is_nan() {
                    return Err("splits of features that the model names");
                }
                for child in [below, above].map(|child| child as usize) {
                    if child <= at || child >= tree.nodes.len() || depth[at] >= DEEPEST {
                        return Err("children behind their parents, at most 64 deep");
                    }
                    depth[child] = depth[at] + 1;
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stump(below: u32, above: u32, feature: u32, high: f32) -> BoostedTrees {
        let split = Node::Split { feature, threshold: 1.0, below, above };
        let nodes = vec![split, Node::Leaf([0.0, 1.0, 0.0, 0.0]), Node::Leaf([high, 0.0, 0.0, 0.0])];
        BoostedTrees { prior: [0.5, 0.0, 0.0, 0.0], temperature: 2.0, trees: vec![Tree { nodes }] }
    }

    #[test]
    fn a_stump_answers_by_hand() {
        let trees = stump(1, 2, 0, 4.0);
        assert!(check(&trees, 1).is_ok());
        assert_eq!(logits(&trees, &[1.0]), [0.25, 0.5, 0.0, 0.0]);
        assert_eq!(logits(&trees, &[1.1]), [2.25, 0.0, 0.0, 0.0]);
        assert_eq!(logits(&trees, &[f32::NAN]), [0.25, 0.5, 0.0, 0.0]);
    }

    #[test]
    fn trees_that_lead_nowhere_are_refused() {
        let broken =
            [stump(0, 2, 0, 1.0), stump(1, 3, 0, 1.0), stump(1, 2, 1, 1.0), stump(1, 2, 0, f32::NAN)];
        for trees in broken {
            assert!(matches!(check(&trees, 1), Err(ClassifierError::Tree { tree: 0, .. })));
        }
        let empty = BoostedTrees { trees: vec![Tree { nodes: vec![] }], ..stump(1, 2, 0, 1.0) };
        assert!(check(&empty, 1).is_err());
        assert!(check(&BoostedTrees { temperature: 0.0, ..stump(1, 2, 0, 1.0) }, 1).is_err());
    }
}
