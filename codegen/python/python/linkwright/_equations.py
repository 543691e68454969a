"""Equations of a mechanism."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from linkwright._mechanism import Mechanism


class Equations:
    """Equations of a mechanism and the derivation of their solution, as text.

    Attributes
    ----------
    text, unicode : str
        Φ, Φ_q, Φ_t and γ in plain text, with ASCII or with Greek letters and signs of mathematics.
    latex : str
        The same as LaTeX without a preamble; it needs amsmath.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self._core = mechanism._core

    @property
    def text(self) -> str:
        return self._core.equations_as("text")

    @property
    def unicode(self) -> str:
        return self._core.equations_as("unicode")

    @property
    def latex(self) -> str:
        return self._core.equations_as("latex")

    def derivation(self, form: str = "text") -> str:
        """Return the solution, block by block, as a textbook would derive it.

        Parameters
        ----------
        form : {"text", "unicode", "latex", "fragment", "html"}
            Plain text, text with signs of mathematics, a document of LaTeX, the same without a preamble, or HTML with MathML.
        """
        if form not in ("text", "unicode", "latex", "fragment", "html"):
            raise ValueError(f"a derivation has no form {form!r}")
        return self._core.derivation_as(form)

    def __str__(self) -> str:
        return self.unicode

    def _repr_html_(self) -> str:
        return self.derivation("html")


@dataclass(frozen=True)
class SymbolicEquations:
    """Φ, Φ_q, Φ_t and γ as matrices of SymPy.

    Attributes
    ----------
    residual, time_derivative, gamma : sympy.Matrix, (n, 1)
        Φ, Φ_t and γ.
    jacobian : sympy.Matrix, (n, n)
        Φ_q.
    coordinates, rates : tuple of sympy.Symbol
        Symbols of q and q̇, in the order of the columns.
    parameters, inputs : dict of str to sympy.Symbol
        Symbols of parameters and of inputs (value, ``…_rate``, ``…_acceleration``).
    t : sympy.Symbol
        Time.
    """

    residual: Any
    jacobian: Any
    time_derivative: Any
    gamma: Any
    coordinates: tuple[Any, ...]
    rates: tuple[Any, ...]
    symbols: dict[str, Any]
    t: Any


def symbolic(mechanism: Mechanism) -> SymbolicEquations:
    """Return the equations as matrices of SymPy."""
    import sympy

    nodes, residual, entries, time_derivative, gamma = mechanism._core.expressions()
    symbols: dict[str, Any] = {}
    built: list[Any] = []
    functions = {
        "sin": sympy.sin,
        "cos": sympy.cos,
        "atan2": sympy.atan2,
        "exp": sympy.exp,
        "log": sympy.log,
        "floor": sympy.floor,
    }
    for operation, text, places in nodes:
        operands = [built[it] for it in places]
        if operation == "symbol":
            node = symbols.setdefault(text, sympy.Symbol(text, real=True))
        elif operation == "number":
            node = sympy.Rational(text) if "/" in text else sympy.Float(text)
        elif operation == "root":
            node = sympy.sqrt(sympy.Integer(text))
        elif operation == "pi":
            node = sympy.pi
        elif operation == "sum":
            node = sympy.Add(*operands)
        elif operation == "product":
            node = sympy.Mul(*operands)
        elif operation == "power":
            node = sympy.Pow(operands[0], sympy.Rational(text))
        elif operation == "choose":
            condition, below, otherwise = operands
            node = sympy.Piecewise((below, condition < 0), (otherwise, True))
        elif operation == "spline":
            name, order = text.rsplit("/", 1)
            node = sympy.Function(f"{name}_{order}" if order != "0" else name)(*operands)
        else:
            node = functions[operation](*operands)
        built.append(node)
    count = len(residual)

    def column(places: list[int]) -> Any:
        return sympy.Matrix(count, 1, [built[it] for it in places])

    coordinates = mechanism.coordinates
    jacobian = sympy.zeros(count, len(coordinates))
    for row, place, node in entries:
        jacobian[row, place] = built[node]

    def symbol(name: str) -> Any:
        return symbols.setdefault(name, sympy.Symbol(name, real=True))

    return SymbolicEquations(
        residual=column(residual),
        jacobian=jacobian,
        time_derivative=column(time_derivative),
        gamma=column(gamma),
        coordinates=tuple(symbol(it) for it in coordinates),
        rates=tuple(symbol(f"{it}_rate") for it in coordinates),
        symbols=symbols,
        t=symbol("t"),
    )
