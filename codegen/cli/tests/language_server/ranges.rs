//! Ranges of parameters and inputs in an editor.

use serde_json::json;

use crate::client::UNSAVED;
use crate::completion::offered;
use crate::editing::{hover, opened, place};
use crate::renaming::renamed;

/// A description with ranges whose ends have names.
const LIMITED: &str = "\
mechanism lift {
    const least = 80mm;
    const longest = 2*least;
    param rod = 120mm from least to longest;
    input angle = 10deg from -90deg to 90deg;
    body 1 at (0, 0) { P: (rod, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = angle;
}
";

#[test]
fn names_in_ranges_are_described_found_and_renamed() {
    let mut client = opened(LIMITED);
    assert_eq!(
        hover(&mut client, LIMITED, "rod =", 0),
        "```mech\nparam rod = 120mm from least to longest;\n```\n\nparameter = 0.12 m unless it is set; from 0.08 m to 0.16 m"
    );
    assert!(hover(&mut client, LIMITED, "angle =", 0).ends_with(
        "constant unless it is supplied; from -1.5707963267949 rad to 1.5707963267949 rad"
    ));
    let definition = client.ask_at("definition", UNSAVED, place(LIMITED, "longest;", 0));
    let definition = definition.expect("an answer");
    assert_eq!(
        definition[0]["range"]["start"],
        json!({ "line": 2, "character": 10 })
    );
    let expected = LIMITED.replace("least", "shortest");
    let new = renamed(&mut client, LIMITED, "least to", "shortest");
    assert_eq!(new, Ok(expected));
    client.finish();
}

#[test]
fn the_words_of_a_range_are_offered() {
    for begun in ["param a = 1m f|", "input a = 1m from 0m t|"] {
        let text = LIMITED.replace("    body 1", &format!("    {begun};\n    body 1"));
        let offered = offered(&text);
        for word in ["from", "to", "least"] {
            assert!(offered.iter().any(|it| it == word), "{begun}: {offered:?}");
        }
    }
}
