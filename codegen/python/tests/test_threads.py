"""Several threads of Python solve one mechanism at once, with the bits of one after another."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import linkwright
import numpy as np
import pytest
from conftest import FOUR_BAR, PENDULUM

T = np.linspace(0, 2, 201)
THREADS = 4

#: Calls on one shared mechanism by the number of their turn, each with an array as its result.
CALLS: dict[str, Callable[[linkwright.Mechanism, int], np.ndarray]] = {
    "solve": lambda m, turn: m.solve(T + 0.01 * turn).values,
    "batch": lambda m, turn: m.solve(T, {"rod": np.linspace(0.1, 0.14, 33 + turn)}, outputs=["P"], threads=2).values,
    "changed": lambda m, turn: m(rod=0.1 + 0.002 * turn).solve(T).values,
    "sensitivity": lambda m, turn: m.sensitivity(T + 0.01 * turn, "rod")["phi_rocker", "rod"],
    "jacobian": lambda m, turn: m.jacobian(t=0.1 * turn),
    "fit": lambda m, turn: m.calibrate({"t": T, "P_x": m(rod=0.121).solve(T).P_x}, "rod").residuals["P_x"],
}


@pytest.mark.parametrize("call", list(CALLS))
def test_threads_that_share_a_mechanism_have_the_bits_of_one(call: str) -> None:
    m, function = linkwright.loads(FOUR_BAR), CALLS[call]
    turns = range(4 * THREADS)
    serial = [function(m, turn) for turn in turns]
    barrier = Barrier(THREADS)

    def work(first: int) -> list[np.ndarray]:
        # All begin at once.
        barrier.wait(timeout=60)
        return [function(m, turn) for turn in turns[first::THREADS]]

    with ThreadPoolExecutor(THREADS) as pool:
        parts = list(pool.map(work, range(THREADS)))
    for first, part in enumerate(parts):
        for turn, values in zip(turns[first::THREADS], part, strict=True):
            assert values.tobytes() == serial[turn].tobytes(), turn


def test_threads_that_share_a_pendulum_have_the_bits_of_one() -> None:
    m = linkwright.loads(PENDULUM)
    serial = m.simulate(T).values
    with ThreadPoolExecutor(THREADS) as pool:
        together = list(pool.map(lambda _: m.simulate(T).values, range(THREADS)))
    assert all(it.tobytes() == serial.tobytes() for it in together)


@pytest.mark.skipif(not sysconfig.get_config_var("Py_GIL_DISABLED"), reason="this interpreter has its lock")
def test_the_import_leaves_the_lock_off() -> None:
    # Without the variable, a module that is not marked as safe would turn the lock on.
    environment = {name: it for name, it in os.environ.items() if name != "PYTHON_GIL"}
    program = "import sys, linkwright; sys.exit(sys._is_gil_enabled())"
    finished = subprocess.run([sys.executable, "-W", "error", "-c", program], env=environment, timeout=120, check=False)
    assert finished.returncode == 0
