//! `linkwright_codegen::build` in a package of a user: the generated module compiles and runs without a warning, and
//! mistakes in a description come out as errors with their place.
//!
//! The package `fixtures/user` is copied before it is built, with the lock file of the workspace, so that nothing has to be
//! downloaded and the repository stays as it is.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use linkwright_tests::{files, user_package};

/// A copy of the package in which the description is `description`.
fn copy(name: &str, description: &Path) -> PathBuf {
    let library = files::package("fixtures/user/src/lib.rs");
    copy_with(name, &library, description, "slider_crank.mech")
}

/// A copy of the package with this library, in which the description is `description`, under another name.
fn copy_with(name: &str, library: &Path, description: &Path, description_name: &str) -> PathBuf {
    let (from, to) = (
        files::package("fixtures/user"),
        PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name),
    );
    for folder in ["src", "descriptions"] {
        fs::create_dir_all(to.join(folder)).expect("a folder for the copy");
    }
    let repository = files::repository();
    let manifest = fs::read_to_string(from.join("Cargo.toml")).expect("a manifest");
    // Cargo tells packages of one target folder apart by their names, not by where they lie.
    let manifest = manifest.replace("name = \"user\"", &format!("name = \"{name}\""));
    let manifest = manifest.replace("../../..", repository.to_str().expect("a path in UTF-8"));
    fs::write(to.join("Cargo.toml"), manifest).expect("the copy is writable");
    let lock = repository.join("Cargo.lock");
    let description_name = format!("descriptions/{description_name}");
    for (from, relative) in [
        (lock.as_path(), "Cargo.lock"),
        (&from.join("build.rs"), "build.rs"),
        (library, "src/lib.rs"),
        (description, &description_name),
    ] {
        fs::copy(from, to.join(relative)).expect("the copy is writable");
    }
    to
}

/// Cargo in a package, with a command of several words.
fn cargo(package: &Path, command: &str) -> Output {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("built");
    user_package::cargo(package, &target, command)
}

fn good() -> PathBuf {
    files::package("fixtures/user/descriptions/slider_crank.mech")
}

#[test]
fn a_good_description_compiles_without_a_warning_and_moves() {
    let output = cargo(&copy("user", &good()), "test");
    let printed = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success(),
        "{printed}{}",
        String::from_utf8_lossy(&output.stdout)
    );
    assert!(!printed.contains("warning"), "{printed}");
}

#[test]
fn the_generated_module_is_clean_under_clippy() {
    let output = cargo(&copy("user-clippy", &good()), "clippy");
    let printed = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success() && !printed.contains("warning"),
        "{printed}"
    );
}

#[test]
fn mistakes_in_a_description_are_errors_with_their_place() {
    let output = cargo(
        &copy(
            "user-broken",
            &files::package("fixtures/slider_crank_broken.mech"),
        ),
        "build",
    );
    assert!(!output.status.success(), "the build must stop");
    let printed = String::from_utf8_lossy(&output.stderr).into_owned();
    for expected in [
        "descriptions/slider_crank.mech:11:5",
        "11 |     revolut B(2, 3);",
        "   |     ^^^^^^^",
        "descriptions/slider_crank.mech:12:21",
        "12 |     absolute_y(3) = 30deg;",
        "   |                     ^^^^^",
        "descriptions/slider_crank.mech:15:22",
        "15 |     drive phi(1) = 2*pie*t;",
        "   |                      ^^^",
        "error: 3 errors in descriptions/slider_crank.mech",
    ] {
        assert!(
            printed.contains(expected),
            "`{expected}` is missing in\n{printed}"
        );
    }
    // An error of the description must not look like a crash of the generator.
    assert!(
        !printed.contains("panicked") && !printed.contains("backtrace"),
        "{printed}"
    );
    // A mended description is read without any further step.
    let mended = cargo(&copy("user-broken", &good()), "build");
    assert!(
        mended.status.success(),
        "{}",
        String::from_utf8_lossy(&mended.stderr)
    );
}

/// Cargo runs the build script again when the file of a table changes, because the generator has told it which file that is.
#[test]
fn a_wrong_name_says_which_mechanisms_there_are() {
    let package = copy("user-wrong-name", &good());
    let library = package.join("src/lib.rs");
    let text = fs::read_to_string(&library).expect("the library");
    let wrong = text.replace("slider_crank", "slider_krank");
    assert_ne!(wrong, text);
    fs::write(library, wrong).expect("the copy is writable");
    let output = cargo(&package, "check");
    let printed = String::from_utf8_lossy(&output.stderr).into_owned();
    let expected = "no mechanism is named `slider_krank`: build.rs has generated `slider_crank`";
    assert!(
        !output.status.success() && printed.contains(expected),
        "{printed}"
    );
}

#[test]
fn a_table_that_changes_is_read_again() {
    let written = fs::read_to_string(good()).expect("the description");
    let drive = written.lines().find(|line| line.contains("drive phi(1)"));
    let drive = drive.expect("a driver");
    let tabled = written.replace(
        drive,
        "    table way = \"way.csv\" in (s, rad);\n    drive phi(1) = way(t);",
    );
    let description = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("tabled.mech");
    fs::write(&description, tabled).expect("the description is writable");
    let package = copy("user-table", &description);
    let points = package.join("descriptions/way.csv");
    let build = |content: &str| {
        fs::write(&points, content).expect("the table is writable");
        let output = cargo(&package, "build");
        (
            output.status.success(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    };
    let (built, printed) = build("time, angle\n0, 0\n1, 2\n2, 6\n");
    assert!(built, "{printed}");
    let (built, printed) = build("time, angle\n0, 0\n1, wrong\n2, 6\n");
    assert!(
        !built && printed.contains("way.csv") && printed.contains("wrong"),
        "{printed}"
    );
    let (built, printed) = build("time, angle\n0, 0\n1, 3\n2, 6\n");
    assert!(built, "{printed}");
}

/// The comments of the description hold every form of code, of names in brackets and of tags, at everything that may have a
/// comment: no text of a description is compiled or run, and none is anything to warn of.
#[test]
fn no_comment_of_a_description_is_run_or_warned_of() {
    let description = files::package("fixtures/documented/documented.mech");
    let library = files::package("fixtures/documented/lib.rs");
    let package = copy_with("user-documented", &library, &description, "documented.mech");
    for command in [
        "test --doc",
        "doc --no-deps --document-private-items",
        "clippy",
    ] {
        let output = cargo(&package, command);
        let printed = String::from_utf8_lossy(&output.stderr).into_owned();
        let tests = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{command}: {printed}{tests}");
        assert!(!printed.contains("warning"), "{command}: {printed}");
        if command.starts_with("test") {
            assert!(tests.contains("running 0 tests"), "{tests}");
        }
    }
    // The comments are there, as text.
    let pages = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("built/doc/user_documented");
    for (name, text) in [
        (
            "index.html",
            "<pre class=\"language-text\"><code>panic!(&quot;in a fence&quot;)</code></pre>",
        ),
        ("index.html", "<p>[Q], [<code>T</code>], [crate::nothing]"),
        ("struct.Documented.html", "Vec&lt;T&gt;, &lt;/p&gt;"),
        (
            "struct.Documented.html",
            "<a href=\"https://example.org\">words</a>",
        ),
    ] {
        let page = pages.join("documented/turning").join(name);
        let page = fs::read_to_string(page).expect("the page of a motion");
        assert!(page.contains(text), "{text} is missing in {name}");
    }
    // The page of the module shows both motions.
    let page = fs::read_to_string(pages.join("documented/index.html")).expect("the page");
    for (text, count) in [
        ("<svg ", 2),
        ("How its motion is found: ", 2),
        ("<script>alert", 0),
    ] {
        assert!(page.matches(text).count() >= count, "{text}");
        assert!(count > 0 || !page.contains(text), "{text}");
    }
    assert!(
        page.contains("A crane.") && page.contains("<summary>Block 2. "),
        "{page}"
    );
}
