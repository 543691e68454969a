//! Explains characters with which no token starts, and guesses the intended text.

/// Interpretation of unreadable text.
pub(super) struct Reading {
    /// Number of bytes covered.
    pub length: usize,
    pub message: String,
    pub help: Option<String>,
    /// Replacement; `None` if the intention is unclear.
    pub meant: Option<String>,
}

/// Interprets the beginning of `text`, which is `character`; `number` is the number directly before it.
pub(super) fn read(text: &str, character: char, number: Option<&str>) -> Reading {
    let run = |belongs: &dyn Fn(char) -> bool| text.find(|it| !belongs(it)).unwrap_or(text.len());
    if superscript(character).is_some() {
        let length = run(&|it| superscript(it).is_some());
        let power: String = text[..length].chars().filter_map(superscript).collect();
        let signs = power.matches('-').count();
        let proper = power.len() > signs && signs <= usize::from(power.starts_with('-'));
        return Reading {
            length,
            message: format!("unreadable power `{}`", &text[..length]),
            help: Some(if proper {
                format!("write `^{power}`")
            } else {
                "write a power with `^`".to_string()
            }),
            meant: proper.then(|| format!("^{power}")),
        };
    }
    if character == '"' {
        let end = text[1..].find(['"', '\n']).map_or(text.len(), |at| at + 1);
        let length = if text[end..].starts_with('"') {
            end + 1
        } else {
            end
        };
        return Reading {
            length,
            message: "texts in quotes are not part of the language".to_string(),
            help: Some("write names without quotes".to_string()),
            meant: None,
        };
    }
    let (help, meant) = match character {
        '°' | 'º' | '˚' => match number {
            Some(number) => (Some(format!("write `{number}deg`")), Some("deg")),
            None => (
                Some("write `deg` directly after the number".to_string()),
                None,
            ),
        },
        '·' | '×' | '⋅' | '∙' | '∗' | '•' => replaced("*"),
        '−' | '–' | '—' | '‐' | '‑' | '‒' => replaced("-"),
        '÷' | '∕' | '⁄' => replaced("/"),
        '→' | '⟶' | '➔' => replaced("->"),
        '½' => replaced_by_value("1/2", "1"),
        '¼' => replaced_by_value("1/4", "1"),
        '¾' => replaced_by_value("3/4", "1"),
        '√' => (Some("write `sqrt(…)`".to_string()), None),
        '′' | '″' => (
            Some("write the angle in `deg` or `rad`, the length in `m` or `mm`".to_string()),
            None,
        ),
        '（' => replaced("("),
        '）' => replaced(")"),
        '，' => replaced(","),
        '；' | '\u{37e}' => replaced(";"),
        '%' => (
            Some("percentages are not read: write `0.01*`".to_string()),
            None,
        ),
        '#' => (Some("write comments with `//`".to_string()), None),
        _ => (None, None),
    };
    let length = if meant.is_some() {
        character.len_utf8()
    } else {
        run(&|it| it == character)
    };
    let message = format!("unreadable character {}", described(character));
    Reading {
        length,
        message,
        help,
        meant: meant.map(str::to_string),
    }
}

fn replaced(meant: &'static str) -> (Option<String>, Option<&'static str>) {
    (Some(format!("write `{meant}`")), Some(meant))
}

fn replaced_by_value(written: &str, meant: &'static str) -> (Option<String>, Option<&'static str>) {
    (Some(format!("write `{written}`")), Some(meant))
}

/// Returns the character if it is visible, and its code point if it is not ASCII.
fn described(character: char) -> String {
    let number = format!("U+{:04X}", u32::from(character));
    let invisible = character.is_control()
        || matches!(character,
            '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
    match character {
        '`' => "U+0060, a backtick".to_string(),
        _ if invisible => number,
        _ if character.is_ascii() => format!("`{character}`"),
        _ => format!("`{character}` ({number})"),
    }
}

fn superscript(character: char) -> Option<char> {
    Some(match character {
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴'..='⁹' => char::from_digit(u32::from(character) - u32::from('⁰'), 10)?,
        '⁻' => '-',
        _ => return None,
    })
}

/// Returns the word with Greek letters written out; `None` if another letter is not ASCII.
pub(super) fn ascii_spelling(word: &str) -> Option<String> {
    const GREEK: [&str; 25] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
        "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon",
        "phi", "chi", "psi", "omega",
    ];
    let mut spelled = String::new();
    for character in word.chars() {
        let number = u32::from(character);
        match character {
            'α'..='ω' => spelled.push_str(GREEK[(number - u32::from('α')) as usize]),
            'Α'..='Ω' => {
                let name = GREEK[(number - u32::from('Α')) as usize];
                spelled.push_str(&name[..1].to_uppercase());
                spelled.push_str(&name[1..]);
            }
            'ϕ' => spelled.push_str("phi"),
            'ϑ' => spelled.push_str("theta"),
            'ϵ' => spelled.push_str("epsilon"),
            '\u{b5}' => spelled.push('u'),
            'ä' | 'ö' | 'ü' | 'Ä' | 'Ö' | 'Ü' => {
                spelled.push(match character {
                    'ä' => 'a',
                    'ö' => 'o',
                    'ü' => 'u',
                    'Ä' => 'A',
                    'Ö' => 'O',
                    _ => 'U',
                });
                spelled.push('e');
            }
            'ß' => spelled.push_str("ss"),
            'æ' => spelled.push_str("ae"),
            'à'..='å' => spelled.push('a'),
            'è'..='ë' => spelled.push('e'),
            'ì'..='ï' => spelled.push('i'),
            'ò'..='õ' | 'ø' => spelled.push('o'),
            'ù'..='û' => spelled.push('u'),
            'ç' => spelled.push('c'),
            'ñ' => spelled.push('n'),
            ascii if ascii.is_ascii() => spelled.push(ascii),
            _ => return None,
        }
    }
    Some(spelled)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_the_intended_text() {
        let meant = |text: &str, number| {
            let character = text.chars().next().unwrap_or(' ');
            let reading = read(text, character, number);
            (
                reading.length,
                reading.help.unwrap_or_default(),
                reading.meant,
            )
        };
        assert_eq!(
            meant("°;", Some("30")),
            (2, "write `30deg`".to_string(), Some("deg".to_string()))
        );
        assert_eq!(
            meant("⁻¹²x", None),
            (8 - 1, "write `^-12`".to_string(), Some("^-12".to_string()))
        );
        assert_eq!(meant("⁻", None).2, None);
        assert_eq!(meant("¹⁻", None).2, None);
        assert_eq!(meant("·x", None).2.as_deref(), Some("*"));
        assert_eq!(meant("\"a b\" c", None).0, 5);
        assert_eq!(meant("\"a b\nc", None).0, 4);
        assert_eq!(meant("###x", None).0, 3);
    }

    #[test]
    fn greek_is_written_out() {
        assert_eq!(ascii_spelling("π").as_deref(), Some("pi"));
        assert_eq!(ascii_spelling("φ_2").as_deref(), Some("phi_2"));
        assert_eq!(ascii_spelling("Δx").as_deref(), Some("Deltax"));
        assert_eq!(ascii_spelling("ω").as_deref(), Some("omega"));
        assert_eq!(ascii_spelling("µm").as_deref(), Some("um"));
        assert_eq!(ascii_spelling("линк"), None);
    }
}
