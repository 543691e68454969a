"""Mechanisms of the repository, and the command line as the reference."""

from __future__ import annotations

import csv
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

REPOSITORY = Path(os.environ.get("REPOSITORY", Path(__file__).parents[3]))
COMMAND = Path(os.environ.get("LINKWRIGHT", REPOSITORY / "target/release/linkwright"))

#: A four-bar linkage with a parameter for each link.
FOUR_BAR = """
mechanism four_bar {
    param crank_length = 40mm;
    /// Length of the coupler.
    param rod = 120mm from 80mm to 160mm;
    point A = (0, 0), D = (100mm, 0);
    body crank   at (0, 0, 40deg)       { A: (0, 0), B: (crank_length, 0) }
    body coupler at (30mm, 25mm, 20deg) { B: (0, 0), C: (rod, 0), P: (60mm, 40mm) }
    body rocker  at (100mm, 0, 57deg)   { D: (0, 0), C: (80mm, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 40deg + 3*t;
}
"""

#: A crank that an input turns.
TURNED = """
mechanism turned {
    param length = 40mm;
    input angle = 0.3rad;
    point O = (0, 0);
    body arm at O { O, A: (length, 0) }
    revolute O(ground, arm);
    drive phi(arm) = angle;
}
"""

#: A pendulum of a point mass, 1 m long, from 10°.
PENDULUM = """
mechanism pendulum {
    gravity = (0, -9.81);
    point O = (0, 0);
    body bob at (0, 0, -80deg) { O: (0, 0), C: (1, 0) }
    mass bob = 2kg at C;
    revolute O(ground, bob);
    free swing: phi(bob) = -80deg;
    energy;
}
"""


def command(*arguments: str | Path, folder: Path | None = None) -> str:
    """Return what the command prints, which runs in a folder."""
    called = [COMMAND, *map(str, arguments)]
    finished = subprocess.run(called, capture_output=True, text=True, timeout=120, cwd=folder, check=False)
    # A motion that ends early is no error here.
    assert finished.returncode in (0, 1), finished.stderr
    return finished.stdout


def solved_by_command(folder: Path, *arguments: str | Path) -> dict[str, np.ndarray]:
    """Return the columns of the CSV that the command writes in SI units; NaN for empty cells."""
    target = folder / "motion.csv"
    command(*arguments, "--csv", target, folder=folder)
    with target.open(newline="") as file:
        header, *rows = csv.reader(file)
    table = np.array([[float(cell or "nan") for cell in row] for row in rows])
    return dict(zip(header, table.reshape(len(rows), len(header)).T, strict=False))


@pytest.fixture(scope="session")
def mechanisms() -> Path:
    return REPOSITORY / "mechanisms"
