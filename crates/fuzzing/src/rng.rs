//! Deterministic random numbers, and the numbers and words at which readers stumble.

/// SplitMix64 (Steele et al. 2014): the same cases on every machine.
pub struct FuzzRng(u64);

/// Ends of ranges, of types and of what f64 holds; words that some readers take for numbers.
const NUMBERS: [&str; 48] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "3",
    "7",
    "8",
    "9",
    "64",
    "65",
    "100",
    "127",
    "128",
    "255",
    "256",
    "340",
    "341",
    "65535",
    "65536",
    "65537",
    "100000",
    "100001",
    "1000000",
    "1000001",
    "2147483648",
    "-2147483649",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "1e-9",
    "0.1",
    "1e5",
    "1e10",
    "1e38",
    "1e39",
    "1e154",
    "1e308",
    "-1e308",
    "1e309",
    "5e-324",
    "1e-310",
    "nan",
    "-inf",
];

impl FuzzRng {
    /// Random numbers of one case; neighbouring seeds have nothing in common.
    pub fn new(seed: u64, case: u64) -> Self {
        let mut rng = Self(seed);
        rng.0 = rng.next_u64() ^ case.wrapping_mul(0xd1b5_4a32_d192_ed03);
        rng.next_u64();
        rng
    }

    /// Random number of 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Random whole number from 0, below `end`; 0 where there is nothing below it.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next_u64() % end.max(1) as u64) as usize
    }

    /// Whether it happens that happens once in so many times.
    pub fn one_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// One of these.
    pub fn choose<'a, T: ?Sized>(&mut self, of: &[&'a T]) -> &'a T {
        of[self.below(of.len())]
    }

    /// Random number from 0 up to, not including, 1.
    pub fn unit_f64(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number as it is written: one of those above, or any of any size and sign.
    pub fn number_text(&mut self) -> String {
        match self.below(4) {
            0 => format!("{:e}", f64::from_bits(self.next_u64())).replace("NaN", "nan"),
            1 => format!("{:.3}", (self.unit_f64() - 0.5) * 10_f64.powi(self.below(12) as i32 - 4)),
            _ => self.choose(&NUMBERS).to_owned(),
        }
    }

    /// A size between one and many, small ones more often.
    pub fn repeat_count(&mut self) -> usize {
        1 << self.below(13)
    }

    /// Bytes that are no text, or change what a terminal shows.
    pub fn stray_bytes(&mut self) -> &'static [u8] {
        const STRAY: [&[u8]; 8] = [
            b"\xff",
            b"\xc3",
            b"\0",
            b"\xef\xbb\xbf",
            b"\x1b[2J",
            b"\xed\xa0\x80",
            b"\r",
            "\u{202e}\u{2028}".as_bytes(),
        ];
        self.choose(&STRAY)
    }
}
