//! Removes the spaces of a script that only its authors need: those beside signs, outside of texts and patterns.
//!
//! A line ends where a statement may end with it; after a sign that a statement or a list goes on after, the next one follows. The last
//! statement of a block needs no semicolon.

/// Signs beside which a space means nothing.
const SIGNS: &str = "=+-*/%<>!?:&|,;(){}[]";

/// Signs after which the end of a line means nothing.
const BEFORE_LINES: &str = ";,{([?:&|=";

/// Signs after which a slash begins a pattern.
const BEFORE_PATTERNS: &str = "(,=:[!&|?{};>";

/// Returns a script without these spaces.
pub fn dense_script(script: &str) -> String {
    let mut scanner = Scanner {
        rest: script.chars().collect(),
        place: 0,
        dense: String::with_capacity(script.len()),
    };
    scanner.code(false);
    scanner.dense
}

struct Scanner {
    rest: Vec<char>,
    place: usize,
    dense: String,
}

impl Scanner {
    /// Takes code until its end, or until the brace that closes an expression in a template.
    fn code(&mut self, is_in_template: bool) {
        let mut depth = 0_usize;
        while let Some(letter) = self.peek() {
            match letter {
                '"' | '\'' => self.text(letter),
                '`' => self.template(),
                '/' if self.begins_pattern() => self.pattern(),
                ' ' => self.space(),
                '\n' if self.dense.ends_with(|it| BEFORE_LINES.contains(it)) => self.place += 1,
                '}' if is_in_template && depth == 0 => return,
                _ => {
                    match letter {
                        '{' => depth += 1,
                        '>' => self.unwrap_parameter(),
                        '}' => {
                            depth = depth.saturating_sub(1);
                            if self.dense.ends_with(';') {
                                self.dense.pop();
                            }
                        }
                        _ => {}
                    }
                    self.take();
                }
            }
        }
    }

    /// Removes the parentheses of a single parameter before the end of an arrow.
    fn unwrap_parameter(&mut self) {
        let Some(before) = self.dense.strip_suffix(")=") else {
            return;
        };
        let Some((before, name)) = before.rsplit_once('(') else {
            return;
        };
        let is_word = |it: char| it.is_alphanumeric() || it == '_';
        if name.is_empty() || !name.chars().all(is_word) || before.ends_with(is_word) {
            return;
        }
        self.dense = format!("{before}{name}=");
    }

    fn peek(&self) -> Option<char> {
        self.rest.get(self.place).copied()
    }

    fn take(&mut self) -> Option<char> {
        let letter = self.peek()?;
        self.place += 1;
        self.dense.push(letter);
        Some(letter)
    }

    /// Takes a text in quotation marks.
    fn text(&mut self, mark: char) {
        self.take();
        while let Some(letter) = self.take() {
            match letter {
                '\\' => {
                    self.take();
                }
                _ if letter == mark => return,
                _ => {}
            }
        }
    }

    /// Takes a template, with the code in it.
    fn template(&mut self) {
        self.take();
        while let Some(letter) = self.take() {
            match letter {
                '\\' => {
                    self.take();
                }
                '`' => return,
                '$' if self.peek() == Some('{') => {
                    self.take();
                    self.code(true);
                }
                _ => {}
            }
        }
    }

    fn begins_pattern(&self) -> bool {
        let before = self.dense.trim_end_matches(' ');
        before.ends_with("return") || before.ends_with(|it| BEFORE_PATTERNS.contains(it))
    }

    /// Takes a pattern between slashes.
    fn pattern(&mut self) {
        self.take();
        let mut is_in_class = false;
        while let Some(letter) = self.take() {
            match letter {
                '\\' => {
                    self.take();
                }
                '[' => is_in_class = true,
                ']' => is_in_class = false,
                '/' if !is_in_class => return,
                _ => {}
            }
        }
    }

    /// Leaves spaces out beside a sign, unless two signs would become one.
    fn space(&mut self) {
        while self.peek() == Some(' ') {
            self.place += 1;
        }
        let (before, after) = (self.dense.chars().next_back(), self.peek());
        let is_sign = |it: Option<char>| it.is_some_and(|it| SIGNS.contains(it));
        let would_join = before == after && matches!(before, Some('+' | '-'));
        if would_join || !(is_sign(before) || is_sign(after)) {
            self.dense.push(' ');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::dense_script;

    #[test]
    fn spaces_beside_signs_go_and_others_stay() {
        for (script, dense) in [
            ("const a = b + c;", "const a=b+c;"),
            ("a - -b + +c - d", "a- -b+ +c-d"),
            ("return x / 2 / y;", "return x/2/y;"),
            ("if (a in b) { f(); }", "if(a in b){f()}"),
            (
                "if (a) {\nf();\ng(b,\nc);\n}\nh();\n",
                "if(a){f();g(b,c)}\nh();",
            ),
            ("all.map((it) => it.a)", "all.map(it=>it.a)"),
            (
                "f = async (it) => g((a, b) => a)",
                "f=async(it)=>g((a,b)=>a)",
            ),
            ("s = \";\"\nt = `;\n}`\n", "s=\";\"\nt=`;\n}`\n"),
            ("s = \"a + b\" + 'c : d';", "s=\"a + b\"+'c : d';"),
            ("s = \"\\\" + \" + b", "s=\"\\\" + \"+b"),
            (
                "`a + ${b + c} + ${ { d: 1 }.d } e`",
                "`a + ${b+c} + ${{d:1}.d} e`",
            ),
            ("`${`x + ${y + z}`} + w` + v", "`${`x + ${y+z}`} + w`+v"),
            (
                "d.replace(/([-\\d.]+) ([/ ]+)/g, w)",
                "d.replace(/([-\\d.]+) ([/ ]+)/g,w)",
            ),
            ("return / : /.test(a) ? b : c", "return/ : /.test(a)?b:c"),
            ("a = b\nc = d", "a=b\nc=d"),
        ] {
            assert_eq!(dense_script(script), dense, "{script}");
        }
    }
}
