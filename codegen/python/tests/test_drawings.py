"""The drawings of the command are DXF files in which another reader finds no fault."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import ezdxf
import pytest
from conftest import REPOSITORY, command
from ezdxf.document import Drawing

MECHANISMS = sorted((REPOSITORY / "mechanisms").glob("*.mech"))

#: Motions of the descriptions that have several.
MOTIONS = {"ankle": "to_motors", "differential_wrist": "to_joint", "excavator_motions": "forward"}

#: Mechanisms of angles alone, which have no links.
WITHOUT_LINKS = {"ankle", "differential_wrist"}


def drawn(mechanism: Path, folder: Path, *options: str) -> Drawing:
    """Draw a mechanism, and read the file without a fault."""
    target = folder / f"{mechanism.stem}.dxf"
    motion = MOTIONS.get(mechanism.stem)
    chosen = ["--motion", motion] if motion else []
    command("draw", mechanism, *chosen, *options, "-o", target)
    document = ezdxf.readfile(target)
    audit = document.audit()
    assert not audit.errors and not audit.fixes, [it.message for it in audit.errors + audit.fixes]
    assert document.dxfversion == "AC1015"
    assert document.header["$INSUNITS"] == 4
    return document


@pytest.mark.parametrize("options", [(), ("--links",)])
def test_every_mechanism_is_read_without_a_fault(tmp_path: Path, options: tuple[str, ...]) -> None:
    for mechanism in MECHANISMS:
        if options and mechanism.stem in WITHOUT_LINKS:
            continue
        document = drawn(mechanism, tmp_path, *options)
        space = document.modelspace()
        assert len(space) > 5, mechanism
        for dimension in space.query("DIMENSION"):
            # The value of the reader, the written one, and the text of the block agree.
            measured = dimension.get_measurement()
            assert measured == pytest.approx(dimension.dxf.actual_measurement, rel=1e-9, abs=1e-9)
            (text,) = dimension.get_geometry_block().query("TEXT")
            assert float(text.dxf.text.removeprefix("%%c")) == pytest.approx(measured, abs=5.1e-3)


def test_pins_lie_where_the_motion_is(tmp_path: Path) -> None:
    mechanism = REPOSITORY / "mechanisms/four_bar.mech"
    space = drawn(mechanism, tmp_path, "--at", "0.5").modelspace()
    centers = [(it.dxf.center.x, it.dxf.center.y) for it in space.query('CIRCLE[layer=="PINS"]')]
    solved = json.loads(command("solve", mechanism, "--at", "0.5", "--points", "B,C", "--units=mm", "--json"))
    points = solved["frames"][-1]["points"]
    for name in ("B", "C"):
        x, y = points[name]["position"]
        assert min(max(abs(a - x), abs(b - y)) for a, b in centers) < 1e-6, name


def test_links_do_not_overlap(tmp_path: Path) -> None:
    space = drawn(REPOSITORY / "mechanisms/excavator.mech", tmp_path, "--links").modelspace()
    boxes = {}
    for shape in space.query('LWPOLYLINE[layer ? "BODY_.*"]'):
        points = [point[:2] for point in shape.get_points()]
        low, high = boxes.get(shape.dxf.layer, (points[0], points[0]))
        columns = list(zip(*points, low, high, strict=True))
        boxes[shape.dxf.layer] = tuple(map(min, columns)), tuple(map(max, columns))
    assert len(boxes) == 10
    for (_, (low, high)), (_, (other_low, other_high)) in itertools.combinations(boxes.items(), 2):
        assert any(high[axis] < other_low[axis] or other_high[axis] < low[axis] for axis in (0, 1))
