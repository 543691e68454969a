//! Fills the built playground with a mechanism: a page that solves it anew when a value is changed.

use serde::Serialize;

use crate::question::Question;

/// Element of the built page that holds what it starts with.
const START: [&str; 2] = [
    "<script type=\"application/json\" id=\"start\">",
    "</script>",
];

/// First state of a page.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Start<'a> {
    #[serde(flatten)]
    question: &'a Question,
    /// True if the description is hidden at first.
    is_page: bool,
}

/// Returns the built page `playground` with a question inside: description, values, assembly and times; `None` for another page.
pub fn live(playground: &str, question: &Question) -> Option<String> {
    let (before, rest) = playground.split_once(START[0])?;
    let (_, after) = rest.split_once(START[1])?;
    let start = Start {
        question,
        is_page: true,
    };
    // No text of the description ends the element.
    let start = serde_json::to_string(&start).ok()?.replace('<', "\\u003c");
    let [open, close] = START;
    Some(format!("{before}{open}{start}{close}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_description_cannot_leave_its_element() {
        let page = format!("<p>{}null{}</p>", START[0], START[1]);
        let text = "// </script><script>alert(1)</script>".to_string();
        let question = Question {
            text: text.clone(),
            ..Question::default()
        };
        let filled = live(&page, &question).expect("a page");
        assert_eq!(filled.matches("</script").count(), 1, "{filled}");
        let inside = &filled[3 + START[0].len()..filled.len() - 4 - START[1].len()];
        let read: serde_json::Value = serde_json::from_str(inside).expect("JSON");
        assert_eq!(
            (&read["text"], &read["isPage"]),
            (&text.into(), &true.into())
        );
        assert_eq!(live("<p></p>", &question), None);
    }
}
