"""Messages for wrong descriptions and files."""

from __future__ import annotations

import os
from pathlib import Path

import linkwright
import pytest
from conftest import FOUR_BAR, REPOSITORY


def test_an_error_has_its_place_and_the_text_of_the_command(tmp_path: Path) -> None:
    path = tmp_path / "broken.mech"
    path.write_text(FOUR_BAR.replace("revolute C(coupler, rocker)", "revolute C(couple, rocker)"))
    with pytest.raises(linkwright.DescriptionError) as caught:
        linkwright.load(path)
    error = caught.value
    line = next(place for place, it in enumerate(path.read_text().splitlines(), 1) if "couple," in it)
    assert error.line == line and error.column > 0 and error.code.startswith("K")
    assert "did you mean `coupler`" in str(error)
    assert isinstance(error, ValueError)


def test_other_reasons_are_sentences(tmp_path: Path) -> None:
    with pytest.raises(linkwright.DescriptionError, match="K32"):
        linkwright.loads(FOUR_BAR.replace("drive phi(crank) = 40deg + 3*t;", ""))
    motions = REPOSITORY / "mechanisms/excavator_motions.mech"
    with pytest.raises(linkwright.DescriptionError, match=r"has \d motions"):
        linkwright.load(motions)
    with pytest.raises(linkwright.DescriptionError, match="no motion is named"):
        linkwright.load(motions, motion="flying")
    with pytest.raises(OSError, match="cannot read"):
        linkwright.load(tmp_path / "none.mech")
    (tmp_path / "binary.mech").write_bytes(b"\xff\xfe")
    with pytest.raises(linkwright.DescriptionError, match="UTF-8"):
        linkwright.load(tmp_path / "binary.mech")
    with pytest.raises(linkwright.DescriptionError, match="table"):
        linkwright.loads('mechanism x { table lift = file "none.csv"; }')


@pytest.mark.parametrize("name", ["\0", "a" * 5000, "ä\u202e", "'); import os"])
def test_hostile_texts_are_errors(name: str) -> None:
    with pytest.raises((linkwright.DescriptionError, ValueError)):
        linkwright.loads(name)
    with pytest.raises((linkwright.DescriptionError, ValueError)):
        linkwright.loads(f"mechanism {name} {{ body {name} }}")


def test_the_library_names_no_path_of_the_machine_that_built_it() -> None:
    library = Path(linkwright._core.__file__).read_bytes()
    for path in {str(REPOSITORY), os.path.expanduser("~"), os.environ.get("CARGO_HOME", "/root/.cargo")}:
        assert path.encode() not in library, path
