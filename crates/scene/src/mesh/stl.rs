//! Stereolithography (3D Systems, 1989): binary and text, in metres and body axes. The stored facet normals
//! repeat the winding and are ignored.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use crate::mesh::obj::three_numbers;
use crate::mesh::part::{Part, check_count};
use crate::wording::excerpt::excerpt;
use glam::DVec3;
use std::rc::Rc;

const HEADER_BYTES: usize = 84;
const FACET_BYTES: usize = 50;

pub(crate) fn read_stl(bytes: &[u8]) -> Result<Vec<Part>, LocatedFault> {
    let corners = if is_text(bytes) { read_text(bytes)? } else { read_binary(bytes)? };
    // Facets first: a vertex that is not finite is reported by its facet.
    if let Some(i) = corners.iter().position(|corner| !corner.is_finite()) {
        return Err(MeshPlace::Facet(i as u64 / 3 + 1).fault(MeshFault::Vertex(i % 3)));
    }
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Ok(vec![Part::new(MeshPlace::File, &corners, None, triangles, Rc::default())?])
}

/// Whether the file is text: binary files may begin with `solid` too, and differ by their length.
fn is_text(bytes: &[u8]) -> bool {
    let begins = |word: &[u8]| word.eq_ignore_ascii_case(b"solid");
    bytes.trim_ascii_start().get(..5).is_some_and(begins) && bytes.len() as u64 != binary_bytes(bytes)
}

/// Bytes that the header of a binary file claims.
fn binary_bytes(bytes: &[u8]) -> u64 {
    let count = bytes
        .get(80..HEADER_BYTES)
        .map_or(0, |count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    HEADER_BYTES as u64 + FACET_BYTES as u64 * u64::from(count)
}

fn read_binary(bytes: &[u8]) -> Result<Vec<DVec3>, LocatedFault> {
    let (found, needed) = (bytes.len() as u64, binary_bytes(bytes));
    if found < needed {
        return Err(MeshPlace::File.fault(MeshFault::CutOff { found, needed }));
    }
    if found > needed {
        let facets = |bytes: u64| (bytes - HEADER_BYTES as u64) / FACET_BYTES as u64;
        let [said, there] = [needed, found].map(facets);
        return Err(MeshPlace::File.fault(MeshFault::TooLong { said, needed, there, found }));
    }
    check_count((needed as usize - HEADER_BYTES) / FACET_BYTES)?;
    let facets = bytes[HEADER_BYTES..needed as usize].chunks_exact(FACET_BYTES);
    Ok(facets.flat_map(|facet| facet[12..48].chunks_exact(12).map(vector)).collect())
}

fn vector(bytes: &[u8]) -> DVec3 {
    let number =
        |i: usize| f64::from(f32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]));
    DVec3::new(number(0), number(4), number(8))
}

fn read_text(bytes: &[u8]) -> Result<Vec<DVec3>, LocatedFault> {
    let text = std::str::from_utf8(bytes).map_err(|_| MeshPlace::File.fault(MeshFault::NotText))?;
    let mut corners = vec![];
    let (mut is_within, mut in_facet) = (true, 0);
    for (line, number) in text.lines().zip(1_u64..) {
        let place = MeshPlace::Line(number);
        let mut words = line.split_ascii_whitespace();
        let word = words.next().map(str::to_ascii_lowercase);
        is_within = word.as_ref().map_or(is_within, |word| word != "endsolid");
        match word.as_deref() {
            Some("vertex") => {
                check_count(corners.len() / 3)?;
                corners.push(three_numbers(words).map_err(|fault| place.fault(fault))?);
                in_facet += 1;
            }
            Some("endfacet") if in_facet != 3 => return Err(place.fault(MeshFault::FacetCorners(in_facet))),
            Some("endfacet") => in_facet = 0,
            None | Some("solid" | "facet" | "outer" | "endloop" | "endsolid") => {}
            Some(other) => {
                let expected = "a line of STL (solid, facet, outer, vertex, endloop, endfacet, endsolid)";
                return Err(place.fault(MeshFault::Expected { expected, found: excerpt(other) }));
            }
        }
    }
    match corners.len() % 3 {
        0 if is_within => Err(MeshPlace::File.fault(MeshFault::Unfinished)),
        0 => Ok(corners),
        left_over => Err(MeshPlace::File.fault(MeshFault::Corners(left_over))),
    }
}
