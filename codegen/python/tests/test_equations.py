"""Equations that others can check."""

from __future__ import annotations

from pathlib import Path

import linkwright
import numpy as np
import pytest
from conftest import FOUR_BAR

sympy = pytest.importorskip("sympy")


@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "two_body", "excavator", "disc_cam"])
def test_sympy_derives_the_same(name: str, mechanisms: Path) -> None:
    """Φ_q, Φ_t and γ are what SymPy derives from Φ, and all have the values of the solver."""
    m = linkwright.load(mechanisms / f"{name}.mech")
    equations = m.to_sympy()
    rng = np.random.default_rng(7)
    count = len(m.coordinates)
    q, qd, t = rng.uniform(0.1, 1, count), rng.uniform(-1, 1, count), 0.37
    symbols = [*equations.coordinates, *equations.rates, equations.t]
    nominal = {equations.symbols[key]: it.value for key, it in m.parameters.items() if key in equations.symbols}

    def value(matrix: object) -> np.ndarray:
        function = sympy.lambdify(symbols, matrix.subs(nominal), "numpy")
        return np.array(function(*q, *qd, t), dtype=float)

    phi = equations.residual
    jacobian = phi.jacobian(equations.coordinates)
    np.testing.assert_allclose(value(jacobian), m.jacobian(q, t), atol=1e-12)
    np.testing.assert_allclose(value(equations.jacobian), m.jacobian(q, t), atol=1e-12)
    time = phi.diff(equations.t)
    np.testing.assert_allclose(value(time)[:, 0], m.time_derivative(q, t), atol=1e-12)
    np.testing.assert_allclose(value(equations.time_derivative), value(time), atol=1e-12)
    rates = sympy.Matrix(equations.rates)
    # Haug 1989, equation 3.6.11.
    gamma = -((jacobian * rates).jacobian(equations.coordinates) * rates)
    gamma -= 2 * time.jacobian(equations.coordinates) * rates + phi.diff(equations.t, 2)
    np.testing.assert_allclose(value(gamma)[:, 0], m.gamma(q, qd, t), atol=1e-10)
    np.testing.assert_allclose(value(equations.gamma), value(gamma), atol=1e-10)
    np.testing.assert_allclose(value(phi)[:, 0], m.residual(q, t), atol=1e-12)


def test_a_solved_motion_satisfies_the_equations() -> None:
    m = linkwright.loads(FOUR_BAR)
    motion = m.solve([0.3])
    q, qd, qdd = (np.array([motion[f"{it}{end}"][0] for it in m.coordinates]) for end in ("", "_d", "_dd"))
    np.testing.assert_allclose(m.residual(q, 0.3), 0, atol=1e-15)
    np.testing.assert_allclose(m.jacobian(q, 0.3) @ qd, -m.time_derivative(q, 0.3), atol=1e-14)
    np.testing.assert_allclose(m.jacobian(q, 0.3) @ qdd, m.gamma(q, qd, 0.3), atol=1e-13)
    with pytest.raises(ValueError, match="2 numbers for 9"):
        m.jacobian([0.0, 1.0])
