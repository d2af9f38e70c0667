//! Writes the project's own traffic, a minute of a junction with a light, in the form of SUMO's floating-car
//! data:
//!
//! ```text
//! cargo run --release -p scene --example junction -- --seed 1 --out fixtures/junction.fcd.xml.gz
//! ```

mod driving;

use flate2::{Compression, GzBuilder};
use std::io::Write;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut seed, mut out) = (1, PathBuf::from("fixtures/junction.fcd.xml.gz"));
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let value = words.next().ok_or_else(|| format!("{word} needs a value"))?;
        match word.as_str() {
            "--seed" => seed = value.parse()?,
            "--out" => out = value.into(),
            _ => return Err(format!("unknown option {word}; there are --seed N and --out FILE").into()),
        }
    }
    let file = std::fs::File::create(&out)?;
    let mut packer = GzBuilder::new().write(file, Compression::best());
    packer.write_all(driving::floating_car_data(seed).as_bytes())?;
    packer.finish()?;
    Ok(())
}
