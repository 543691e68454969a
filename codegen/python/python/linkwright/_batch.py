"""Motions of many sets of parameters and inputs."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from operator import index
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright import _core
from linkwright._columns import COMPONENTS, Array, Columns, unknown

if TYPE_CHECKING:
    import pandas

    from linkwright._mechanism import Mechanism

#: Variables of the environment that limit threads, the first one that is set.
LIMITS = ("LINKWRIGHT_NUM_THREADS", "OMP_NUM_THREADS")

Progress = bool | Callable[[int, int], object]


class Batch(Columns):
    """Motions of N sets of parameters and inputs over T instants.

    ``batch["phi_rocker"]`` is N x T, ``batch["K"]`` the paths of the point K, N x T x 2.

    Attributes
    ----------
    t : ndarray, (T,)
        Instants (s).
    values : ndarray, (N, T, number of quantities)
        All values in SI units; NaN where a motion has ended.
    solved : ndarray of int, (N,)
        Number of solved instants of each set.
    failure_kind : ndarray of str, (N,)
        Name of the kind of failure of each set; empty without one.
    failure_time : ndarray, (N,)
        Time that cannot be reached (s); NaN without a failure.
    failure_block : ndarray of int, (N,)
        Index of the block of equations that fails; -1 without a failure.
    parameters : dict of str to ndarray, (N,)
        Values by which the sets differ.
    mechanism : Mechanism
        Mechanism with the other values.
    """

    solved: NDArray[np.int64]
    failure_kind: NDArray[np.str_]
    failure_time: Array
    failure_block: NDArray[np.int64]
    parameters: dict[str, Array]
    mechanism: Mechanism

    def __init__(
        self,
        mechanism: Mechanism,
        t: Array,
        values: Array,
        units: dict[str, str],
        parameters: dict[str, Array],
        outcomes: Outcomes,
    ) -> None:
        super().__init__(t, values, units)
        self.mechanism = mechanism
        self.parameters = parameters
        self.solved = outcomes.solved
        self.failure_kind = outcomes.kind
        self.failure_time = outcomes.time
        self.failure_block = outcomes.block

    @property
    def failed(self) -> NDArray[np.bool_]:
        """True for each set whose motion ends early, (N,)."""
        return np.not_equal(self.failure_kind, "")

    def __len__(self) -> int:
        return len(self.values)

    def extremes(self, name: str) -> Extremes:
        """Return the smallest and the largest value of a quantity over the instants of each set, with their times.

        Parameters
        ----------
        name : str
            Quantity; not a point, which has two components.
        """
        if name not in self._places:
            raise KeyError(unknown("quantity", name, self.names))
        found = _core.extremes(self.t, self[name])
        return Extremes(*found.T)

    def to_structured(self) -> NDArray[np.void]:
        """Return a structured array of N * T records: the set, `t` and all quantities."""
        sets, instants = self.values.shape[:2]
        lead = [
            ("set", np.repeat(np.arange(sets, dtype=np.float64), instants)),
            ("t", np.tile(self.t, sets)),
        ]
        return self._records(lead)

    def to_pandas(self) -> pandas.DataFrame:
        """Return a DataFrame with a row per set and instant, and a column per quantity; needs pandas."""
        import pandas

        rows = self.values.reshape(-1, len(self.names))
        index = pandas.MultiIndex.from_product([range(len(self)), self.t], names=["set", "t"])
        return pandas.DataFrame(rows, index=index, columns=list(self.names))

    def __repr__(self) -> str:
        ended = int(self.failed.sum())
        end = f", {ended} end early" if ended else ""
        return f"<Batch of {self.mechanism.name}: {len(self)} sets at {len(self.t)} instants{end}>"


@dataclass(frozen=True)
class Extremes:
    """Smallest and largest value of a quantity in each set, each the first of equal ones; NaN for a set that ends early.

    Attributes
    ----------
    minimum, maximum : ndarray, (N,)
        Values in the SI unit of the quantity.
    minimum_time, maximum_time : ndarray, (N,)
        Their instants (s).
    """

    minimum: Array
    minimum_time: Array
    maximum: Array
    maximum_time: Array


class Outcomes:
    """Outcome of each set."""

    def __init__(
        self,
        solved: NDArray[np.int64],
        kinds: NDArray[np.uint8],
        time: Array,
        block: NDArray[np.int64],
        names: list[str],
    ) -> None:
        self.solved = solved
        self.kind: NDArray[np.str_] = np.array(names, dtype=np.str_)[kinds]
        self.time = time
        self.block = block

    def join(self, other: Outcomes) -> None:
        """Add the outcomes of motions that are followed in the other direction; the first failure counts."""
        complete = self.kind == ""
        self.solved = self.solved + other.solved
        self.time = np.where(complete, other.time, self.time)
        self.block = np.where(complete, other.block, self.block)
        self.kind = np.where(complete, other.kind, self.kind)

    def without_start(self) -> Outcomes:
        """Return the outcomes without the instant of the start."""
        self.solved = np.maximum(self.solved - 1, 0)
        return self


def thread_count(threads: int | None) -> int:
    """Return the requested number of threads; otherwise that of the environment, or one per processor of this process."""
    if threads is not None:
        threads = index(threads)
        if threads < 1:
            raise ValueError(f"threads is {threads}, but at least one is needed")
        return threads
    for name in LIMITS:
        limit = os.environ.get(name, "")
        if limit.isdigit() and int(limit) > 0:
            return int(limit)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def solve_sets(
    mechanism: Mechanism,
    t: Array,
    values: Mapping[str, ArrayLike],
    inputs: Mapping[str, Any],
    outputs: Sequence[str] | None,
    start: float,
    threads: int | None,
    progress: Progress,
) -> Batch:
    """Solve all sets; see `Mechanism.solve`."""
    arrays = {name: one_dimensional(name, it) for name, it in values.items()}
    signals, counts = signals_of(mechanism, inputs, len(t))
    sizes = {len(it) for it in arrays.values() if len(it) != 1} | {it for it in counts if it != 1}
    if len(sizes) > 1:
        shown = {name: len(it) for name, it in arrays.items()}
        raise ValueError(f"the values have different numbers of sets: {shown or sorted(sizes)}")
    count = sizes.pop() if sizes else 1
    table = np.empty((count, len(mechanism.parameters)))
    for place, (name, parameter) in enumerate(mechanism.parameters.items()):
        table[:, place] = arrays.get(name, parameter.value)
    names = requested(mechanism, outputs)
    ahead = np.unique(t[t >= start])
    before = np.unique(t[t < start])[::-1]
    report, close = reporting(progress, count * ((len(ahead) > 0) + (len(before) > 0)))

    def chain(times: Array, done: int) -> tuple[Array, Outcomes]:
        chosen = None
        if signals is not None:
            # Inputs by instant belong to the times of the request; those at the start are those of the instant nearest to it.
            places = np.array([int(np.abs(t - it).argmin()) for it in times], dtype=np.intp)
            of_times = signals[:, places] if signals.shape[1] > 1 else signals
            chosen = np.ascontiguousarray(np.broadcast_to(of_times, (count, *of_times.shape[1:])))
        solved = mechanism._core.solve_sets(
            table,
            chosen,
            times,
            names,
            (thread_count(threads), report and (lambda sets: report(done + sets))),
        )
        return solved[0], Outcomes(*solved[1:])

    try:
        parts: list[tuple[Array, Array]] = []
        outcome: Outcomes | None = None
        for direction, times in enumerate((ahead, before)):
            if len(times) == 0:
                continue
            begins = bool(times[0] == start)
            visited = times if begins else np.concatenate([[start], times])
            solved, own = chain(visited, count * direction)
            parts.append((times, solved if begins else solved[:, 1:]))
            if not begins:
                own = own.without_start()
            if outcome is None:
                outcome = own
            else:
                outcome.join(own)
    finally:
        close()
    units = {name: mechanism.quantities[name] for name in names}
    if outcome is None:
        empty = np.empty((count, 0, len(names)))
        none = np.zeros(count, np.int64)
        outcome = Outcomes(none, none.astype(np.uint8), np.full(count, np.nan), none - 1, [""])
        return Batch(mechanism, t, empty, units, arrays, outcome)
    if len(parts) == 1 and np.array_equal(parts[0][0], t):
        found = parts[0][1]
    else:
        times = np.concatenate([it for it, _ in parts])
        order = np.argsort(times)
        places = order[np.searchsorted(times[order], t)]
        found = np.concatenate([it for _, it in parts], axis=1)[:, places]
    return Batch(mechanism, t, found, units, arrays, outcome)


def real(name: str, values: ArrayLike) -> Array:
    """Return real numbers as an array; complex ones would lose a part."""
    if np.iscomplexobj(values):
        raise TypeError(f"{name} has complex values")
    return np.asarray(values, dtype=np.float64)


def one_dimensional(name: str, values: ArrayLike) -> Array:
    array = np.atleast_1d(real(name, values))
    if array.ndim != 1:
        raise ValueError(f"{name} has {array.ndim} dimensions; the sets are along one")
    return array


def signals_of(mechanism: Mechanism, inputs: Mapping[str, Any], instants: int) -> tuple[Array | None, set[int]]:
    """Return value, rate and acceleration of all inputs, (sets, 1 or T, inputs, 3), and the numbers of sets."""
    if not inputs:
        return None, set()
    shaped: dict[str, list[Array]] = {}
    sizes = [1, 1]
    for name, signal in inputs.items():
        parts = signal if isinstance(signal, tuple) else (signal,)
        if len(parts) > 3:
            raise ValueError(f"{name} takes a value, a rate and an acceleration, not {len(parts)} arrays")
        arrays = []
        for part in parts:
            array = real(name, part)
            if array.ndim == 0:
                array = array.reshape(1, 1)
            elif array.ndim == 1:
                array = array.reshape(-1, 1)
            elif array.ndim != 2:
                raise ValueError(f"{name} has {array.ndim} dimensions; sets and instants are two")
            if array.shape[1] not in (1, instants):
                raise ValueError(f"{name} has {array.shape[1]} values for {instants} instants")
            if array.shape[0] != 1:
                sizes[0] = array.shape[0]
            if array.shape[1] != 1:
                sizes[1] = array.shape[1]
            arrays.append(array)
        shaped[name] = arrays
    signals = np.zeros((sizes[0], sizes[1], len(mechanism.inputs), 3))
    for place, (name, own) in enumerate(mechanism.inputs.items()):
        if name not in shaped:
            if own.value is None:
                raise ValueError(
                    f"input {name!r} is a function of time; give its values too, or a number in the call of the mechanism"
                )
            signals[:, :, place, 0] = own.value
            continue
        for level, array in enumerate(shaped[name]):
            signals[:, :, place, level] = array
    return signals, {sizes[0]}


def requested(mechanism: Mechanism, outputs: Sequence[str] | None) -> list[str]:
    """Return the names of quantities; the name of a point stands for its x and y."""
    if outputs is None:
        return list(mechanism.quantities)
    if isinstance(outputs, str):
        outputs = [outputs]
    names: dict[str, None] = {}
    for name in outputs:
        if name in mechanism.quantities:
            names[name] = None
        elif name in mechanism.points:
            names.update(dict.fromkeys(name + it for it in COMPONENTS[0]))
        else:
            raise ValueError(unknown("quantity", name, (*mechanism.quantities, *mechanism.points)))
    return list(names)


def reporting(progress: Progress, total: int) -> tuple[Callable[[int], object] | None, Callable[[], object]]:
    """Return a function that receives the number of completed sets, and one that ends the report."""
    if progress is False:
        return None, lambda: None
    if callable(progress):
        return (lambda done: progress(done, total)), lambda: None
    try:
        from tqdm.auto import tqdm
    except ImportError:

        def shown(done: int) -> None:
            sys.stderr.write(f"\r{done} of {total} sets")

        return shown, lambda: sys.stderr.write("\n")
    bar = tqdm(total=total, unit="sets")
    return (lambda done: bar.update(done - bar.n)), bar.close
