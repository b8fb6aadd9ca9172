//! Tables that are read, and the sentences of those that are not.

use super::*;
use crate::io::Place;

fn csv(text: &str, vertices: usize) -> Result<VertexTable, String> {
    read(text.as_bytes(), vertices).map_err(|e| e.to_string())
}

fn values(table: &VertexTable) -> Vec<Vec<Option<f64>>> {
    table.columns.iter().map(|column| column.values.clone()).collect()
}

#[test]
fn rows_in_order_and_numbered_rows_are_read() {
    let wanted = vec![vec![Some(1.5), Some(-2.0)], vec![Some(0.25), Some(3.0)]];
    let texts =
        ["1.5,0.25\n-2,3\n", "heat, u # both\n1.5,0.25\n\n-2,3", "vertex,heat,u\r\n1,-2,3\r\n0,1.5,0.25\r\n"];
    for text in texts {
        assert_eq!(values(&csv(text, 2).unwrap()), wanted, "{text}");
    }
    let names = |text| csv(text, 2).unwrap().columns.into_iter().map(|c| c.name).collect::<Vec<_>>();
    assert_eq!(names(texts[0]), ["1", "2"]);
    assert_eq!(names(texts[1]), ["heat", "u"]);
    assert_eq!(csv(texts[2], 2).unwrap().rows, Rows::Numbered("vertex".to_owned()));
    // A vertex may be left out, or have an empty field: whether that may be is for the mesh to say.
    assert_eq!(values(&csv("vertex,heat\n1,\n2,5\n", 4).unwrap()), [[None, None, Some(5.0), None]]);
}

#[test]
fn tables_of_r_and_pandas_are_read() {
    let of_r = csv("\"\",\"heat\",\"left, upper\"\n\"1\",1.5,0.25\n\"2\",-2,3\n", 2).unwrap();
    let of_pandas = csv(",heat,\"left, upper\"\n0,1.5,0.25\n1,-2,3\n", 2).unwrap();
    for table in [of_r, of_pandas] {
        assert_eq!(values(&table), [[Some(1.5), Some(-2.0)], [Some(0.25), Some(3.0)]]);
        assert_eq!(
            table.columns.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(),
            ["heat", "left, upper"]
        );
        // Names come out in quotes where they have commas.
        let back = crate::export::vertex_table::csv(&table);
        assert_eq!(csv(std::str::from_utf8(&back).unwrap(), 2).unwrap(), table);
    }
    let uncounted = "the first column has no name and does not count the rows: call it `vertex` where it has the numbers of vertices";
    for (text, line) in
        [(",a\n2,1\n3,1\n", 2), (",a\n0,1\n0,1\n", 3), (",a\nA,1\nB,1\n", 2), (",a\n1,1\n,1\n", 3)]
    {
        assert_eq!(csv(text, 2), Err(format!("line {line}: {uncounted}")), "{text}");
    }
    assert_eq!(csv(",a,\n0,1,2\n", 1), Err("line 1: column 3 has no name".to_owned()));
}

#[test]
fn faults_are_told_with_their_line() {
    let cases = [
        ("", "line 1: the table is empty"),
        ("# nothing\n", "line 1: the table is empty"),
        ("vertex,a\n0,1\n7,1\n", "line 3: there is no vertex 7: the mesh file has 2 vertices"),
        ("vertex,a\n0,1\n\n0,2\n", "line 4: vertex 0 is already in line 2"),
        ("vertex,a\n0,warm\n", "line 2: \"warm\" should be a number of \"a\""),
        ("vertex,a\n-1,2\n", "line 2: \"-1\" should be a vertex number"),
        ("vertex,a,b\n0,1\n", "line 2: a number of \"b\" is missing: the file may be cut off"),
        ("vertex,a\n0,1,2\n", "line 2: it has more than 1 values"),
        ("vertex,a\n0,inf\n", "line 2: inf is no usable value of \"a\""),
        ("vertex,a\n0,-1e308\n", "line 2: -1e308 is no usable value of \"a\""),
        ("vertex,a,a\n0,1,2\n", "line 1: two columns are called \"a\""),
        ("vertex,,a\n0,1,2\n", "line 1: column 2 has no name"),
        (
            "a\n1\n",
            "header: it has 1 rows, but the mesh file has 2 vertices: give each a row, or a first column `vertex`",
        ),
        ("a\n1\n2\n3\n", "line 4: there is no vertex 2: the mesh file has 2 vertices"),
        ("vertex\n0\n1\n", "header: there is nothing but the vertices: give each of them at least one value"),
    ];
    for (text, sentence) in cases {
        assert_eq!(csv(text, 2), Err(sentence.to_owned()), "{text}");
    }
    let long = format!("a\n{}\n", "1,".repeat(1 << 20));
    assert!(csv(&long, 2).unwrap_err().starts_with("line 2: it has 2097152 bytes"), "a long line");
    assert!(read(b"a\n\xff\n", 1).is_err());
}

#[test]
fn marks_and_ends_of_lines_are_those_of_every_file() {
    let wanted = vec![vec![Some(1.5), Some(-2.0)]];
    let head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float heat\nend_header\n1.5\n-2\n";
    for text in ["vertex,heat\r1,-2\r# a\r0,1.5", head] {
        let marked = format!("\u{feff}{text}");
        let utf16: Vec<u8> = marked.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for bytes in [text.as_bytes(), marked.as_bytes(), &utf16] {
            assert_eq!(values(&read(bytes, 2).unwrap()), wanted, "{text}");
        }
    }
    assert_eq!(read(b"vertex,a\r0,1\r\r0,2\r", 2).unwrap_err().place, Place::Line(4));
    // A table may have a column of that name.
    assert_eq!(csv("ply,heat\n1,2\n3,4\n", 2).unwrap().columns.len(), 2);
}

#[test]
fn a_heading_does_not_ask_for_much_memory() {
    let names: Vec<String> = (0..100_000).map(|k| k.to_string()).collect();
    let table = format!("vertex,{}\n", names.join(","));
    let told = csv(&table, 1_000_000).unwrap_err();
    assert_eq!(told, "line 1: 100000 columns for 1000000 vertices are more than 134217728 values");
}

#[test]
fn properties_keep_their_types_and_coordinates_are_none() {
    let head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
                property uchar red\nproperty double heat\nproperty list uchar int others\nend_header\n";
    let table = csv(&format!("{head}0 0 0 255 0.5 0\n1 0 0 7 -1e3 2 4 5\n"), 2).unwrap();
    assert_eq!(values(&table), [[Some(255.0), Some(7.0)], [Some(0.5), Some(-1e3)]]);
    let types: Vec<_> = table.columns.iter().map(|c| (c.name.as_str(), c.number_type)).collect();
    assert_eq!(types, [("red", NumberType::UChar), ("heat", NumberType::Double)]);
    assert_eq!(table.left_out, ["others"]);
    let other = csv(&format!("{head}0 0 0 255 0.5 0\n1 0 0 7 -1e3 0\n"), 3).unwrap_err();
    assert_eq!(other, "header: it has 2 vertices, but the mesh file has 3");
    let huge = head.replace("vertex 2", "vertex 2000000000");
    assert!(csv(&huge, 2).unwrap_err().contains("announces at least"), "sizes come first");
    let broken = csv(&format!("{head}0 0 0 255 nan 0\n1 0 0 7 1 0\n"), 2).unwrap_err();
    assert!(broken.contains("vertex 0: its \"heat\"") || broken.contains("contents"), "{broken}");
}

#[test]
fn numbers_go_to_the_nearest_of_their_type() {
    assert_eq!([300.0, -4.0, 12.5, 12.4].map(|x| NumberType::UChar.nearest(x)), [255.0, 0.0, 13.0, 12.0]);
    assert_eq!(NumberType::Double.nearest(0.1), 0.1);
    let mut bytes = Vec::new();
    NumberType::Short.push(-2.6, &mut bytes);
    NumberType::Float.push(0.5, &mut bytes);
    assert_eq!(bytes, [&(-3_i16).to_le_bytes()[..], &0.5_f32.to_le_bytes()].concat());
}
