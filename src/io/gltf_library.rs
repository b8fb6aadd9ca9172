//! Accessors, views and buffers as the library `gltf` has them, of a document that the project read itself.
//!
//! They are made field by field: to have the library read its JSON would bring its readers of all that a glTF may hold
//! (materials, animations, cameras) into the page, a tenth of it.

use super::gltf_document::{Accessor, Document, Sparse, View};
use gltf::json::accessor::{ComponentType, GenericComponentType, IndexComponentType, Type, sparse};
use gltf::json::buffer::Stride;
use gltf::json::validation::Checked::{Invalid, Valid};
use gltf::json::{self, Index};

/// The document for the library, which looks up no accessor before [`Document::check_accessor`] has checked it.
pub(super) fn of(document: &Document) -> gltf::Document {
    let root = json::Root {
        accessors: document.accessors.iter().map(accessor).collect(),
        buffer_views: document.buffer_views.iter().map(view).collect(),
        buffers: document.buffers.iter().map(|buffer| self::buffer(buffer.byte_length)).collect(),
        ..json::Root::default()
    };
    gltf::Document::from_json_without_validation(root)
}

fn accessor(accessor: &Accessor) -> json::Accessor {
    json::Accessor {
        buffer_view: accessor.buffer_view.map(index),
        byte_offset: Some(accessor.byte_offset.into()),
        count: accessor.count.into(),
        component_type: component(accessor.component_type)
            .map_or(Invalid, |c| Valid(GenericComponentType(c))),
        type_: kind(&accessor.kind).map_or(Invalid, Valid),
        normalized: accessor.normalized,
        sparse: accessor.sparse.as_deref().map(sparse),
        min: None,
        max: None,
        extensions: None,
        extras: json::Extras::default(),
    }
}

fn sparse(Sparse { count, indices, values }: &Sparse) -> sparse::Sparse {
    let component = indices.component_type.and_then(component);
    sparse::Sparse {
        count: (*count).into(),
        indices: sparse::Indices {
            buffer_view: index(indices.buffer_view),
            byte_offset: indices.byte_offset.into(),
            component_type: component.map_or(Invalid, |c| Valid(IndexComponentType(c))),
            extensions: None,
            extras: json::Extras::default(),
        },
        values: sparse::Values {
            buffer_view: index(values.buffer_view),
            byte_offset: values.byte_offset.into(),
            extensions: None,
            extras: json::Extras::default(),
        },
        extensions: None,
        extras: json::Extras::default(),
    }
}

fn view(view: &View) -> json::buffer::View {
    json::buffer::View {
        buffer: index(view.buffer),
        byte_length: view.byte_length.into(),
        byte_offset: Some(view.byte_offset.into()),
        byte_stride: view.byte_stride.map(|stride| Stride(usize::try_from(stride).unwrap_or(usize::MAX))),
        target: None,
        extensions: None,
        extras: json::Extras::default(),
    }
}

fn buffer(byte_length: u64) -> json::Buffer {
    json::Buffer {
        byte_length: byte_length.into(),
        uri: None,
        extensions: None,
        extras: json::Extras::default(),
    }
}

/// A number beyond 32 bits names nothing that is there, and is never looked up.
fn index<T>(number: usize) -> Index<T> {
    Index::new(u32::try_from(number).unwrap_or(u32::MAX))
}

fn component(number: u32) -> Option<ComponentType> {
    match number {
        json::accessor::BYTE => Some(ComponentType::I8),
        json::accessor::UNSIGNED_BYTE => Some(ComponentType::U8),
        json::accessor::SHORT => Some(ComponentType::I16),
        json::accessor::UNSIGNED_SHORT => Some(ComponentType::U16),
        json::accessor::UNSIGNED_INT => Some(ComponentType::U32),
        json::accessor::FLOAT => Some(ComponentType::F32),
        _ => None,
    }
}

fn kind(name: &str) -> Option<Type> {
    match name {
        "SCALAR" => Some(Type::Scalar),
        "VEC2" => Some(Type::Vec2),
        "VEC3" => Some(Type::Vec3),
        "VEC4" => Some(Type::Vec4),
        _ => None,
    }
}
