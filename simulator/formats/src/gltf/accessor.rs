//! Accessors: lists of numbers in buffers (glTF 2.0 Specification, section 3.6.2).

use super::buffers::Buffers;
use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Accessor, Root};
use crate::nff::Excerpt;

/// The most elements of a list, and the most vertices and corners of a file: thousands of times what a
/// microcontroller can hold.
pub(super) const MOST: usize = 1 << 24;

/// Reads the lists of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lists<'f> {
    pub(super) root: &'f Root,
    pub(super) buffers: &'f Buffers<'f>,
}

impl Lists<'_> {
    /// The number of elements by the file, which is not checked against the bytes.
    pub(super) fn count(&self, index: usize) -> Result<usize, Wrong> {
        let accessor = find(&self.root.accessors, "accessor", index)?;
        Ok(usize::try_from(accessor.count).unwrap_or(usize::MAX))
    }

    /// A list of vectors or matrices. Integers that are `normalized` are shares of the largest integer.
    pub(super) fn vectors<const N: usize>(&self, index: usize) -> Result<Vec<[f32; N]>, Wrong> {
        let kind = match N {
            2 => "VEC2",
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        self.read(index, (kind, N), [0.0; N], |bytes, component, normalized| {
            let mut vector = [0.0; N];
            for (number, bytes) in vector.iter_mut().zip(bytes.chunks(component.size())) {
                *number = float(bytes, component, normalized)?;
                if !number.is_finite() {
                    return Err(GltfFault::Number { meaning: "a coordinate", found: (*number).into() });
                }
            }
            Ok(vector)
        })
    }

    /// A list of indices of vertices.
    pub(super) fn indices(&self, index: usize) -> Result<Vec<u32>, Wrong> {
        self.read(index, ("SCALAR", 1), 0, |bytes, component, _| whole(bytes, component))
    }

    /// A list of the four joints of each vertex.
    pub(super) fn joints(&self, index: usize) -> Result<Vec<[u32; 4]>, Wrong> {
        self.read(index, ("VEC4", 4), [0; 4], |bytes, component, _| {
            let mut joints = [0; 4];
            for (joint, bytes) in joints.iter_mut().zip(bytes.chunks(component.size())) {
                *joint = whole(bytes, component)?;
            }
            Ok(joints)
        })
    }

    fn read<T: Copy>(
        &self,
        index: usize,
        expected: (&'static str, usize),
        zero: T,
        element: impl Fn(&[u8], ComponentType, bool) -> Result<T, GltfFault>,
    ) -> Result<Vec<T>, Wrong> {
        let accessor = find(&self.root.accessors, "accessor", index)?;
        self.of(accessor, expected, zero, element).at(|| name("accessor", index, accessor.name.as_ref()))
    }

    fn of<T: Copy>(
        &self,
        accessor: &Accessor,
        (expected, numbers): (&'static str, usize),
        zero: T,
        element: impl Fn(&[u8], ComponentType, bool) -> Result<T, GltfFault>,
    ) -> Result<Vec<T>, Wrong> {
        let component = ComponentType::of(accessor.component_type)?;
        if accessor.kind != expected {
            return Err(GltfFault::Kind { expected, found: Excerpt(&accessor.kind).to_string() }.into());
        }
        let size = component.size() * numbers;
        let element = |bytes: &[u8]| element(bytes, component, accessor.normalized);
        let count = counted(accessor.count)?;
        let mut list = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset;
                self.strided(view, offset, size, count)?.map(element).collect::<Result<Vec<_>, _>>()?
            }
            None => vec![zero; count],
        };
        if let Some(sparse) = &accessor.sparse {
            let count = counted(sparse.count)?;
            let (at, values) = (&sparse.indices, &sparse.values);
            let component = ComponentType::of(at.component_type)?;
            let places = self.strided(at.buffer_view, at.byte_offset, component.size(), count)?;
            let values = self.strided(values.buffer_view, values.byte_offset, size, count)?;
            for (place, value) in places.zip(values) {
                let named = whole(place, component)? as usize;
                let count = list.len();
                let place = list.get_mut(named);
                *place.ok_or(GltfFault::Unknown { what: "element", named, count })? = element(value)?;
            }
        }
        Ok(list)
    }

    /// The bytes of each element, or an error if the buffer is too short.
    fn strided(
        &self,
        view: usize,
        offset: u64,
        size: usize,
        count: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, Wrong> {
        let (bytes, stride) = self.buffers.view(view)?;
        let stride = stride.unwrap_or(size);
        if stride < size {
            let found = format!("a stride of {stride} bytes");
            return Err(GltfFault::Kind { expected: "a stride of at least one element", found }.into());
        }
        let needed = match count.checked_sub(1) {
            Some(before_last) => (before_last as u64)
                .saturating_mul(stride as u64)
                .saturating_add(offset)
                .saturating_add(size as u64),
            None => 0,
        };
        let given = bytes.len() as u64;
        if needed > given {
            return Err(GltfFault::Short { needed, given }.into());
        }
        let bytes = bytes.get(usize::try_from(offset).unwrap_or(usize::MAX)..).unwrap_or_default();
        Ok(bytes.chunks(stride).take(count).filter_map(move |element| element.get(..size)))
    }
}

fn counted(count: u64) -> Result<usize, GltfFault> {
    let counted = usize::try_from(count).ok().filter(|count| *count <= MOST);
    counted.ok_or(GltfFault::TooMany { what: "elements", most: MOST })
}

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ComponentType {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl ComponentType {
    /// The type that stands in a file as this number of OpenGL.
    fn of(number: u32) -> Result<Self, GltfFault> {
        Ok(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return Err(GltfFault::Kind { expected: "a type of numbers", found: number.to_string() }),
        })
    }

    /// The bytes of a number.
    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

fn not_whole(found: &str) -> GltfFault {
    GltfFault::Kind { expected: "unsigned integers", found: found.to_owned() }
}

fn whole(bytes: &[u8], component: ComponentType) -> Result<u32, GltfFault> {
    match (component, bytes) {
        (ComponentType::U8, [a]) => Ok((*a).into()),
        (ComponentType::U16, [a, b]) => Ok(u16::from_le_bytes([*a, *b]).into()),
        (ComponentType::U32, [a, b, c, d]) => Ok(u32::from_le_bytes([*a, *b, *c, *d])),
        _ => Err(not_whole(&format!("{component:?}"))),
    }
}

fn float(bytes: &[u8], component: ComponentType, normalized: bool) -> Result<f32, GltfFault> {
    // Section 3.11 defines normalized integers: both the smallest one and the next stand for -1.
    let share = |number: f32, largest: f32| {
        if normalized { (number / largest).max(-1.0) } else { number }
    };
    match (component, bytes) {
        (ComponentType::F32, [a, b, c, d]) => Ok(f32::from_le_bytes([*a, *b, *c, *d])),
        (ComponentType::U8, [a]) => Ok(share((*a).into(), 255.0)),
        (ComponentType::I8, [a]) => Ok(share(a.cast_signed().into(), 127.0)),
        (ComponentType::U16, [a, b]) => Ok(share(u16::from_le_bytes([*a, *b]).into(), 65_535.0)),
        (ComponentType::I16, [a, b]) => Ok(share(i16::from_le_bytes([*a, *b]).into(), 32_767.0)),
        _ => Err(GltfFault::Kind {
            expected: "integers of 8 or 16 bits, or floats",
            found: format!("{component:?}"),
        }),
    }
}
