//! Values at the vertices of a mesh file: as a table (CSV).

use crate::io::separated;
use crate::io::vertex_table::{Column, Heading, Rows, VertexTable};
use std::fmt::Write;

/// A line for each vertex, which is named as the table does; a vertex without a value has an empty field, or no line where rows are
/// numbered and it has no values at all.
pub fn csv(table: &VertexTable) -> Vec<u8> {
    let mut text = String::new();
    let names: Vec<String> = table.columns.iter().map(|column| separated::field(&column.name)).collect();
    let names = names.iter().map(String::as_str);
    match &table.rows {
        Rows::Numbered(number) => push_line(&mut text, std::iter::once(number.as_str()).chain(names)),
        Rows::InOrder { heading: Heading::Named } => push_line(&mut text, names),
        Rows::InOrder { heading: Heading::Missing } => {}
    }
    let is_numbered = matches!(table.rows, Rows::Numbered(_));
    let vertices = table.columns.first().map_or(0, |column| column.values.len());
    for v in 0..vertices {
        let fields: Vec<String> = table.columns.iter().map(|column| told(column, v)).collect();
        if !is_numbered {
            push_line(&mut text, fields.iter().map(String::as_str));
        } else if fields.iter().any(|field| !field.is_empty()) {
            // Writing to a string does not fail.
            let _ = write!(text, "{v},");
            push_line(&mut text, fields.iter().map(String::as_str));
        }
    }
    text.into_bytes()
}

fn told(column: &Column, v: usize) -> String {
    column.values[v].map(|value| column.number_type.nearest(value).to_string()).unwrap_or_default()
}

fn push_line<'a>(text: &mut String, fields: impl Iterator<Item = &'a str>) {
    let begin = text.len();
    for field in fields {
        if text.len() > begin {
            text.push(',');
        }
        text.push_str(field);
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::ply;
    use crate::io::read_mesh;
    use crate::io::vertex_table::{NumberType, read};
    use glam::DVec3;

    fn table(rows: Rows) -> VertexTable {
        let column = |name: &str, number_type, values: [f64; 4]| Column {
            name: name.to_owned(),
            number_type,
            values: values.map(Some).to_vec(),
        };
        let columns = vec![
            column("red", NumberType::UChar, [0.0, 255.0, 12.0, 3.0]),
            column("heat", NumberType::Double, [0.1, -1e-7, 1e20, 0.0]),
        ];
        VertexTable { rows, columns, left_out: Vec::new() }
    }

    #[test]
    fn the_reader_reads_tables_back() {
        for rows in [Rows::Numbered("vertex".to_owned()), Rows::InOrder { heading: Heading::Named }] {
            let given = table(rows);
            let back = read(&csv(&given), 4).unwrap();
            assert_eq!(back.rows, given.rows);
            for (a, b) in given.columns.iter().zip(&back.columns) {
                assert_eq!((&a.name, &a.values), (&b.name, &b.values));
            }
        }
        let mut holed = table(Rows::Numbered("vertex".to_owned()));
        holed.columns.iter_mut().for_each(|column| column.values[2] = None);
        assert_eq!(csv(&holed), b"vertex,red,heat\n0,0,0.1\n1,255,-0.0000001\n3,3,0\n");
        let unnamed = csv(&table(Rows::InOrder { heading: Heading::Missing }));
        assert!(unnamed.starts_with(b"0,0.1\n255,"));
    }

    #[test]
    fn the_reader_reads_properties_back() {
        let given = table(Rows::InOrder { heading: Heading::Named });
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3], vec![0, 3, 2]];
        let bytes = ply::polygons_with(&positions, &faces, &given.columns);
        assert_eq!(read(&bytes, 4).unwrap(), given);
        assert_eq!(read_mesh(&bytes).unwrap().polygons, faces);
    }
}
