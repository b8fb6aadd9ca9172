//! Fields of a line that a sign separates, with quotes where they hold it (RFC 4180).

use std::borrow::Cow;

/// The fields of a line, without the spaces around them. A field in double quotes may hold the separator; two quotes in it
/// are one.
pub fn fields(line: &str, separator: char) -> Fields<'_> {
    Fields { rest: Some(line), separator }
}

/// The fields of a line that are left; the line has one more than separators.
pub struct Fields<'a> {
    rest: Option<&'a str>,
    separator: char,
}

impl<'a> Iterator for Fields<'a> {
    type Item = Cow<'a, str>;

    fn next(&mut self) -> Option<Cow<'a, str>> {
        let rest = self.rest.take()?;
        let plain = rest.split(self.separator).next().unwrap_or_default();
        if plain.contains('"') {
            return Some(Cow::Owned(self.quoted(rest)));
        }
        self.rest = rest.get(plain.len() + self.separator.len_utf8()..);
        Some(Cow::Borrowed(plain.trim()))
    }
}

impl<'a> Fields<'a> {
    /// The first field of the rest of a line, which has quotes.
    fn quoted(&mut self, rest: &'a str) -> String {
        let mut field = String::new();
        let mut signs = rest.char_indices().peekable();
        let mut is_quoted = false;
        while let Some((at, sign)) = signs.next() {
            match sign {
                '"' if is_quoted && signs.peek().is_some_and(|(_, next)| *next == '"') => {
                    signs.next();
                    field.push('"');
                }
                '"' if is_quoted => is_quoted = false,
                '"' if field.trim().is_empty() => {
                    field.clear();
                    is_quoted = true;
                }
                _ if sign == self.separator && !is_quoted => {
                    self.rest = rest.get(at + sign.len_utf8()..);
                    break;
                }
                _ => field.push(sign),
            }
        }
        field.trim().to_owned()
    }
}

/// A label as a field between commas.
pub fn field(label: &str) -> String {
    let label = one_line(label);
    if label.contains([',', '"', ';', '\t']) || label.starts_with('#') {
        format!("\"{}\"", label.replace('"', "\"\""))
    } else {
        label
    }
}

/// A label on one line.
pub fn one_line(label: &str) -> String {
    label.split(char::is_control).collect::<Vec<_>>().join(" ").trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(line: &str, separator: char) -> Vec<Cow<'_, str>> {
        fields(line, separator).collect()
    }

    #[test]
    fn fields_are_what_they_were_before_they_were_joined() {
        for label in ["", "tip", "left, upper", "a \"good\" one", "\"", "x;y", "#7", "ear,\"left\""] {
            let line = format!("{},1, 2 ,{}", field(label), field(label));
            assert_eq!(all(&line, ','), [label, "1", "2", label]);
        }
        assert_eq!(all("", ','), [""]);
        assert_eq!(all("a,", ','), ["a", ""]);
        assert_eq!(all("\"a\",", ','), ["a", ""]);
        assert_eq!(all("a;\"b;c\";d", ';'), ["a", "b;c", "d"]);
        assert_eq!(all("5\" long,1", ','), ["5\" long", "1"]);
    }
}
