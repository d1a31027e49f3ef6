//! A Rust source reduced to its code: [`strip`] blanks comments and literals, [`without_tests`] test modules.

/// The source with comments, strings and characters blanked out, line for line.
pub(crate) fn strip(source: &str) -> String {
    let chars: Vec<char> = source.chars().collect();
    let mut code = String::with_capacity(source.len());
    let mut i = 0;
    while i < chars.len() {
        let end = match chars[i] {
            '/' if chars.get(i + 1) == Some(&'/') => find(&chars, i, |c| c[0] == '\n'),
            '/' if chars.get(i + 1) == Some(&'*') => block_comment(&chars, i),
            'r' if !follows_name(&chars, i) && raw_hashes(&chars, i).is_some() => raw_string(&chars, i),
            '"' => quoted(&chars, i),
            '\'' if chars.get(i + 1) == Some(&'\\') || chars.get(i + 2) == Some(&'\'') => quoted(&chars, i),
            other => {
                code.push(other);
                i += 1;
                continue;
            }
        };
        code.extend(chars[i..end].iter().filter(|&&c| c == '\n'));
        code.push(' ');
        i = end;
    }
    code
}

/// The stripped source without the items behind `#[cfg(test)]`.
pub(crate) fn without_tests(source: &str) -> String {
    let mut rest = strip(source);
    let mut kept = String::new();
    while let Some(at) = rest.find("#[cfg(test)]") {
        kept.push_str(&rest[..at]);
        let item = &rest[at..];
        let (mut depth, mut end) = (0_usize, item.len());
        for (offset, c) in item.char_indices().skip("#[cfg(test)]".len()) {
            depth = match c {
                '{' => depth + 1,
                '}' => depth.saturating_sub(1),
                _ => depth,
            };
            if depth == 0 && (c == '}' || c == ';') {
                end = offset + 1;
                break;
            }
        }
        kept.extend(item[..end].chars().filter(|&c| c == '\n'));
        rest = item[end..].to_owned();
    }
    kept + &rest
}

fn follows_name(chars: &[char], at: usize) -> bool {
    at > 0 && (chars[at - 1].is_alphanumeric() && chars[at - 1] != 'b' || chars[at - 1] == '_')
}

fn find(chars: &[char], from: usize, end: impl Fn(&[char]) -> bool) -> usize {
    (from..chars.len()).find(|&i| end(&chars[i..])).unwrap_or(chars.len())
}

fn block_comment(chars: &[char], from: usize) -> usize {
    let (mut depth, mut i) = (0_usize, from);
    while i + 1 < chars.len() {
        match (chars[i], chars[i + 1]) {
            ('/', '*') => (depth, i) = (depth + 1, i + 2),
            ('*', '/') => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            return i;
        }
    }
    chars.len()
}

/// The number of `#` of a raw string that starts here.
fn raw_hashes(chars: &[char], from: usize) -> Option<usize> {
    let hashes = chars[from + 1..].iter().take_while(|&&c| c == '#').count();
    (chars.get(from + 1 + hashes) == Some(&'"')).then_some(hashes)
}

fn raw_string(chars: &[char], from: usize) -> usize {
    let hashes = raw_hashes(chars, from).unwrap();
    let body = from + 2 + hashes;
    let closes =
        |rest: &[char]| rest[0] == '"' && rest[1..].iter().take_while(|&&c| c == '#').count() >= hashes;
    (find(chars, body, closes) + 1 + hashes).min(chars.len())
}

fn quoted(chars: &[char], from: usize) -> usize {
    let mut i = from + 1;
    while i < chars.len() && chars[i] != chars[from] {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    (i + 1).min(chars.len())
}

#[test]
fn comments_and_literals_are_blanked() {
    let source = "let a = \"unsafe \\\" {\"; // todo!\nlet b = 'x'; let c: &'static str = r#\"un\"wrap\"#; /* a /* b */ c */ d";
    let code = strip(source);
    for gone in ["unsafe", "todo", "un\"", "wrap", "'x'", "b */"] {
        assert!(!code.contains(gone), "{gone} in {code}");
    }
    assert!(code.contains("&'static str") && code.trim_end().ends_with('d') && code.lines().count() == 2);
}

#[test]
fn test_modules_are_left_out() {
    let source = "fn a() {}\n#[cfg(test)]\nmod tests {\n    fn b() { x.unwrap() }\n}\nfn c() {}\n#[cfg(test)]\nuse d;\nfn e() {}\n";
    let code = without_tests(source);
    assert!(code.contains("fn a") && code.contains("fn c") && code.contains("fn e"));
    assert!(
        !code.contains("unwrap") && !code.contains("use d") && code.lines().count() == source.lines().count()
    );
}
