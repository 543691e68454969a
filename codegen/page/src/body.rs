//! Writes the elements of a page, filled or empty: scripts find them by their names.

use super::sections::Section;

/// Contents of the elements of a page, as HTML.
#[derive(Default)]
pub struct Body<'a> {
    /// Title of the mechanism.
    pub title: &'a str,
    /// First paragraph of its documentation.
    pub lead: &'a str,
    /// Drawing.
    pub drawing: &'a str,
    /// Errors and warnings.
    pub messages: &'a str,
    /// Quantities whose curves are displayed first.
    pub requested: &'a str,
    /// Sections of text.
    pub sections: &'a [Section],
    /// True for a part of a document that has its own main element.
    pub is_part: bool,
}

impl Body<'_> {
    /// Returns the elements of the page.
    pub fn text(&self) -> String {
        let contents: String = self.sections.iter().map(link).collect();
        let text: String = self.sections.iter().map(Section::element).collect();
        let Body {
            title,
            lead,
            drawing,
            messages,
            requested,
            ..
        } = self;
        let element = if self.is_part { "div" } else { "main" };
        let (controls, curves) = (include_str!("controls.html"), include_str!("curves.html"));
        format!(
            "<div class=\"page\" data-page=\"\">\n<{element} class=\"layout\">\n<header><h1>{title}</h1>\n<div data-part=\"lead\">{lead}</div>\
             <nav aria-label=\"Contents\"><a href=\"#plots\">Curves</a> {contents}</nav></header>\n\
             <div class=\"stage\">\n<figure class=\"drawing\" data-part=\"drawing\">{drawing}</figure>\n\
             <div class=\"messages\" data-part=\"messages\" role=\"status\">\n{messages}</div>\n{controls}</div>\n\
             <section class=\"plots\" id=\"plots\" data-part=\"plots\" data-requested=\"{requested}\" aria-labelledby=\"curves\">\n\
             <h2 id=\"curves\">Curves</h2>\n{curves}</section>\n\
             <article>\n{text}</article>\n</{element}>\n</div>\n"
        )
    }
}

/// Returns the elements of a page without a mechanism, which scripts fill with an answer.
pub fn skeleton() -> String {
    Body {
        sections: &Section::all_empty(),
        is_part: true,
        ..Body::default()
    }
    .text()
}

/// Returns the link to a section.
fn link(section: &Section) -> String {
    let hidden = match section.html.is_empty() {
        true => " hidden",
        false => "",
    };
    format!("<a href=\"#{}\"{hidden}>{}</a> ", section.id, section.name)
}
