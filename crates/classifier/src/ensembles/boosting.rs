//! Training of boosted trees: each is a step that reduces the log loss of four classes.
//!
//! Friedman, Greedy Function Approximation (Ann. Statist. 29 (2001) 1189), with second-order steps as in Chen
//! & Guestrin, XGBoost (arXiv:1603.02754), section 2.2: a leaf changes each logit by −G/(H + λ), where G and
//! H are the sums of the loss's first and second derivatives over its examples; the gain of a split is
//! ½Σ(G²/(H + λ)) over the classes. One tree changes all four logits. Columns are sorted once, and every
//! threshold between two different values is tried.

use crate::crops::classify::softmax;
use crate::ensembles::trees::leaf;
use artifact::model::{BoostedTrees, Node, Tree};
use artifact::seed;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Settings for growing trees.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct BoostingSettings {
    /// Largest number of trees.
    pub rounds: u32,
    /// Largest number of splits from the root to a leaf.
    pub depth: u32,
    /// Fraction of each step that is taken.
    pub learning_rate: f64,
    /// Regularization λ, added to the second derivatives in every leaf.
    pub shrinkage: f64,
    /// Least sum of the examples' weights on either side of a split.
    pub least_weight: f64,
    /// Share of the features available to a tree.
    pub columns: f64,
    /// Share of the examples for training a tree.
    pub rows: f64,
}

/// Training examples: features by column, classes, weights.
#[derive(Debug, Clone, Default)]
pub struct TrainingTable {
    /// Features by column, `[feature][example]`, all of one length.
    pub columns: Vec<Vec<f32>>,
    /// Index in [`artifact::settings::Class::ALL`].
    pub classes: Vec<usize>,
    /// Weight of each example in the loss.
    pub weights: Vec<f64>,
}

impl TrainingTable {
    /// Features of one example.
    pub fn row(&self, example: usize) -> Vec<f32> {
        self.columns.iter().map(|column| column[example]).collect()
    }

    /// Table of only the examples with these indices.
    pub fn subset(&self, examples: &[usize]) -> Self {
        Self {
            columns: self
                .columns
                .iter()
                .map(|column| examples.iter().map(|i| column[*i]).collect())
                .collect(),
            classes: examples.iter().map(|i| self.classes[*i]).collect(),
            weights: examples.iter().map(|i| self.weights[*i]).collect(),
        }
    }
}

/// First and second derivatives of the loss by the four logits.
type LossDerivatives = [[f64; 4]; 2];

/// Trains trees on a table; `progress` receives the trees so far after each round and stops training by
/// `false`.
///
/// The same table, settings and seed give the same trees on any number of threads.
pub fn boosted(
    table: &TrainingTable,
    settings: &BoostingSettings,
    seed: u64,
    progress: &mut dyn FnMut(&BoostedTrees) -> bool,
) -> BoostedTrees {
    let order: Vec<Vec<u32>> = table.columns.par_iter().map(|column| sorted(column)).collect();
    let mut trees = BoostedTrees { prior: [0.0; 4], temperature: 1.0, trees: vec![] };
    let mut logits = vec![[0.0_f64; 4]; table.classes.len()];
    for round in 0..settings.rounds {
        let mut random = ChaCha8Rng::from_seed(seed::key(seed, "classifier/boosting", &[u64::from(round)]));
        let slopes: Vec<LossDerivatives> = (0..logits.len()).map(|i| slopes(table, i, &logits[i])).collect();
        let rows: Vec<bool> = logits.iter().map(|_| random.random::<f64>() < settings.rows).collect();
        let columns: Vec<usize> =
            (0..order.len()).filter(|_| random.random::<f64>() < settings.columns).collect();
        let tree = TreeGrower { table, order: &order, slopes: &slopes, settings, columns }.tree(&rows);
        for (example, logits) in logits.iter_mut().enumerate() {
            let step = leaf(&tree, &table.row(example));
            logits.iter_mut().zip(step).for_each(|(logit, step)| *logit += f64::from(step));
        }
        trees.trees.push(tree);
        if !progress(&trees) {
            break;
        }
    }
    trees
}

/// Indices of the examples, sorted by value.
fn sorted(column: &[f32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..column.len() as u32).collect();
    order.sort_by(|a, b| column[*a as usize].total_cmp(&column[*b as usize]));
    order
}

/// Derivatives of the weighted log loss of the softmax: p − y and p(1 − p).
fn slopes(table: &TrainingTable, example: usize, logits: &[f64; 4]) -> LossDerivatives {
    let p = softmax(logits.map(|l| l as f32));
    let weight = table.weights[example];
    let is = |class: usize| f64::from(u8::from(table.classes[example] == class));
    [std::array::from_fn(|c| weight * (p[c] - is(c))), std::array::from_fn(|c| weight * p[c] * (1.0 - p[c]))]
}

/// Sums over the examples of a node.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    slopes: LossDerivatives,
    weight: f64,
}

impl Sums {
    fn add(&mut self, slopes: &LossDerivatives, weight: f64) {
        for (sum, slope) in self.slopes.iter_mut().flatten().zip(slopes.iter().flatten()) {
            *sum += slope;
        }
        self.weight += weight;
    }

    fn without(&self, part: &Self) -> Self {
        let difference =
            |order: usize| std::array::from_fn(|c| self.slopes[order][c] - part.slopes[order][c]);
        Self { slopes: [difference(0), difference(1)], weight: self.weight - part.weight }
    }

    /// Gain of the best step: the reduction of the loss by it, to second order.
    fn gain(&self, shrinkage: f64) -> f64 {
        let [first, second] = &self.slopes;
        first.iter().zip(second).map(|(g, h)| 0.5 * g * g / (h + shrinkage)).sum()
    }

    fn step(&self, settings: &BoostingSettings) -> [f32; 4] {
        let [first, second] = &self.slopes;
        std::array::from_fn(|c| {
            (-settings.learning_rate * first[c] / (second[c] + settings.shrinkage)) as f32
        })
    }
}

/// The best split of a node for one feature.
#[derive(Debug, Clone, Copy)]
struct Split {
    gain: f64,
    feature: usize,
    threshold: f32,
}

/// State of a growing tree.
struct TreeGrower<'a> {
    table: &'a TrainingTable,
    order: &'a [Vec<u32>],
    slopes: &'a [LossDerivatives],
    settings: &'a BoostingSettings,
    columns: Vec<usize>,
}

/// Node of an example that is in no open node.
const NOWHERE: usize = usize::MAX;

impl TreeGrower<'_> {
    /// Grows a tree level by level.
    fn tree(&self, rows: &[bool]) -> Tree {
        let mut place: Vec<usize> = rows.iter().map(|taken| if *taken { 0 } else { NOWHERE }).collect();
        let mut nodes = vec![Node::Leaf(self.sums(&place, 1)[0].step(self.settings))];
        // Open nodes of a level, by their indices among all nodes.
        let mut open = vec![0_usize];
        for _ in 0..self.settings.depth {
            let totals = self.sums(&place, open.len());
            let splits = self.splits(&place, &totals);
            let mut next = Vec::new();
            let mut children = vec![None; open.len()];
            for (number, split) in splits.iter().enumerate().filter_map(|(n, s)| Some((n, (*s)?))) {
                let [below, above] = [nodes.len(), nodes.len() + 1];
                nodes[open[number]] = Node::Split {
                    feature: split.feature as u32,
                    threshold: split.threshold,
                    below: below as u32,
                    above: above as u32,
                };
                nodes.extend([Node::Leaf([0.0; 4]); 2]);
                children[number] = Some((split, next.len()));
                next.extend([below, above]);
            }
            self.descend(&mut place, &children);
            for (sums, node) in self.sums(&place, next.len()).iter().zip(&next) {
                nodes[*node] = Node::Leaf(sums.step(self.settings));
            }
            open = next;
        }
        Tree { nodes }
    }

    /// Sums over the examples of each open node.
    fn sums(&self, place: &[usize], open: usize) -> Vec<Sums> {
        let mut sums = vec![Sums::default(); open];
        for (example, node) in place.iter().enumerate().filter(|(_, node)| **node != NOWHERE) {
            sums[*node].add(&self.slopes[example], self.table.weights[example]);
        }
        sums
    }

    /// Best split of each open node over all features, the first of equally good ones.
    fn splits(&self, place: &[usize], totals: &[Sums]) -> Vec<Option<Split>> {
        let of_columns: Vec<Vec<Option<Split>>> =
            self.columns.par_iter().map(|feature| self.splits_by(*feature, place, totals)).collect();
        let better = |best: Option<Split>, next: Option<Split>| match (best, next) {
            (Some(a), Some(b)) if b.gain > a.gain => Some(b),
            (None, next) => next,
            (best, _) => best,
        };
        (0..totals.len())
            .map(|node| of_columns.iter().map(|splits| splits[node]).fold(None, better))
            .collect()
    }

    fn splits_by(&self, feature: usize, place: &[usize], totals: &[Sums]) -> Vec<Option<Split>> {
        let column = &self.table.columns[feature];
        let mut below = vec![(Sums::default(), f32::NAN); totals.len()];
        let mut best: Vec<Option<Split>> = vec![None; totals.len()];
        for example in self.order[feature].iter().map(|i| *i as usize).filter(|i| place[*i] != NOWHERE) {
            let (node, value) = (place[example], column[example]);
            let (sums, last) = &mut below[node];
            if sums.weight > 0.0 && value > *last {
                let split = self.split(sums, &totals[node], feature, [*last, value]);
                best[node] = match (best[node], split) {
                    (Some(known), Some(new)) if new.gain <= known.gain => Some(known),
                    (known, new) => new.or(known),
                };
            }
            sums.add(&self.slopes[example], self.table.weights[example]);
            *last = value;
        }
        best
    }

    /// Split between two values, if both sides have enough weight and the loss decreases.
    fn split(&self, below: &Sums, total: &Sums, feature: usize, [low, high]: [f32; 2]) -> Option<Split> {
        let above = total.without(below);
        let least = self.settings.least_weight;
        let shrinkage = self.settings.shrinkage;
        let gain = below.gain(shrinkage) + above.gain(shrinkage) - total.gain(shrinkage);
        let is_heavy = below.weight >= least && above.weight >= least;
        let middle = low + 0.5 * (high - low);
        (is_heavy && gain > 1e-9).then_some(Split {
            gain,
            feature,
            threshold: if middle < high { middle } else { low },
        })
    }

    /// Moves examples to the children of their nodes; those in a leaf are done.
    fn descend(&self, place: &mut [usize], children: &[Option<(Split, usize)>]) {
        for (example, node) in place.iter_mut().enumerate().filter(|(_, node)| **node != NOWHERE) {
            *node = children[*node].map_or(NOWHERE, |(split, first)| {
                first + usize::from(self.table.columns[split.feature][example] > split.threshold)
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensembles::trees::logits;
    use crate::evaluation::metrics::log_softmax;

    const SETTINGS: BoostingSettings = BoostingSettings {
        rounds: 40,
        depth: 3,
        learning_rate: 0.3,
        shrinkage: 1.0,
        least_weight: 1.0,
        columns: 1.0,
        rows: 1.0,
    };

    /// Classes that two of three features tell together and neither alone; some values are equal.
    fn table(examples: u64, seed: u64) -> TrainingTable {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut drawn =
            || (0..examples).map(|_| (20.0 * random.random::<f32>()).round()).collect::<Vec<f32>>();
        let columns = vec![drawn(), drawn(), drawn()];
        let of = |i: usize| 2 * usize::from(columns[0][i] > 10.0) + usize::from(columns[2][i] > 7.0);
        let class = |i: usize| if of(i) == 3 { 0 } else { of(i) + usize::from(of(i) == 0) * 3 };
        let classes = (0..examples as usize).map(class).collect();
        let weights = (0..examples).map(|i| 0.5 + (i % 3) as f64).collect();
        TrainingTable { columns, classes, weights }
    }

    fn loss(table: &TrainingTable, trees: &BoostedTrees) -> f64 {
        let one = |i: usize| {
            -table.weights[i] * log_softmax(logits(trees, &table.row(i)).map(f64::from))[table.classes[i]]
        };
        (0..table.classes.len()).map(one).sum()
    }

    /// The slow and obvious way: every threshold of every feature, all sums anew.
    #[test]
    fn the_first_split_is_the_best_of_all_that_there_are() {
        for seed in 0..20 {
            let table = table(60, seed);
            let settings = BoostingSettings { rounds: 1, depth: 1, ..SETTINGS };
            let tree = &boosted(&table, &settings, 1, &mut |_| true).trees[0];
            let gain = |feature: usize, threshold: f32| {
                let side = |above: bool| {
                    let mut sums = Sums::default();
                    for i in (0..60).filter(|i| (table.columns[feature][*i] > threshold) == above) {
                        sums.add(&slopes(&table, i, &[0.0; 4]), table.weights[i]);
                    }
                    sums
                };
                let heavy = [false, true].iter().all(|above| side(*above).weight >= 1.0);
                if heavy { side(false).gain(1.0) + side(true).gain(1.0) } else { f64::NEG_INFINITY }
            };
            let all = (0..3).flat_map(|f| (0..20).map(move |t| (f, t as f32 + 0.5)));
            let best = all.map(|(f, t)| gain(f, t)).fold(f64::NEG_INFINITY, f64::max);
            let Node::Split { feature, threshold, .. } = tree.nodes[0] else { panic!("no split") };
            assert!((gain(feature as usize, threshold) - best).abs() < 1e-9 * best.abs(), "seed {seed}");
        }
    }

    #[test]
    fn the_loss_falls_with_every_tree_and_unseen_examples_are_told() {
        let (learned, unseen) = (table(400, 1), table(400, 2));
        let mut losses = Vec::new();
        let trees = boosted(&learned, &SETTINGS, 1, &mut |trees| {
            losses.push(loss(&learned, trees));
            true
        });
        assert!(losses.windows(2).all(|pair| pair[1] < pair[0]), "{losses:?}");
        let told = |i: usize| {
            let l = logits(&trees, &unseen.row(i));
            (0..4).fold(0, |best, c| if l[c] > l[best] { c } else { best })
        };
        let right = (0..400).filter(|i| told(*i) == unseen.classes[*i]).count();
        assert!(right >= 392, "{right} of 400");
    }

    #[test]
    fn trees_are_the_same_on_any_number_of_threads_and_others_by_another_seed() {
        let table = table(200, 3);
        let settings = BoostingSettings { columns: 0.7, rows: 0.7, ..SETTINGS };
        let grown = |threads: usize, seed: u64| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| boosted(&table, &settings, seed, &mut |_| true))
        };
        assert!(grown(1, 1) == grown(3, 1) && grown(1, 1) != grown(1, 2));
    }

    #[test]
    fn a_table_whose_features_say_nothing_grows_no_split() {
        let table = TrainingTable {
            columns: vec![vec![1.0; 10]],
            classes: vec![0, 1, 2, 3, 0, 1, 2, 3, 0, 1],
            weights: vec![1.0; 10],
        };
        let trees = boosted(&table, &SETTINGS, 1, &mut |trees| trees.trees.len() < 3);
        assert_eq!(trees.trees.len(), 3);
        assert!(trees.trees.iter().all(|tree| tree.nodes.len() == 1));
    }
}
