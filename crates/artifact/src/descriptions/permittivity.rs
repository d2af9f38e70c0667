//! Permittivities of substances at 76–81 GHz from the literature: the single table that material maps use.
//!
//! Values have an uncertainty of ±10 % (batch, fillers, temperature, moisture, and extrapolation where the
//! source ends below 76 GHz): prefer a measured value in the map where there is one.

use num_complex::Complex64;

/// A substance of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Substance {
    /// Name of the substance in a material map.
    pub name: &'static str,
    /// Relative permittivity ε′ − jε″; `None` is a perfect conductor.
    pub permittivity: Option<Complex64>,
    /// Short description of the substance.
    pub meaning: &'static str,
    /// Source of the permittivity.
    pub source: &'static str,
}

/// Lowest and highest frequency for which the table's values are given, Hz.
pub const BAND_HZ: [f64; 2] = [76e9, 81e9];

/// All substances of the table, sorted by name.
pub const SUBSTANCES: [Substance; 17] = [
    dielectric("abs", [2.7, 0.03], "acrylonitrile-butadiene-styrene: grilles, mirror caps", RIDDLE),
    dielectric("acrylic", [2.56, 0.019], "PMMA: lamp covers", ZHEKOV),
    dielectric("asphalt", [9.5, 0.3], "dense road surface; ε′ 8.6–10.4 by recipe and moisture", ASPHALT),
    dielectric("clear-coat", [3.0, 0.1], "unpigmented paint", PAINT),
    dielectric("concrete", [5.24, 0.32], "σ = 0.0462·f^0.7822 S/m, f in GHz", ITU),
    dielectric(
        "fabric",
        [1.6, 0.05],
        "woven polyester, half of it air (mixing rule of its fibre, 2.8)",
        ESTIMATE,
    ),
    dielectric(
        "glass",
        [6.5, 0.15],
        "float glass; Zhekov's fit gives 6.29 − 0.43j, P.2040 6.31 − 0.28j",
        GLASS,
    ),
    dielectric("leather", [2.6, 0.25], "dry, and skin-like materials of protective clothes", ESTIMATE),
    conductor("metal", "steel, aluminium, chrome: |r| = 1 to 1e-3 (σ 10⁷ S/m)"),
    dielectric(
        "metallic-paint",
        [15.0, 1.5],
        "base coat with aluminium flakes; 5 to 40 by pigment content",
        PAINT,
    ),
    dielectric("polycarbonate", [2.76, 0.02], "lamp covers, roofs", RIDDLE),
    dielectric("polypropylene", [2.3, 0.01], "bumpers; filled grades up to 2.6", POLYPROPYLENE),
    dielectric("pvb", [2.7, 0.09], "film between the panes of a windscreen", ESTIMATE),
    dielectric("rubber", [4.0, 0.4], "tyres; carbon black raises both parts", RUBBER),
    dielectric("skin", [6.6, 8.9], "dry human skin at 77 GHz: hands, faces", GABRIEL),
    dielectric("water", [8.8, 15.9], "liquid, 20 °C at 77 GHz: wet surfaces", LIEBE),
    dielectric("wood", [1.99, 0.11], "dry; σ = 0.0047·f^1.0718 S/m, f in GHz", ITU),
];

const ITU: &str = "Recommendation ITU-R P.2040-3 (2023), table 3, 77 GHz";
const ZHEKOV: &str =
    "Zhekov, Franek, Pedersen, IEEE AP Magazine 62 (2020), 10.1109/MAP.2019.2955680, fit taken to 77 GHz";
const RIDDLE: &str = "Riddle, Baker-Jarvis, Krupka, IEEE T-MTT 51 (2003) 727, ε′ at 11 GHz; ε″ with a loss of some 0.01 at 77 GHz";
const GLASS: &str = "docs/physics.md §5; within 4 % in ε′ of both fits";
const POLYPROPYLENE: &str =
    "Riddle et al. 2003 (2.27, 11 GHz); Zhekov et al. 2020 (2.19 − 0.007j, 77 GHz); docs/physics.md §5";
const PAINT: &str =
    "Pfeiffer, Biebl, IEEE T-MTT 57 (2009) 2627, 76.5 GHz: order of magnitude of base and clear coats";
const RUBBER: &str = "docs/physics.md §5; neoprene of carbon filling 4.0 − 0.1j at 10 GHz (von Hippel 1954)";
const ASPHALT: &str = "docs/physics.md §5; samples: Kurz et al., Adv. Radio Sci. 19 (2021) 165, 77 GHz";
const GABRIEL: &str =
    "Gabriel, Lau, Gabriel, Phys. Med. Biol. 41 (1996) 2271, four Cole-Cole terms at 77 GHz";
const LIEBE: &str =
    "Liebe, Hufford, Manabe, Int. J. Infrared Millim. Waves 12 (1991) 659, double Debye at 77 GHz";
const ESTIMATE: &str =
    "no measurement at 77 GHz found; from the polymer's value below 40 GHz and the share of air";

/// Looks up a substance by name.
pub fn substance(name: &str) -> Option<&'static Substance> {
    SUBSTANCES.iter().find(|substance| substance.name == name)
}

const fn dielectric(
    name: &'static str,
    [re, loss]: [f64; 2],
    meaning: &'static str,
    source: &'static str,
) -> Substance {
    Substance { name, permittivity: Some(Complex64::new(re, -loss)), meaning, source }
}

const fn conductor(name: &'static str, meaning: &'static str) -> Substance {
    Substance {
        name,
        permittivity: None,
        meaning,
        source: "Jackson, Classical Electrodynamics, 8.1: 1 − |r|² = 4√(πε₀f/σ)",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_ascend_and_every_substance_loses_power() {
        assert!(SUBSTANCES.windows(2).all(|pair| pair[0].name < pair[1].name));
        for s in SUBSTANCES {
            assert!(s.permittivity.is_none_or(|e| e.re >= 1.0 && e.im < 0.0), "{}", s.name);
            assert_eq!(substance(s.name), Some(&s));
        }
    }
}
