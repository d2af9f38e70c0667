//! Cycles of dependencies: strongly connected components (Tarjan, *Depth-first search and linear graph
//! algorithms*, SIAM J. Comput. 1, 1972), here by the slower and shorter method of mutual reachability.

use std::collections::BTreeSet;

/// Groups of more than one node that reach each other, in the order of their first nodes.
pub(crate) fn find(to: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let reachable: Vec<BTreeSet<usize>> = (0..to.len()).map(|from| reachable(to, from)).collect();
    let both_ways = |a: usize, b: usize| reachable[a].contains(&b) && reachable[b].contains(&a);
    let group =
        |node: usize| -> Vec<usize> { (0..to.len()).filter(|other| both_ways(node, *other)).collect() };
    let groups: BTreeSet<_> = (0..to.len()).filter(|node| both_ways(*node, *node)).map(group).collect();
    groups.into_iter().collect()
}

/// Nodes reachable from a node over any number of dependencies.
fn reachable(to: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut left: Vec<usize> = to[from].iter().copied().collect();
    while let Some(node) = left.pop() {
        if found.insert(node) {
            left.extend(&to[node]);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_leads_back_is_a_circle() {
        let to = [vec![1], vec![2], vec![0, 3], vec![4], vec![], vec![6], vec![5]];
        let to: Vec<BTreeSet<usize>> = to.into_iter().map(BTreeSet::from_iter).collect();
        assert_eq!(find(&to), [vec![0, 1, 2], vec![5, 6]]);
    }
}
