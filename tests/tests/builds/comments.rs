//! Comments of a description in the generated documentation, read by the parser of `rustdoc`: nothing in them is
//! Rust, HTML, or a name to be resolved.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options as Choices, generate};
use linkwright_tests::files;
use linkwright_tests::random::Random;
use pulldown_cmark::{BrokenLink, CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

/// Pieces of lines: all that have a meaning in Markdown, and a few words.
const PARTS: &[&str] = &[
    "```",
    "````",
    "~~~",
    "~~",
    "`",
    "``",
    "rust",
    "[Q]",
    "[`Q`]",
    "<T>",
    "</p>",
    "<pre>",
    "<!--",
    "-->",
    "<?",
    "<![CDATA[",
    "https://a.bc/d",
    "http://",
    "<https://a.bc>",
    "[w](https://a.bc)",
    "[w](x)",
    "![",
    "](",
    ")",
    "[",
    "]",
    "(",
    "\\",
    "\\\\",
    "|",
    "- ",
    "-",
    "+ ",
    "> ",
    ">",
    "1. ",
    "12) ",
    "    ",
    "\t",
    "  ",
    " ",
    "a",
    "b ",
    "# ",
    "*",
    "**",
    "_",
    "&lt;",
    "&#91;",
    "|---|",
    "---",
    "===",
    "[^1]",
    ": ",
    "[x]: y",
    "{",
    "\"",
    "'",
    "!",
    "é",
];

fn below(random: &mut Random, count: usize) -> usize {
    (random.bits() % count as u64) as usize
}

fn line(random: &mut Random) -> String {
    let pick = |random: &mut Random| PARTS[below(random, PARTS.len())];
    // Often the line continues as others do.
    match below(random, 8) {
        0 => String::new(),
        1 => "```".to_string(),
        2 => format!("    {}", pick(random)),
        _ => (0..1 + below(random, 7)).map(|_| pick(random)).collect(),
    }
}

/// Elements that `rustdoc` would take for more than text.
fn live(markdown: &str) -> Vec<String> {
    // The extensions that `rustdoc` switches on.
    let options = Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_TASKLISTS
        | Options::ENABLE_SMART_PUNCTUATION;
    let mut names = Vec::new();
    let mut elements = Vec::new();
    let mut note = |link: BrokenLink<'_>| {
        names.push(format!("a name: {}", link.reference));
        None
    };
    let (mut links, mut in_block) = (0, false);
    for event in Parser::new_with_broken_link_callback(markdown, options, Some(&mut note)) {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language)))
                if &*language == "text" =>
            {
                in_block = true;
            }
            Event::End(TagEnd::CodeBlock) => in_block = false,
            Event::Start(Tag::Link { dest_url, .. }) if dest_url.starts_with("http") => links += 1,
            Event::End(TagEnd::Link) => links -= 1,
            Event::Start(
                Tag::Link { .. } | Tag::Image { .. } | Tag::CodeBlock(_) | Tag::HtmlBlock,
            )
            | Event::Html(_)
            | Event::InlineHtml(_)
            | Event::FootnoteReference(_) => elements.push(format!("{event:?}")),
            Event::Text(text) if links == 0 && !in_block => {
                let addresses = text.split("http").skip(1);
                let is_bare = |it: &str| {
                    let rest = it.trim_start_matches('s').strip_prefix("://");
                    rest.is_some_and(|it| it.starts_with(|it: char| it.is_ascii_alphanumeric()))
                };
                elements.extend(addresses.filter(|it| is_bare(it)).map(str::to_string));
            }
            _ => {}
        }
    }
    elements.extend(names);
    elements
}

/// Documentation of every point of a module, as `rustdoc` reads it.
fn of_points(code: &str) -> Vec<String> {
    let mut comments = Vec::new();
    let mut lines: Vec<&str> = Vec::new();
    for line in code.lines().map(str::trim_start) {
        match line.strip_prefix("///") {
            Some(text) => lines.push(text.strip_prefix(' ').unwrap_or(text)),
            None => {
                if line.starts_with("pub fn point_") {
                    comments.push(lines.join("\n"));
                }
                lines.clear();
            }
        }
    }
    comments
}

#[test]
fn nothing_in_a_comment_is_more_than_text() {
    const POINTS: usize = 250;
    let mut random = Random::new(20);
    for _ in 0..8 {
        let mut points = String::new();
        let mut written = Vec::new();
        for point in 0..POINTS {
            let lines: Vec<String> = (0..1 + below(&mut random, 6))
                .map(|_| line(&mut random))
                .collect();
            for line in &lines {
                points.push_str(&format!("    /// {line}\n"));
            }
            points.push_str(&format!("    P{point}: (1, 0),\n"));
            written.push(lines.join("\n"));
        }
        let text = format!(
            "mechanism commented {{\nbody 1 at (0, 0) {{\n{points}}}\nabsolute_x(1) = 0;\nabsolute_y(1) = 0;\ndrive phi(1) = t;\n}}\n"
        );
        let source = Source::new("commented.mech", text);
        let generated = generate(&source, &Choices::default())
            .unwrap_or_else(|found| panic!("{}", found.render(&source)));
        let emitted = of_points(generated.code());
        assert_eq!(emitted.len(), POINTS);
        for (written, emitted) in written.iter().zip(&emitted) {
            let elements = live(emitted);
            assert!(
                elements.is_empty(),
                "{elements:?} in\n{emitted}\n\nof\n\n{written}"
            );
        }
    }
}

#[test]
fn live_markup_is_found() {
    for text in [
        "```\na\n```",
        "- ~~~rust\n  a",
        "    a",
        ">     a",
        "[Q]",
        "[`Q`]",
        "[w](x)",
        "a <b> c",
        "<pre>\na",
        "![w](https://a.bc)",
        "see https://a.bc",
    ] {
        assert!(!live(text).is_empty(), "{text}");
    }
    for text in [
        "`[Q]`",
        "```text\n[Q] <T>\n```",
        "\\[Q]",
        "<https://a.bc>",
        "[w](https://a.bc)",
    ] {
        assert!(live(text).is_empty(), "{text}");
    }
}

/// The page beside every module is one block of HTML with elements for pictures and formulas only, and refers to
/// nothing.
#[test]
fn pages_are_one_block_of_harmless_html() {
    const ELEMENTS: &str = "div style svg title rect g path circle text details summary ul li p table thead tbody tr th td h2 code \
        small span math mrow mi mn mo mtext msub msup msubsup mfrac msqrt mover mspace mtable mtr mtd";
    let folder = std::path::Path::new(env!("OUT_DIR")).join("linkwright");
    let pages = files::with_extension(&folder, "md");
    assert!(pages.len() > 100, "{}", pages.len());
    for path in pages {
        let page = std::fs::read_to_string(&path).expect("a page");
        let text = format!("An arm.\n{page}");
        let blocks = Parser::new(&text).filter(|it| matches!(it, Event::Start(_)));
        let blocks: Vec<Event<'_>> = blocks.collect();
        assert!(
            matches!(
                blocks[..],
                [Event::Start(Tag::Paragraph), Event::Start(Tag::HtmlBlock)]
            ),
            "{path:?}: {blocks:?}"
        );
        let mut open = Vec::new();
        for tag in page.split('<').skip(1) {
            let (tag, _) = tag.split_once('>').expect("an end of the tag");
            let name = tag
                .trim_matches('/')
                .split([' ', '\n'])
                .next()
                .expect("a name");
            assert!(ELEMENTS.split_whitespace().any(|it| it == name), "{tag}");
            if let Some(closed) = tag.strip_prefix('/') {
                assert_eq!(open.pop(), Some(closed), "{path:?}");
            } else if !tag.ends_with('/') {
                open.push(name);
            }
            for attribute in ["href", "src", " on", "url("] {
                assert!(!tag.contains(attribute), "{tag}");
            }
        }
        assert!(open.is_empty(), "{path:?}: {open:?}");
        let drawn = page.matches("<svg ").count();
        assert!(
            drawn > 0 && page.matches("</svg>").count() == drawn,
            "{path:?}"
        );
    }
}
