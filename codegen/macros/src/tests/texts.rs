//! The text written from tokens equals the original text.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::{Options, generate};
use proc_macro2::TokenStream;

use super::{descriptions, displaced, tokens};
use crate::head::Head;
use crate::tokens::flat;
use crate::written::Written;

/// Module of a description.
fn module(source: &Source) -> String {
    match generate(source, &Options::default()) {
        Ok(generated) => generated.code().to_string(),
        Err(errors) => panic!("{}", errors.render(source)),
    }
}

/// Line without the comment that ends it, if that documents nothing, and without trailing blanks.
fn without_comment(line: &str) -> &str {
    let documents = |it: &str| it.starts_with("///") || it.starts_with("//!");
    match line.find("//").filter(|&at| !documents(&line[at..])) {
        Some(at) => line[..at].trim_end(),
        None => line.trim_end(),
    }
}

#[test]
fn the_tokens_of_a_description_say_what_its_text_says() {
    let folders = ["mechanisms", "tests/descriptions", "tests/fixtures/plans"];
    let mut count = 0;
    for source in folders.into_iter().flat_map(descriptions) {
        let stream: TokenStream = source.text.parse().expect("tokens");
        let as_written = Written::of(&tokens(&source.text).expect("tokens")).text;
        let blanks = Written::of(&flat(Head::read(displaced(stream)).description)).text;
        assert_ne!(as_written, blanks);
        let expected = module(&source);
        for text in [as_written, blanks] {
            let rebuilt = Source {
                text,
                ..source.clone()
            };
            assert!(
                module(&rebuilt) == expected,
                "{} means something else:\n{}",
                source.name,
                rebuilt.text
            );
        }
        count += 1;
    }
    assert!(count > 70, "{count} descriptions");
}

#[test]
fn lines_and_columns_are_those_that_are_written() {
    for source in descriptions("mechanisms") {
        let text = Written::of(&tokens(&source.text).expect("tokens")).text;
        let is_blank = |line: &&str| line.is_empty();
        let written = source.text.lines().map(without_comment);
        let mut written: Vec<&str> = written.skip_while(is_blank).collect();
        while written.last().is_some_and(|line| line.is_empty()) {
            written.pop();
        }
        let rebuilt: Vec<&str> = text.lines().map(str::trim_end).collect();
        assert_eq!(rebuilt, written, "{}", source.name);
    }
}

#[test]
fn adjacent_and_separate_tokens_stay_so() {
    for text in [
        "mechanism a { x = 1.P; }",
        "mechanism a{drive   d:a.x=30deg+1e-3mm*2^-1->b;}",
        "a -> b - > c",
        "/// One.\n///\n/// Two.\nmechanism a { }",
        "/** One.\n * Two. */ mechanism a { /*! in */ }",
        "    //! \"quoted\" \\ ' \u{e9}\n    a",
    ] {
        let written = Written::of(&tokens(text).expect("tokens")).text;
        assert_eq!(written, text.trim_end());
    }
    for (attribute, comment) in [
        (
            r##"#[doc = "a */ b"] mechanism a { }"##,
            "///a */ b\nmechanism a { }",
        ),
        (
            r##"#[doc = r"/a"] mechanism a { }"##,
            "/// /a\nmechanism a { }",
        ),
        (
            r##"#![doc = "a */\nb"] mechanism a { }"##,
            "/*! a * /\nb */ mechanism a { }",
        ),
    ] {
        let written = Written::of(&tokens(attribute).expect("tokens")).text;
        assert_eq!(written, comment);
    }
}
