//! Every description is compiled, and the shared list of modules is complete.

use linkwright_tests::description;
use linkwright_tests::generated::MODULES;

#[test]
fn every_description_has_a_module_with_its_points() {
    let mut listed: Vec<&str> = MODULES.iter().map(|module| module.name).collect();
    listed.sort_unstable();
    assert_eq!(listed, description::whole());
    for module in MODULES {
        let derived = description::system(module.name);
        let points: Vec<&str> = derived
            .system
            .outputs
            .iter()
            .map(|output| output.name.as_str())
            .collect();
        assert_eq!(points, (module.points)(), "{}", module.name);
    }
}

#[test]
fn a_file_describes_the_mechanism_it_is_named_after() {
    for name in description::names() {
        for derived in description::motions(&name) {
            assert_eq!(derived.system.mechanism.name, name);
        }
    }
}
