//! The study of proofs in short: whatever is proven holds at random instants.

use linkwright_tests::description;
use linkwright_tests::proofs::judged;

/// A closed form, a slide, a torn block and Newton-Raphson with several unknowns.
#[test]
fn exact_solutions_lie_in_what_is_proven() {
    for name in [
        "four_bar",
        "slider_crank",
        "stephenson",
        "platform_3rpr",
        "excavator",
    ] {
        let verdict = judged(&description::system(name), [0.0, 0.5], 10);
        assert!(
            verdict.proof.proven.is_some(),
            "{name}: {:?}",
            verdict.proof.unproven
        );
        assert!(verdict.outside.is_empty(), "{name}: {:?}", verdict.outside);
        assert!(verdict.compared >= 60, "{name}: {}", verdict.compared);
        assert!(verdict.loosest >= 0.5, "{name}: {}", verdict.loosest);
        assert!(verdict.widest <= 0.1, "{name}: {}", verdict.widest);
    }
}
