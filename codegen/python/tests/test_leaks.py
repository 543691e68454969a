"""Memory over many solves."""

from __future__ import annotations

import gc
import os
import sys

import linkwright
import numpy as np
import pytest
from conftest import FOUR_BAR

SOLVES = 100_000


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs Linux")
def test_memory_does_not_grow() -> None:
    m = linkwright.loads(FOUR_BAR)
    t, rod = np.zeros(1), np.full((1, 2), [0.04, 0.12])

    def size() -> int:
        gc.collect()
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def solve(count: int) -> None:
        for _ in range(count):
            m._core.solve_sets(rod, None, t, ["phi_rocker"], (1, None))

    solve(1000)
    references = [sys.getrefcount(it) for it in (t, rod, m._core)]
    before = size()
    solve(SOLVES)
    assert size() - before < 2 << 20
    assert references == [sys.getrefcount(it) for it in (t, rod, m._core)]
    for _ in range(20):
        m.solve(np.linspace(0, 1, 11))
        m(rod=0.13)
    before = size()
    for _ in range(300):
        m.solve(np.linspace(0, 1, 11))
        m(rod=0.13)
    assert size() - before < 4 << 20
