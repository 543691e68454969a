"""Batches of any shape, and of wrong ones."""

from __future__ import annotations

import csv
import io
import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import linkwright
import numpy as np
import pytest
from conftest import FOUR_BAR, PENDULUM, TURNED, command
from hypothesis import given, settings
from hypothesis import strategies as st

M = linkwright.loads(FOUR_BAR)
T = np.linspace(0.0, 0.5, 6)


@settings(max_examples=60, deadline=None)
@given(
    rods=st.lists(
        st.one_of(
            st.floats(0.08, 0.16),
            st.floats(allow_nan=True, allow_infinity=True),
        ),
        max_size=40,
    ),
    dtype=st.sampled_from(["f8", "f4", ">f8", "i8", "O"]),
    stride=st.sampled_from([1, 2, -1]),
    threads=st.integers(1, 4),
)
def test_rows_depend_on_themselves_alone(rods: list[float], dtype: str, stride: int, threads: int) -> None:
    if dtype == "i8":
        rods = [it for it in rods if abs(it) < 1e9]
    with np.errstate(over="ignore"):
        given_values = np.array(rods, dtype=dtype)[::stride]
        values = given_values.astype("f8")
    batch = M.solve(T, {"rod": given_values}, outputs=["phi_rocker", "P"], threads=threads)
    assert batch["phi_rocker"].shape == (len(values), len(T))
    assert batch["P"].shape == (len(values), len(T), 2)
    good = (values >= 0.08) & (values <= 0.16)
    assert (batch.failure_kind[~good] != "").all()
    assert np.isnan(batch.values[batch.failed & (batch.solved == 0)]).all()
    for row, value in enumerate(values):
        alone = M.solve(T, {"rod": [value]}, outputs=["phi_rocker", "P"], threads=1)
        np.testing.assert_array_equal(batch.values[row], alone.values[0])
        assert batch.failure_kind[row] == alone.failure_kind[0]
        assert batch.solved[row] == alone.solved[0]


@given(count=st.integers(0, 5), sets=st.integers(0, 5))
@settings(max_examples=20, deadline=None)
def test_empty_shapes(count: int, sets: int) -> None:
    batch = M.solve(np.arange(count) / 10, {"rod": np.full(sets, 0.12)})
    # One set is meant by one value, none by none.
    assert batch.values.shape == (sets, count, len(M.quantities))
    assert len(batch) == sets and batch.failed.sum() == 0


def test_a_large_batch_on_two_threads() -> None:
    rods = np.linspace(0.08, 0.16, 20_000)
    one = M.solve(T, {"rod": rods}, outputs=["phi_rocker"], threads=1)
    two = M.solve(T, {"rod": rods}, outputs=["phi_rocker"], threads=2)
    np.testing.assert_array_equal(one.values, two.values)


def test_wrong_arguments_are_named() -> None:
    cases = [
        ({"values": {"rodd": [1.0]}}, "did you mean 'rod'"),
        ({"values": {"rod": [[1.0]]}}, "2 dimensions"),
        ({"values": {"rod": [0.1, 0.12], "crank_length": [0.04] * 3}}, "different numbers of sets"),
        ({"values": {}, "outputs": ["phi_roker"]}, "did you mean 'phi_rocker'"),
        ({"values": {}, "threads": 0}, "at least one"),
        ({"values": {}, "start": np.nan}, "start is nan"),
        ({"step": -1.0}, "step is -1.0"),
        ({"values": {}, "inputs": {"x": 1.0}}, "no input is named"),
    ]
    for arguments, message in cases:
        with pytest.raises(ValueError, match=message):
            M.solve(T, **arguments)
    with pytest.raises(ValueError, match="not a finite time"):
        M.solve([0.0, np.nan])
    with pytest.raises(ValueError, match="2 dimensions"):
        M.solve([[0.0]])
    with pytest.raises(TypeError, match="complex"):
        M.solve(T, {"rod": [0.12 + 1j]})
    with pytest.raises(ValueError, match="rod is nan"):
        M(rod=np.nan)
    with pytest.raises(ValueError):
        M.solve(T, {"rod": ["long"]})
    turned = linkwright.loads(TURNED)
    with pytest.raises(ValueError, match="3 values for 6 instants"):
        turned.solve(T, inputs={"angle": np.zeros((1, 3))})
    with pytest.raises(ValueError, match="give inputs by"):
        turned.solve(T, {"angle": [0.1]})


def test_failures_of_rows() -> None:
    rods = np.array([0.12, 0.0805, np.nan, 0.5])
    batch = M(crank_length=0.0999).solve(np.linspace(0, 2, 101), {"rod": rods})
    kinds = list(batch.failure_kind)
    assert kinds[2] == "not_finite" and kinds[3] == "outside_range"
    assert kinds[1] in ("out_of_reach", "singular") and 0 < batch.solved[1] < 101
    assert np.isfinite(batch.failure_time[1]) and batch.failure_block[1] >= 0
    with pytest.warns(linkwright.MotionWarning):
        alone = M(crank_length=0.0999, rod=0.0805).solve(np.linspace(0, 2, 101))
    assert alone.failed is not None
    assert (alone.failed.kind, alone.failed.time) == (kinds[1], batch.failure_time[1])


def test_the_interpreter_is_released() -> None:
    """Another thread counts while a batch is solved."""
    counted = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(1e-4)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    M.solve(np.linspace(0, 2, 400), {"rod": np.linspace(0.08, 0.16, 4000)}, threads=1)
    during = counted - before
    stop.set()
    thread.join()
    assert during > 10


def test_progress_is_reported() -> None:
    seen: list[tuple[int, int]] = []
    M.solve(T, {"rod": np.full(300, 0.12)}, progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (300, 300)


def test_an_exception_of_the_progress_ends_the_batch() -> None:
    def fail(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        M.solve(T, {"rod": np.full(300, 0.12)}, progress=fail)


def swept_by_command(folder: Path, *arguments: str) -> list[dict[str, str]]:
    """Return the rows of the table of `linkwright sweep`."""
    (folder / "four_bar.mech").write_text(FOUR_BAR)
    shared = ["--to", "0.5", "--step", "0.1", "--show", "phi_rocker", "--csv", "-"]
    printed = command("sweep", "four_bar.mech", *arguments, *shared, folder=folder)
    rows = csv.DictReader(io.StringIO(printed))
    return [{name.split(" (")[0]: cell for name, cell in row.items()} for row in rows]


@pytest.mark.parametrize(
    ("arguments", "ranges", "choices"),
    [
        (
            ["--vary", "rod=0.1..0.14:7", "--vary", "crank_length=0.03..0.05:4"],
            {"rod": (0.1, 0.14, 7), "crank_length": (0.03, 0.05, 4)},
            {},
        ),
        (["--vary", "rod:5"], {"rod": 5}, {}),
        (
            ["--vary", "rod=0.1..0.14", "--vary", "crank_length=0.03..0.05", "--samples", "16", "--seed", "7"],
            {"rod": (0.1, 0.14), "crank_length": (0.03, 0.05)},
            {"samples": 16, "seed": 7},
        ),
    ],
)
def test_a_sweep_is_that_of_the_command(
    arguments: list[str], ranges: dict[str, Any], choices: dict[str, Any], tmp_path: Path
) -> None:
    table = swept_by_command(tmp_path, *arguments)
    batch = M.sweep(T, ranges, outputs=["phi_rocker"], **choices)
    assert len(table) == len(batch)
    extremes = batch.extremes("phi_rocker")
    for place, row in enumerate(table):
        for name in ranges:
            assert float(row[name]) == batch.parameters[name][place]
        assert row["failure_kind"] == batch.failure_kind[place]
        if row["failure"]:
            assert batch.failed[place]
            continue
        for column, values in {
            "phi_rocker_min": extremes.minimum,
            "phi_rocker_min_t": extremes.minimum_time,
            "phi_rocker_max": extremes.maximum,
            "phi_rocker_max_t": extremes.maximum_time,
        }.items():
            assert float(row[column]) == values[place], column


def test_wrong_ranges_are_named() -> None:
    with pytest.raises(ValueError, match="no range in the description"):
        M.sweep(T, {"crank_length": 5})
    with pytest.raises(ValueError, match="two ends and a number"):
        M.sweep(T, {"rod": (0.1, 0.12)})
    with pytest.raises(ValueError, match="two ends"):
        M.sweep(T, {"rod": (0.1, 0.12, 4)}, samples=3)
    with pytest.raises(ValueError, match="negative"):
        M.sweep(T, {"rod": (0.1, 0.12, -3)})
    with pytest.raises(TypeError, match="did you mean 'rod'"):
        M.sweep(T, {"rodd": 5})


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Python's own handler: a shell starts jobs in the background with this signal ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_a_motion_and_a_simulation() -> None:
    pendulum = linkwright.loads(PENDULUM)
    for work in (
        lambda: M.solve(np.linspace(0, 1e4, 3_000_000)),
        lambda: pendulum.simulate([1e5]),
    ):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        begun = time.monotonic()
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            work()
        assert time.monotonic() - begun < 3
