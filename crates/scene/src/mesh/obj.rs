//! Wavefront OBJ: polygons with materials by name, in metres and body axes. Curves, points and lines are
//! ignored.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use crate::mesh::part::{Part, check_count, check_vectors};
use crate::mesh::polygon::triangulate;
use crate::wording::excerpt::excerpt;
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// Keywords that change no polygon (Wavefront's Appendix B1); unlisted ones are refused, not guessed.
const IGNORED: [&str; 10] = ["vt", "vp", "g", "o", "s", "mg", "l", "p", "mtllib", "usemap"];

/// Largest polygon: ear cutting takes the square of its corners, the cube if it is very concave.
const CORNER_LIMIT: usize = 4096;

/// Largest number of comparisons, half a minute; a polygon of some corners takes a few.
const COMPARISON_LIMIT: u64 = 1 << 33;

/// A corner: its vertex and, where given, its normal; from 0.
type Corner = (u32, Option<u32>);

#[derive(Default)]
struct Document {
    vertices: Vectors,
    normals: Vectors,
    /// Groups by material and by whether the corners have normals; materials in the order of their first use.
    groups: Vec<Group>,
    /// Indices of the groups.
    known: HashMap<(Rc<str>, Normals), usize>,
    triangles: usize,
    /// Comparisons made in cutting polygons.
    comparisons: u64,
}

/// Vectors in the order of their lines.
#[derive(Default)]
struct Vectors {
    values: Vec<DVec3>,
    /// Lines of those that are not finite, by index: refused only where a face has them.
    lines_of_not_finite: HashMap<u32, u64>,
}

struct Group {
    material: Rc<str>,
    normals: Normals,
    triangles: Vec<[Corner; 3]>,
}

/// Whether all corners of a face have normals; normals of only some are ignored.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Normals {
    Given,
    Absent,
}

pub(crate) fn read_obj(bytes: &[u8]) -> Result<Vec<Part>, LocatedFault> {
    let text = std::str::from_utf8(bytes).map_err(|_| MeshPlace::File.fault(MeshFault::NotText))?;
    let mut document = Document::default();
    let mut material = Rc::default();
    for (line, number) in logical_lines(text) {
        let read = document.read_line(&line, number, &mut material);
        read.map_err(|fault| MeshPlace::Line(number).fault(fault))?;
        check_count(document.triangles)?;
    }
    document.into_parts()
}

/// Lines with their numbers; a backslash at the end continues a line in the next.
fn logical_lines(text: &str) -> impl Iterator<Item = (std::borrow::Cow<'_, str>, u64)> {
    let mut lines = text.lines().zip(1_u64..);
    std::iter::from_fn(move || {
        let (first, number) = lines.next()?;
        let mut line = std::borrow::Cow::Borrowed(first);
        while line.ends_with('\\') {
            let (open, next) = (line.to_mut(), lines.next().map_or("", |(next, _)| next));
            open.pop();
            open.push(' ');
            open.push_str(next);
        }
        Some((line, number))
    })
}

/// A line up to its comment, which begins at its start or after white space: names may contain `#`.
fn without_comment(line: &str) -> &str {
    let begins = |(at, _): &(usize, &str)| line[..*at].ends_with(|before: char| before.is_ascii_whitespace());
    let comment = line.match_indices('#').find(|found| found.0 == 0 || begins(found));
    comment.map_or(line, |(at, _)| &line[..at])
}

impl Document {
    fn read_line(&mut self, line: &str, number: u64, material: &mut Rc<str>) -> Result<(), MeshFault> {
        let content = without_comment(line);
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            None => {}
            Some("v") => self.vertices.push(three_numbers(words)?, number),
            Some("vn") => self.normals.push(three_numbers(words)?, number),
            Some("f") => self.read_face(words, material)?,
            Some("usemtl") => {
                *material = content.trim().strip_prefix("usemtl").unwrap_or_default().trim().into()
            }
            Some(word) if IGNORED.contains(&word) => {}
            Some(other) => {
                let expected = "a polygonal OBJ statement (v, vn, vt, f, usemtl, g, o, s, mtllib, l, p)";
                return Err(MeshFault::Expected { expected, found: excerpt(other) });
            }
        }
        check_vectors(self.vertices.values.len() + self.normals.values.len())
    }

    fn read_face<'w>(
        &mut self,
        words: impl Iterator<Item = &'w str> + Clone,
        material: &Rc<str>,
    ) -> Result<(), MeshFault> {
        let corners = words.clone().count();
        if corners < 3 {
            return Err(MeshFault::Corners(corners));
        }
        if corners > CORNER_LIMIT {
            return Err(MeshFault::TooManyCorners { corners, limit: CORNER_LIMIT });
        }
        let corners: Vec<Corner> = words.map(|word| self.corner(word)).collect::<Result<_, _>>()?;
        let given = corners.iter().all(|(_, normal)| normal.is_some());
        let normals = if given { Normals::Given } else { Normals::Absent };
        let points: Vec<DVec3> =
            corners.iter().map(|(vertex, _)| self.vertices.values[*vertex as usize]).collect();
        let triangles = triangulate(&points, &mut self.comparisons);
        if self.comparisons > COMPARISON_LIMIT {
            return Err(MeshFault::TooDented { limit: COMPARISON_LIMIT });
        }
        self.triangles += triangles.len();
        let triangles = triangles.into_iter().map(|ears| ears.map(|i| corners[i]));
        self.group(material, normals).triangles.extend(triangles);
        Ok(())
    }

    fn group(&mut self, material: &Rc<str>, normals: Normals) -> &mut Group {
        let index = *self.known.entry((material.clone(), normals)).or_insert_with(|| {
            self.groups.push(Group { material: material.clone(), normals, triangles: vec![] });
            self.groups.len() - 1
        });
        &mut self.groups[index]
    }

    /// Corner written as `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, word: &str) -> Result<Corner, MeshFault> {
        let mut fields = word.split('/');
        let vertex = index(fields.next().unwrap_or_default(), self.vertices.values.len())?;
        let normal = fields.nth(1).map(|field| index(field, self.normals.values.len())).transpose()?;
        Ok((vertex, normal))
    }

    fn into_parts(self) -> Result<Vec<Part>, LocatedFault> {
        let Self { vertices, normals, groups, .. } = self;
        let part = |group| into_part(group, &vertices, &normals);
        groups.into_iter().map(part).collect()
    }
}

impl Vectors {
    fn push(&mut self, value: DVec3, line: u64) {
        if !value.is_finite() {
            self.lines_of_not_finite.insert(self.values.len() as u32, line);
        }
        self.values.push(value);
    }

    /// Refuses a vector that is not finite, with its line and its number, which counts from 1.
    fn check_finite(&self, index: u32, rule: fn(usize) -> MeshFault) -> Result<(), LocatedFault> {
        let line = self.lines_of_not_finite.get(&index);
        line.map_or(Ok(()), |line| Err(MeshPlace::Line(*line).fault(rule(index as usize + 1))))
    }
}

/// Turns a group into a part: corners with the same vertex and normal become one vertex; nothing else is
/// joined.
fn into_part(group: Group, vertices: &Vectors, normals: &Vectors) -> Result<Part, LocatedFault> {
    let given = group.normals == Normals::Given;
    let key = |(vertex, normal): Corner| (vertex, normal.filter(|_| given));
    let mut numbers: BTreeMap<Corner, u32> =
        group.triangles.iter().flatten().map(|corner| (key(*corner), 0)).collect();
    numbers.values_mut().zip(0..).for_each(|(number, next)| *number = next);
    for (vertex, normal) in numbers.keys() {
        vertices.check_finite(*vertex, MeshFault::Vertex)?;
        normal.map_or(Ok(()), |normal| normals.check_finite(normal, MeshFault::Normal))?;
    }
    let positions: Vec<DVec3> = numbers.keys().map(|(vertex, _)| vertices.values[*vertex as usize]).collect();
    let of_corners: Vec<DVec3> =
        numbers.keys().filter_map(|(_, normal)| Some(normals.values[(*normal)? as usize])).collect();
    let triangles =
        group.triangles.iter().map(|corners| corners.map(|corner| numbers[&key(corner)])).collect();
    let of_corners = given.then_some(of_corners.as_slice());
    Part::new(MeshPlace::File, &positions, of_corners, triangles, group.material)
}

/// Converts an index that counts from 1, or negative from the last item so far, to one from 0.
fn index(field: &str, count: usize) -> Result<u32, MeshFault> {
    let written: i64 =
        field.parse().map_err(|_| MeshFault::Expected { expected: "an index", found: excerpt(field) })?;
    let from_zero = if written < 0 { written.saturating_add(count as i64) } else { written - 1 };
    let in_range = u32::try_from(from_zero).ok().filter(|&index| (index as usize) < count);
    in_range.ok_or(MeshFault::VertexIndex { index: written, vertices: count })
}

/// The first three numbers; a fourth, a weight or a colour, is ignored.
pub(crate) fn three_numbers<'w>(words: impl Iterator<Item = &'w str>) -> Result<DVec3, MeshFault> {
    let mut numbers = [0.0; 3];
    let mut words = words;
    for number in &mut numbers {
        let word = words.next().unwrap_or_default();
        *number =
            word.parse().map_err(|_| MeshFault::Expected { expected: "a number", found: excerpt(word) })?;
    }
    Ok(DVec3::from(numbers))
}
