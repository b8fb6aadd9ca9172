//! Fields of a line that a sign separates, with quotes where they hold it (RFC 4180).

/// The fields of a line, without the spaces around them. A field in double quotes may hold the separator; two quotes in it
/// are one.
pub fn fields(line: &str, separator: char) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut signs = line.chars().peekable();
    let mut is_quoted = false;
    while let Some(sign) = signs.next() {
        // There is always a last field.
        let Some(field) = fields.last_mut() else { break };
        match sign {
            '"' if is_quoted && signs.peek() == Some(&'"') => {
                signs.next();
                field.push('"');
            }
            '"' if is_quoted => is_quoted = false,
            '"' if field.trim().is_empty() => {
                field.clear();
                is_quoted = true;
            }
            _ if sign == separator && !is_quoted => fields.push(String::new()),
            _ => field.push(sign),
        }
    }
    fields.iter_mut().for_each(|field| *field = field.trim().to_owned());
    fields
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

    #[test]
    fn fields_are_what_they_were_before_they_were_joined() {
        for label in ["", "tip", "left, upper", "a \"good\" one", "\"", "x;y", "#7", "ear,\"left\""] {
            let line = format!("{},1, 2 ,{}", field(label), field(label));
            assert_eq!(fields(&line, ','), [label, "1", "2", label]);
        }
        assert_eq!(fields("", ','), [""]);
        assert_eq!(fields("a;\"b;c\";d", ';'), ["a", "b;c", "d"]);
        assert_eq!(fields("5\" long,1", ','), ["5\" long", "1"]);
    }
}
