"""Quantities of `measure` statements, against the closed form of a slider-crank."""

from __future__ import annotations

import linkwright
import numpy as np

PRESS = """
mechanism press {
    param r = 30mm;
    param l = 100mm;
    point O = (0, 0);
    body crank at (0, 0, 20deg) { O, A: (r, 0) }
    body rod at (28mm, 10mm, -6deg) { A: (0, 0), B: (l, 0) }
    body ram at (127mm, 0) { B: (0, 0) }
    revolute O(ground, crank);
    revolute A(crank, rod);
    revolute B(rod, ram);
    translational guide(ground, ram) along O -> B;
    drive motor: phi(crank) = 20deg + 4*t;
    force on ram.B = (-200N, 0);
    measure stroke = distance(O, B);
    measure approach = rate(stroke);
    measure pin = magnitude(reaction(B));
}
"""
M = linkwright.loads(PRESS)
T = np.linspace(0.0, 1.5, 301)


def stroke(t: np.ndarray, rod: float) -> np.ndarray:
    phi = np.deg2rad(20.0) + 4.0 * t
    return np.asarray(0.03 * np.cos(phi) + np.sqrt(rod**2 - (0.03 * np.sin(phi)) ** 2))


def test_a_motion_has_its_measures_as_columns() -> None:
    assert {"stroke": "m", "approach": "m/s", "pin": "N"}.items() <= dict(M.measures).items()
    motion = M.solve(T)
    np.testing.assert_allclose(motion.stroke, stroke(T, 0.1), rtol=0, atol=1e-15)
    slant = np.arcsin(0.3 * np.sin(np.deg2rad(20.0) + 4.0 * T))
    np.testing.assert_allclose(motion["pin"], 200.0 / np.cos(slant), rtol=1e-14)
    changes = np.gradient(motion.stroke, T, edge_order=2)
    np.testing.assert_allclose(motion["approach"][1:-1], changes[1:-1], atol=2e-4)


def test_a_batch_returns_measures_of_every_set() -> None:
    rods = np.linspace(0.08, 0.16, 40)
    batch = M.solve(T, {"l": rods}, outputs=["stroke", "pin"])
    expected = np.array([stroke(T, rod) for rod in rods])
    np.testing.assert_allclose(batch["stroke"], expected, rtol=0, atol=1e-15)
    assert batch["pin"].shape == (40, 301)
    one = M(l=float(rods[7])).solve(T)
    np.testing.assert_array_equal(batch["pin"][7], one["pin"])
