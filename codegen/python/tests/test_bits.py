"""Motions have the bits of the command line."""

from __future__ import annotations

import re
from pathlib import Path

import linkwright
import numpy as np
import pytest
from conftest import REPOSITORY, solved_by_command

FILES = sorted((REPOSITORY / "mechanisms").glob("*.mech"))


def motions(path: Path) -> list[str | None]:
    names = re.findall(r"^\s*motion (\w+)", path.read_text(), re.MULTILINE)
    return names or [None]


CASES = [(path, name) for path in FILES for name in motions(path)]


@pytest.mark.parametrize(("path", "name"), CASES, ids=lambda it: getattr(it, "stem", str(it)))
@pytest.mark.filterwarnings("ignore::linkwright.MotionWarning")
def test_columns_have_the_bits_of_the_command(path: Path, name: str | None, tmp_path: Path) -> None:
    m = linkwright.load(path, motion=name)
    chosen = ["--motion", name] if name else []
    verb = "simulate" if m._core.is_free else "solve"
    table = solved_by_command(tmp_path, verb, path, *chosen, "--to", "0.5", "--step", "0.05")
    t = table.pop("t")
    assert len(t) == 11
    motion = m.simulate(t) if verb == "simulate" else m.solve(t)
    names = [it.split(" (")[0] for it in table]
    if verb == "simulate":
        # The command adds the energies.
        names = [it for it in names if it in motion]
    else:
        assert names == list(motion.names)
    if all(" (" not in it for it in table):
        for column in names:
            np.testing.assert_array_equal(motion[column], table[column], err_msg=column)


def test_a_batch_has_the_bits_of_a_motion(mechanisms: Path) -> None:
    for name in ("four_bar", "excavator", "jansen", "stephenson", "platform_3rpr"):
        m = linkwright.load(mechanisms / f"{name}.mech")
        t = np.linspace(0.0, 0.5, 26)
        batch, motion = m.solve(t, {}), m.solve(t)
        for column in batch.names:
            np.testing.assert_array_equal(batch[column][0], motion[column], err_msg=column)


def test_a_changed_value_has_the_bits_of_a_batch_with_it(tmp_path: Path) -> None:
    from conftest import FOUR_BAR

    m = linkwright.loads(FOUR_BAR)
    t = np.linspace(0.0, 1.0, 21)
    rods = np.array([0.1, 0.12, 0.127])
    batch = m.solve(t, {"rod": rods})
    path = tmp_path / "four_bar.mech"
    path.write_text(FOUR_BAR)
    for place, rod in enumerate(rods):
        motion = m(rod=rod).solve(t)
        for column in batch.names:
            np.testing.assert_array_equal(batch[column][place], motion[column], err_msg=column)
        table = solved_by_command(
            tmp_path, "solve", path, "--set", f"rod={float(rod)!r}", "--to", "1", "--step", "0.05"
        )
        times = table["t"]
        again = m(rod=float(rod)).solve(times)
        np.testing.assert_array_equal(again.phi_rocker, table["phi_rocker"])
