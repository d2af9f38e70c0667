//! Evidence that one design is better than another, for bounded values: a gambler's capital.

/// Fractions of the capital that are bet, from all of it down.
const BETS: [f64; 7] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625];

/// Capital that starts at 1 and is bet, value by value, on a mean above zero: the mean over fixed bets λ of Π
/// (1 + λ v), with values v from −1 to 1. If the conditional mean of the values is zero or less, whatever
/// their distribution, the capital reaches w with a probability of at most 1/w, however often it is checked
/// (Ville's inequality; Waudby-Smith and Ramdas, J. R. Stat. Soc. B 86 (2024) 1). Averages of such capitals
/// have the same property.
pub(crate) fn capital(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let of_bet = |bet: &f64| values.clone().map(|v| (bet * v.clamp(-1.0, 1.0)).ln_1p()).sum::<f64>().exp();
    BETS.iter().map(of_bet).sum::<f64>() / BETS.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn the_capital_is_that_of_the_closed_form() {
        let by_hand = |values: &[f64]| {
            let product = |bet: f64| values.iter().map(|v| 1.0 + bet * v).product::<f64>();
            (0..7).map(|k| product(0.5_f64.powi(k))).sum::<f64>() / 7.0
        };
        for values in [&[][..], &[0.25, -0.5, 1.0], &[-1.0, 1.0, 1.0], &[1.0; 12]] {
            let made = capital(values.iter().copied());
            assert!((made / by_hand(values) - 1.0).abs() < 1e-12, "{values:?}: {made}");
        }
        assert_eq!(capital([1.0; 2000].into_iter()), f64::INFINITY);
    }

    /// Values that are a little above zero nearly always and −1 now and then, zero on average.
    #[test]
    fn a_fair_game_makes_rich_no_more_often_than_it_may() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let mut most = || {
            let values = [(); 200].map(|()| if random.random::<f64>() < 0.05 { -1.0 } else { 0.05 / 0.95 });
            (1..=200).map(|n| capital(values[..n].iter().copied())).fold(0.0, f64::max)
        };
        let most: Vec<f64> = (0..400).map(|_| most()).collect();
        for [w, allowed] in [[5.0, 80.0], [20.0, 20.0], [100.0, 4.0]] {
            let rich = most.iter().filter(|most| **most >= w).count() as f64;
            assert!(rich <= allowed, "{rich} of 400 reach {w}");
        }
    }
}
