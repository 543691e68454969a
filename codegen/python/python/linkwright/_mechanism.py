"""Mechanisms and how they are solved."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import index
from types import MappingProxyType
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from linkwright import _core
from linkwright._batch import Batch, Progress, real, solve_sets
from linkwright._checked import Assembly, Check
from linkwright._columns import COMPONENTS, Array, unknown
from linkwright._equations import Equations, SymbolicEquations, symbolic
from linkwright._errors import DescriptionWarning, Finding
from linkwright._fit import calibrate, compare
from linkwright._motion import Motion
from linkwright._sensitivity import Sensitivity

#: Value of a parameter or of an input of one mechanism: a number in SI units, or text of the language such as "130mm" or "0.2*sin(t)".
Value = float | str


@dataclass(frozen=True)
class Quantity:
    """Parameter or input.

    Attributes
    ----------
    value : float or None
        Value in SI units; None for an input that is a function of time.
    unit : str
        SI unit; empty for a pure number.
    low, high : float or None
        Ends of its range; None without a range.
    docs : str
        Documentation.
    """

    value: float | None
    unit: str
    low: float | None
    high: float | None
    docs: str


def load(path: str | os.PathLike[str], *, motion: str | None = None) -> Mechanism:
    """Read a description from a file, with the tables beside it.

    Parameters
    ----------
    path : str or path
        File, by convention with the extension ``.mech``.
    motion : str, optional
        Name of the motion, if the description has several.

    Raises
    ------
    DescriptionError
        The description has errors, or its equations do not determine the motion.
    OSError
        The file cannot be read.
    """
    choices = _choices(motion=motion)
    return Mechanism(_core.Mechanism.load(os.fspath(path), choices), choices)._warn()


def loads(
    text: str,
    *,
    tables: Mapping[str, bytes | str] | None = None,
    motion: str | None = None,
    name: str = "<text>",
) -> Mechanism:
    """Read a description from its text.

    Parameters
    ----------
    text : str
        Description.
    tables : mapping, optional
        Contents of the tables that the description names, by their paths.
    motion : str, optional
        Name of the motion, if the description has several.
    name : str, optional
        Name of the text in messages.

    Raises
    ------
    DescriptionError
        The description has errors, or its equations do not determine the motion.
    """
    choices = _choices(motion=motion)
    return _opened(text, name, _contents(tables or {}), choices)._warn()


def _choices(**changed: Any) -> dict[str, Any]:
    first: dict[str, Any] = {"motion": None, "assignments": [], "assembly": None, "along": None, "efforts": False}
    return {**first, **changed}


def _contents(tables: Mapping[str, bytes | str]) -> list[tuple[str, bytes]]:
    return [(path, it.encode() if isinstance(it, str) else it) for path, it in tables.items()]


def _opened(text: str, name: str, tables: list[tuple[str, bytes]], choices: dict[str, Any]) -> Mechanism:
    return Mechanism(_core.Mechanism.loads(text, name, tables, choices), choices)


class Mechanism:
    """Mechanism of a description.

    It never changes: calls such as ``m(rod=0.13)`` return another mechanism. `load` and `loads` make the first one.

    Examples
    --------
    >>> m = linkwright.loads('''mechanism crank {
    ...     param length = 40mm;
    ...     point O = (0, 0);
    ...     body arm at O { O, A: (length, 0) }
    ...     revolute O(ground, arm);
    ...     drive phi(arm) = 3*t;
    ... }''')
    >>> m.parameters["length"].value
    0.04
    >>> motion = m(length=0.05).solve([0.0, 0.5])
    >>> motion.phi_arm
    array([0. , 1.5])
    """

    def __init__(self, core: _core.Mechanism, choices: dict[str, Any]) -> None:
        self._core = core
        self._choices = choices

    def _warn(self) -> Mechanism:
        for found in self._core.warnings:
            warnings.warn(Finding.of(found).rendered, DescriptionWarning, stacklevel=3)
        return self

    def _changed(self, **changed: Any) -> Mechanism:
        core = self._core
        return _opened(core.text, core.file, core.tables, {**self._choices, **changed})

    def __reduce__(self) -> tuple[Any, ...]:
        core = self._core
        return _opened, (core.text, core.file, core.tables, self._choices)

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self._core.name

    @property
    def motion(self) -> str | None:
        """Name of the motion; None for the only one."""
        return self._core.motion

    @property
    def assembly(self) -> str | None:
        """Label of the chosen assembly; None for that of the design configuration."""
        return self._core.assembly

    @property
    def text(self) -> str:
        """Text of the description."""
        return self._core.text

    @property
    def docs(self) -> str:
        """Documentation of the description."""
        return self._core.docs

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Warnings of the description and of its solution."""
        return tuple(Finding.of(it) for it in self._core.warnings)

    def _controls(self, kind: str) -> Mapping[str, Quantity]:
        found = {}
        for name, own, value, unit, ends, docs in self._core.controls:
            if own == kind:
                low, high = ends or (None, None)
                found[name] = Quantity(value, unit, low, high, docs)
        return MappingProxyType(found)

    @cached_property
    def parameters(self) -> Mapping[str, Quantity]:
        """Parameters by name, in the order of the description."""
        return self._controls("parameter")

    @cached_property
    def inputs(self) -> Mapping[str, Quantity]:
        """Inputs by name, in the order of the description."""
        return self._controls("input")

    @cached_property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates, in the order of q."""
        return tuple(self._core.coordinates)

    @cached_property
    def points(self) -> tuple[str, ...]:
        """Names of the points."""
        return tuple(self._core.points)

    @cached_property
    def quantities(self) -> Mapping[str, str]:
        """SI units of all quantities of a batch, by name: coordinates with rates and accelerations, points, requested forces, measures."""
        return MappingProxyType({name: unit for name, unit, _ in self._core.quantities})

    @cached_property
    def measures(self) -> Mapping[str, str]:
        """SI units of the quantities besides coordinates and points, by name: driving forces, reactions, energies, and those of `measure`."""
        known = {f"{name}{it}" for name in self.coordinates for it in ("", "_d", "_dd")}
        known |= {f"{name}{it}" for name in self.points for both in COMPONENTS for it in both}
        return MappingProxyType({name: it for name, it in self.quantities.items() if name not in known})

    def __call__(self, **values: Value) -> Mechanism:
        """Return a mechanism with other values of parameters and inputs.

        Parameters
        ----------
        **values : float or str
            Numbers in SI units, or text of the language: ``rod="130mm"``, ``boom="0.2*sin(t)"``.

        Raises
        ------
        TypeError
            A name is neither a parameter nor an input.
        ValueError
            A value cannot be used.
        """
        return self._with(values)

    def _with(self, values: Mapping[str, Value]) -> Mechanism:
        if not values:
            return self
        assignments = list(self._choices["assignments"])
        for name, value in values.items():
            self._check_name(name)
            text = value if isinstance(value, str) else repr(_finite(name, value))
            if "\n" in text or "\r" in text or ";" in text:
                raise ValueError(f"{name} takes one value of the language")
            assignments.append(f"{name} = {text}")
        return self._changed(assignments=assignments)

    def _solved(self, instants: Array, start: float, step: float | None) -> _core.Solved:
        if step is not None and not step > 0:
            raise ValueError(f"step is {step}, but a positive time is needed")
        return self._core.solve(instants, _finite("start", start), step)

    def _check_name(self, name: str) -> None:
        if name not in self.parameters and name not in self.inputs:
            known = (*self.parameters, *self.inputs)
            raise TypeError(unknown("parameter or input", name, known))

    def in_assembly(self, label: str | Assembly | None) -> Mechanism:
        """Return the mechanism in another assembly: one of `assemblies`, or its label; None for that of the design configuration."""
        label = label.label if isinstance(label, Assembly) else label
        return self._changed(assembly=label)

    @overload
    def solve(self, t: ArrayLike, values: None = None, *, start: float = ..., step: float | None = ...) -> Motion: ...

    @overload
    def solve(
        self,
        t: ArrayLike,
        values: Mapping[str, ArrayLike],
        *,
        inputs: Mapping[str, Any] | None = ...,
        outputs: Sequence[str] | None = ...,
        start: float = ...,
        threads: int | None = ...,
        progress: Progress = ...,
    ) -> Batch: ...

    @overload
    def solve(
        self,
        t: ArrayLike,
        values: Mapping[str, ArrayLike] | None = None,
        *,
        inputs: Mapping[str, Any] | None = ...,
        outputs: Sequence[str] | None = ...,
        start: float = ...,
        step: float | None = ...,
        threads: int | None = ...,
        progress: Progress = ...,
    ) -> Motion | Batch: ...

    def solve(
        self,
        t: ArrayLike,
        values: Mapping[str, ArrayLike] | None = None,
        *,
        inputs: Mapping[str, Any] | None = None,
        outputs: Sequence[str] | None = None,
        start: float = 0.0,
        step: float | None = None,
        threads: int | None = None,
        progress: Progress = False,
    ) -> Motion | Batch:
        """Solve the motion at the instants `t`.

        The mechanism is assembled at `start` and followed from there to the instants, in both directions. It never changes its assembly.
        Coordinates that are free keep their first rate; `simulate` moves them by forces.

        Parameters
        ----------
        t : array_like, (T,)
            Instants (s), in any order.
        values : mapping of str to array_like, (N,), optional
            Values of parameters, in SI units: one per set. With `values`, `inputs` or `outputs` the result is a `Batch` of N sets.
        inputs : mapping of str to array_like, optional
            Inputs of the batch: a value, or a tuple of value, rate and acceleration, each a number, one per set (N,), or one per set and
            instant (N, T); N may be 1. Those by instant hold at the start as at the instant nearest to it. Inputs without an entry stay at
            their values. Text is a law of all sets, ``inputs={"boom": "0.2*sin(t)"}``.
        outputs : sequence of str, optional
            Quantities of the batch; the name of a point stands for its x and y. All without it.
        start : float, optional
            Time of the assembly (s).
        step : float, optional
            Longest step between visited times of a motion (s). Without it, the path is followed straight from instant to instant, in as many
            steps as that needs.
        threads : int, optional
            Number of threads of a batch. Without it, that of the environment variables ``LINKWRIGHT_NUM_THREADS`` or
            ``OMP_NUM_THREADS``, otherwise one per processor.
        progress : bool or callable, optional
            True to show the progress of a batch (with tqdm if it is installed); a callable receives the numbers of completed and of all sets.

        Returns
        -------
        Motion or Batch
            Values are NaN after the end of a motion; `Motion.failed` and `Batch.failure_kind` tell the reason.

        Warns
        -----
        MotionWarning
            A motion ends early, or comes close to a singular pose. A batch does not warn.

        Raises
        ------
        ValueError
            A name is unknown, a shape does not fit, or a time is not finite.
        """
        instants = _instants(t)
        if values is None and inputs is None and outputs is None:
            return Motion(self, instants, self._solved(instants, start, step))._warn()
        values, inputs = values or {}, inputs or {}
        for name in values:
            if name not in self.parameters:
                hint = "; give inputs by `inputs=`" if name in self.inputs else ""
                raise ValueError(unknown("parameter", name, tuple(self.parameters)) + hint)
        for name in inputs:
            if name not in self.inputs:
                raise ValueError(unknown("input", name, tuple(self.inputs)))
        laws = {name: it for name, it in inputs.items() if isinstance(it, str)}
        signals = {name: it for name, it in inputs.items() if not isinstance(it, str)}
        if laws and signals:
            raise ValueError("inputs are either laws as text or numbers, not both")
        mechanism = self._with(laws)
        start = _finite("start", start)
        return solve_sets(mechanism, instants, values, signals, outputs, start, threads, progress)

    def sweep(
        self,
        t: ArrayLike,
        ranges: Mapping[str, tuple[float, float, int] | tuple[float, float] | int],
        *,
        samples: int | None = None,
        seed: int | None = None,
        outputs: Sequence[str] | None = None,
        start: float = 0.0,
        threads: int | None = None,
        progress: Progress = False,
    ) -> Batch:
        """Solve for ranges of parameters and inputs: all combinations of their values, or samples of Sobol's sequence.

        The sets are those of ``linkwright sweep``, in its order: the last range varies fastest. `Batch.extremes` has what that command writes.

        Parameters
        ----------
        t : array_like, (T,)
            Instants (s).
        ranges : mapping of str to tuple
            First value, last value and number of values by name; the number alone for the range of the description. Samples have no number
            of values. An input is constant during a motion.
        samples : int, optional
            Number of samples within the ranges.
        seed : int, optional
            Seed that scrambles the samples; without it, the sequence itself.
        outputs, start, threads, progress
            As in `solve`.

        Examples
        --------
        >>> batch = m.sweep(t, {"rod": (0.10, 0.14, 41), "crank_length": (0.03, 0.05, 21)}, outputs=["phi_rocker"])
        >>> swing = batch.extremes("phi_rocker").maximum.reshape(41, 21)
        """
        ends: list[tuple[float, float]] = []
        counts: list[int] = []
        for name, given in ranges.items():
            self._check_name(name)
            parts = given if isinstance(given, tuple) else (given,)
            own = self.parameters.get(name) or self.inputs[name]
            if len(parts) < 2:
                if own.low is None or own.high is None:
                    raise ValueError(f"{name} has no range in the description; give its first and its last value")
                parts = (own.low, own.high, *parts)
            if len(parts) != (2 if samples is not None else 3):
                wanted = "two ends" if samples is not None else "two ends and a number of values"
                raise ValueError(f"the range of {name} needs {wanted}")
            ends.append((float(parts[0]), float(parts[1])))
            counts.extend(_count(f"the number of values of {name}", it) for it in parts[2:])
        if samples is not None:
            columns = list(_core.samples(ends, _count("samples", samples), seed).T)
        else:
            axes = [_core.axis(*both, count) for both, count in zip(ends, counts, strict=True)]
            columns = [it.ravel() for it in np.meshgrid(*axes, indexing="ij")]
        sets = dict(zip(ranges, columns, strict=True))
        values = {name: it for name, it in sets.items() if name in self.parameters}
        inputs = {name: it for name, it in sets.items() if name in self.inputs}
        start = _finite("start", start)
        return solve_sets(self, _instants(t), values, inputs, outputs, start, threads, progress)

    def simulate(
        self,
        t: ArrayLike,
        *,
        rtol: float = 1e-10,
        atol: float = 1e-12,
        method: str = "auto",
    ) -> Motion:
        """Simulate the motion of free coordinates under forces, from t = 0 on.

        Parameters
        ----------
        t : array_like, (T,)
            Instants (s), none of them negative.
        rtol, atol : float, optional
            Relative and absolute tolerance of a step.
        method : {"auto", "dop853", "implicit"}, optional
            Method of integration.

        Raises
        ------
        ValueError
            No coordinate is free, or a time is negative or not finite.
        """
        instants = _instants(t)
        solved = self._core.simulate(instants, float(rtol), float(atol), method)
        return Motion(self, instants, solved)._warn()

    def check(self, start: float = 0.0, end: float = 5.0, step: float = 0.01, *, prove: bool = False) -> Check:
        """Look for assemblies at `start`, and for singular poses of the motion up to `end` (s).

        Parameters
        ----------
        start, end, step : float, optional
            Range of times and longest step (s).
        prove : bool, optional
            True to prove the motion over the whole range, between the instants too.
        """
        results, text = self._core.check(float(start), float(end), float(step), prove)
        return Check(json.loads(results), text)

    def assemblies(self, t: float = 0.0) -> tuple[Assembly, ...]:
        """Return all assemblies that are found at `t` (s)."""
        found, _ = self._core.assemblies(_finite("t", t))
        return tuple(Assembly(label, np.array(pose), drawn) for label, pose, drawn in found)

    def sensitivity(
        self,
        t: ArrayLike,
        parameters: Sequence[str] | str | None = None,
        *,
        start: float = 0.0,
        step: float | None = None,
    ) -> Sensitivity:
        """Differentiate positions and rates by parameters, exactly.

        Parameters
        ----------
        t : array_like, (T,)
            Instants (s).
        parameters : sequence of str, optional
            Parameters; all without it.
        """
        names = [parameters] if isinstance(parameters, str) else parameters
        names = list(self.parameters) if names is None else list(names)
        for name in names:
            if name not in self.parameters:
                raise ValueError(unknown("parameter", name, tuple(self.parameters)))
        along = self._changed(along=names)
        instants = _instants(t)
        motion = Motion(along, instants, along._solved(instants, start, step))._warn()
        return Sensitivity(motion, tuple(it for it in self.parameters if it in names))

    def effort(self, t: ArrayLike, *, start: float = 0.0) -> Mapping[str, Array]:
        """Return the driving forces (N) and torques (N·m), and their powers (W), by name: ``effort_crank``, ``power_crank``.

        Parameters
        ----------
        t : array_like, (T,)
            Instants (s).
        start : float, optional
            Time of the assembly (s).
        """
        driven = self._changed(efforts=True)
        instants = _instants(t)
        motion = Motion(driven, instants, driven._solved(instants, start, None))._warn()
        names = [it for it in motion.names if it.startswith(("effort_", "power_"))]
        return {name: motion[name] for name in names}

    def jacobian(self, pose: ArrayLike | None = None, t: float = 0.0) -> Array:
        """Return Φ_q, (n, n), at a pose (the coordinates in their order; without it, the design configuration) and a time (s)."""
        return self._evaluated(pose, None, t)[1]

    def residual(self, pose: ArrayLike | None = None, t: float = 0.0) -> Array:
        """Return Φ, (n,), at a pose and a time (s)."""
        return self._evaluated(pose, None, t)[0]

    def time_derivative(self, pose: ArrayLike | None = None, t: float = 0.0) -> Array:
        """Return Φ_t, (n,), at a pose and a time (s): the rates solve Φ_q q̇ = −Φ_t."""
        return self._evaluated(pose, None, t)[2]

    def gamma(self, pose: ArrayLike, rate: ArrayLike, t: float = 0.0) -> Array:
        """Return γ, (n,), at a pose, its rates and a time (s): the accelerations solve Φ_q q̈ = γ."""
        return self._evaluated(pose, rate, t)[3]

    def _evaluated(self, pose: ArrayLike | None, rate: ArrayLike | None, t: float) -> tuple[Array, Array, Array, Array]:
        q = self._core.drawn_pose if pose is None else pose
        qd = np.zeros(len(self.coordinates)) if rate is None else rate
        both = [np.ascontiguousarray(it, dtype=np.float64) for it in (q, qd)]
        return self._core.evaluate(both[0], both[1], float(t))

    @property
    def equations(self) -> Equations:
        """Φ, Φ_q, Φ_t and γ as text and LaTeX, and the derivation of the solution."""
        return Equations(self)

    def to_sympy(self) -> SymbolicEquations:
        """Return Φ, Φ_q, Φ_t and γ as matrices of SymPy, which must be installed."""
        return symbolic(self)

    def rust(self, *, single: bool = False) -> str:
        """Return the generated Rust of the description; in single precision on request."""
        return self._core.code("rust", single)[0][1]

    def c(self, *, single: bool = False) -> Mapping[str, str]:
        """Return the generated files of C by name; in single precision on request."""
        return dict(self._core.code("c", single))

    compare = compare
    calibrate = calibrate

    def drawing(self, t: float = 0.0) -> str:
        """Return the drawing at `t` (s) as SVG."""
        return self._core.drawing(_finite("t", t))

    def page(self, start: float = 0.0, end: float = 5.0, step: float = 0.01) -> str:
        """Return the page of the motion between two times (s): one HTML file that loads nothing, as ``linkwright view`` writes it."""
        return self._core.page(float(start), float(end), float(step))

    def _repr_html_(self) -> str:
        return self.drawing()

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {it.value}" for name, it in self.parameters.items())
        motion = f", motion {self.motion}" if self.motion else ""
        return f"<Mechanism {self.name}{motion}{': ' + values if values else ''}>"


def _finite(name: str, value: float) -> float:
    number = float(value)
    if not np.isfinite(number):
        raise ValueError(f"{name} is {number}, not a finite number")
    return number


def _count(name: str, value: int) -> int:
    count = index(value)
    if count < 0:
        raise ValueError(f"{name} is negative: {count}")
    return count


def _instants(t: ArrayLike) -> Array:
    instants = np.atleast_1d(real("t", t))
    if instants.ndim != 1:
        raise ValueError(f"t has {instants.ndim} dimensions; instants are along one")
    return np.ascontiguousarray(instants)
