//! Accessors of glTF: every view, stride, count and index is checked before a byte is read.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use crate::mesh::gltf_buffers::Buffers;
use crate::mesh::part::{CORNER_LIMIT, check_vectors, too_many_triangles};
use glam::DVec3;
use gltf::json::accessor::{
    Accessor, ComponentType, GenericComponentType, IndexComponentType, Type, sparse::Sparse,
};
use gltf::json::validation::Checked;
use gltf::json::{Index, Root, buffer};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Largest number of vertices in a sparse accessor without a view: more would take memory that is not backed
/// by bytes.
const SPARSE_LIMIT: u64 = 1 << 20;

/// The accessors of one document; vectors that several primitives share are decoded once.
pub(crate) struct Accessors<'d> {
    root: &'d Root,
    buffers: &'d Buffers,
    vectors: BTreeMap<usize, Rc<Vec<DVec3>>>,
    /// Number of cached vectors.
    held: usize,
}

/// `count` elements in a slice, `stride` apart, all inside it.
struct Elements<'d> {
    bytes: &'d [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'d> Elements<'d> {
    fn iter(&self) -> impl Iterator<Item = &'d [u8]> + use<'d> {
        let (bytes, stride, size) = (self.bytes, self.stride, self.size);
        (0..self.count).map(move |i| &bytes[i * stride..i * stride + size])
    }
}

impl<'d> Accessors<'d> {
    pub(crate) fn new(root: &'d Root, buffers: &'d Buffers) -> Self {
        Self { root, buffers, vectors: BTreeMap::new(), held: 0 }
    }

    /// Positions or normals.
    pub(crate) fn vectors(&mut self, user: MeshPlace, index: usize) -> Result<Rc<Vec<DVec3>>, LocatedFault> {
        if let Some(known) = self.vectors.get(&index) {
            return Ok(known.clone());
        }
        let accessor = self.accessor(user, index)?;
        let place = MeshPlace::Accessor(index);
        let encoding = self.encoding(accessor).map_err(|fault| place.fault(fault))?;
        let base = self.base(place, accessor, encoding.vector_bytes())?;
        self.held = self.held.saturating_add(usize::try_from(accessor.count.0).unwrap_or(usize::MAX));
        check_vectors(self.held).map_err(|fault| MeshPlace::File.fault(fault))?;
        let mut vectors: Vec<DVec3> = match base {
            Some(elements) => elements.iter().map(|bytes| encoding.vector(bytes)).collect(),
            None => vec![DVec3::ZERO; accessor.count.0 as usize],
        };
        if let Some(sparse) = &accessor.sparse {
            let decode = |bytes: &[u8]| encoding.vector(bytes);
            self.replace_sparse(place, sparse, encoding.vector_bytes(), decode, &mut vectors)?;
        }
        let vectors = Rc::new(vectors);
        self.vectors.insert(index, vectors.clone());
        Ok(vectors)
    }

    /// Replaces some items by the sparse values, of `size` bytes each.
    fn replace_sparse<T>(
        &self,
        place: MeshPlace,
        sparse: &Sparse,
        size: u64,
        decode: impl Fn(&[u8]) -> T,
        items: &mut [T],
    ) -> Result<(), LocatedFault> {
        let (values, count) = (&sparse.values, sparse.count.0);
        let values = self.elements(place, values.buffer_view, values.byte_offset.0, count, size)?;
        for (i, bytes) in self.sparse_indices(place, sparse, items.len())?.into_iter().zip(values.iter()) {
            items[i] = decode(bytes);
        }
        Ok(())
    }

    /// Corners of triangles.
    pub(crate) fn indices(&self, user: MeshPlace, index: usize) -> Result<Vec<u32>, LocatedFault> {
        let accessor = self.accessor(user, index)?;
        let place = MeshPlace::Accessor(index);
        let refuse =
            || place.fault(MeshFault::AccessorType { expected: "scalars of 8, 16 or 32 unsigned bits" });
        let component = match (accessor.type_, accessor.component_type) {
            (Checked::Valid(Type::Scalar), Checked::Valid(GenericComponentType(component)))
                if is_index(component) && !accessor.normalized =>
            {
                component
            }
            _ => return Err(refuse()),
        };
        let size = size_of(component);
        let base = self.base(place, accessor, size)?;
        if accessor.count.0 > CORNER_LIMIT {
            return Err(too_many_triangles());
        }
        let mut corners: Vec<u32> = match base {
            Some(elements) => elements.iter().map(decode_index).collect(),
            None => vec![0; accessor.count.0 as usize],
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace_sparse(place, sparse, size, decode_index, &mut corners)?;
        }
        Ok(corners)
    }

    fn accessor(&self, user: MeshPlace, index: usize) -> Result<&'d Accessor, LocatedFault> {
        let count = self.root.accessors.len();
        self.root
            .accessors
            .get(index)
            .ok_or_else(|| user.fault(MeshFault::NoSuch { what: "accessor", index, count }))
    }

    /// Encoding of three floats, or with KHR_mesh_quantization of three small integers.
    fn encoding(&self, accessor: &Accessor) -> Result<Encoding, MeshFault> {
        let quantized = self.root.extensions_used.iter().any(|name| name == "KHR_mesh_quantization");
        match (accessor.type_, accessor.component_type) {
            (Checked::Valid(Type::Vec3), Checked::Valid(GenericComponentType(component)))
                if component == ComponentType::F32 || (quantized && component != ComponentType::U32) =>
            {
                Ok(Encoding { component, normalized: accessor.normalized })
            }
            _ => Err(MeshFault::AccessorType { expected: "vectors of three 32-bit floats" }),
        }
    }

    /// The elements before sparse values replace some; `None` if they are all zero.
    fn base(
        &self,
        place: MeshPlace,
        accessor: &Accessor,
        size: u64,
    ) -> Result<Option<Elements<'d>>, LocatedFault> {
        let count = accessor.count.0;
        let offset = accessor.byte_offset.unwrap_or_default().0;
        match accessor.buffer_view {
            Some(view) => self.elements(place, view, offset, count, size).map(Some),
            None if accessor.sparse.is_some() && (1..=SPARSE_LIMIT).contains(&count) => Ok(None),
            None => Err(place.fault(MeshFault::NoView)),
        }
    }

    fn sparse_indices(
        &self,
        place: MeshPlace,
        sparse: &Sparse,
        count: usize,
    ) -> Result<Vec<usize>, LocatedFault> {
        let Checked::Valid(IndexComponentType(component)) = sparse.indices.component_type else {
            return Err(place
                .fault(MeshFault::AccessorType { expected: "sparse indices of 8, 16 or 32 unsigned bits" }));
        };
        let indices = &sparse.indices;
        let elements = self.elements(
            place,
            indices.buffer_view,
            indices.byte_offset.0,
            sparse.count.0,
            size_of(component),
        )?;
        let found: Vec<usize> = elements.iter().map(|bytes| decode_index(bytes) as usize).collect();
        let beyond = found.iter().find(|&&i| i >= count);
        let falling = found.windows(2).find(|pair| pair[0] >= pair[1]).map(|pair| &pair[1]);
        match beyond.or(falling) {
            Some(&index) => Err(place.fault(MeshFault::Sparse { count, index })),
            None => Ok(found),
        }
    }

    /// `count` elements of `size` bytes from `offset` in a view, all inside it.
    fn elements(
        &self,
        place: MeshPlace,
        view: Index<buffer::View>,
        offset: u64,
        count: u64,
        size: u64,
    ) -> Result<Elements<'d>, LocatedFault> {
        let (bytes, stride) = self.view(place, view.value())?;
        let stride = stride.unwrap_or(size);
        if count == 0 {
            return Err(place.fault(MeshFault::Empty));
        }
        if stride < size {
            return Err(place.fault(MeshFault::Stride { stride, element: size }));
        }
        // Saturation lets a damaged count end beyond any buffer, so that it is refused.
        let end = (count - 1).saturating_mul(stride).saturating_add(size).saturating_add(offset);
        let outside = || place.fault(MeshFault::Outside { end, bytes: bytes.len() as u64 });
        let bytes = bytes.get(offset as usize..end as usize).ok_or_else(outside)?;
        Ok(Elements { bytes, stride: stride as usize, size: size as usize, count: count as usize })
    }

    fn view(&self, user: MeshPlace, index: usize) -> Result<(&'d [u8], Option<u64>), LocatedFault> {
        let count = self.root.buffer_views.len();
        let no_such = || user.fault(MeshFault::NoSuch { what: "buffer view", index, count });
        let view = self.root.buffer_views.get(index).ok_or_else(no_such)?;
        let place = MeshPlace::View(index);
        let (buffer, count) = (view.buffer.value(), self.buffers.len());
        let no_such = || place.fault(MeshFault::NoSuch { what: "buffer", index: buffer, count });
        let bytes = self.buffers.get(buffer).ok_or_else(no_such)?;
        let start = view.byte_offset.unwrap_or_default().0;
        let end = start.saturating_add(view.byte_length.0);
        let outside = || place.fault(MeshFault::Outside { end, bytes: bytes.len() as u64 });
        let bytes = bytes.get(start as usize..end as usize).ok_or_else(outside)?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0 as u64)))
    }
}

fn size_of(component: ComponentType) -> u64 {
    component.size() as u64
}

fn is_index(component: ComponentType) -> bool {
    matches!(component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32)
}

fn decode_index(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte))
}

/// Storage of a vector's three numbers.
#[derive(Clone, Copy)]
struct Encoding {
    component: ComponentType,
    normalized: bool,
}

impl Encoding {
    fn vector_bytes(self) -> u64 {
        3 * size_of(self.component)
    }

    fn vector(self, bytes: &[u8]) -> DVec3 {
        let size = self.component.size();
        let number = |i: usize| self.number(&bytes[i * size..(i + 1) * size]);
        DVec3::new(number(0), number(1), number(2))
    }

    /// Reads a number; normalized integers become fractions (glTF 2.0, 3.6.2.2).
    fn number(self, bytes: &[u8]) -> f64 {
        let bits = decode_index(bytes);
        let (value, highest) = match self.component {
            ComponentType::F32 => return f64::from(f32::from_bits(bits)),
            ComponentType::I8 => (f64::from(bits as u8 as i8), 127.0),
            ComponentType::U8 => (f64::from(bits), 255.0),
            ComponentType::I16 => (f64::from(bits as u16 as i16), 32767.0),
            ComponentType::U16 => (f64::from(bits), 65535.0),
            ComponentType::U32 => (f64::from(bits), 4294967295.0),
        };
        if self.normalized { f64::max(value / highest, -1.0) } else { value }
    }
}
