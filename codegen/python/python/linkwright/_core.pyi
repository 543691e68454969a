"""Solver of Linkwright; the package documents it."""

from collections.abc import Callable
from os import PathLike
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from linkwright._table import Notes

_Array: TypeAlias = NDArray[np.float64]

def axis(first: float, last: float, count: int) -> _Array: ...
def samples(ranges: list[tuple[float, float]], count: int, seed: int | None) -> _Array: ...
def extremes(times: _Array, values: _Array) -> _Array: ...

class Solved:
    columns: list[tuple[str, str, bool]]
    values: _Array
    failure: tuple[str, float, int | None] | None
    error: str | None
    warnings: list[str]
    residual: float
    reciprocal_condition: float
    simulation: tuple[tuple[int, int, int, int], float] | None

class Mechanism:
    @staticmethod
    def load(path: str | PathLike[str], choices: dict[str, Any]) -> Mechanism: ...
    @staticmethod
    def loads(text: str, name: str, tables: list[tuple[str, bytes]], choices: dict[str, Any]) -> Mechanism: ...
    text: str
    file: str
    tables: list[tuple[str, bytes]]
    name: str
    motion: str | None
    assembly: str | None
    docs: str
    warnings: list[dict[str, Any]]
    coordinates: list[str]
    points: list[str]
    rows: list[str]
    is_free: bool
    controls: list[tuple[str, str, float | None, str, tuple[float, float] | None, str]]
    quantities: list[tuple[str, str, bool]]
    drawn_pose: list[float]
    def solve(self, times: _Array, start: float, step: float | None) -> Solved: ...
    def simulate(self, times: _Array, relative: float, absolute: float, method: str) -> Solved: ...
    def solve_sets(
        self,
        parameters: _Array,
        inputs: _Array | None,
        times: _Array,
        names: list[str],
        work: tuple[int, Callable[[int], object] | None],
    ) -> tuple[_Array, NDArray[np.int64], NDArray[np.uint8], _Array, NDArray[np.int64], list[str]]: ...
    def check(self, start: float, end: float, step: float, prove: bool) -> tuple[str, str]: ...
    def assemblies(self, t: float) -> tuple[list[tuple[str, list[float], bool]], bool]: ...
    def evaluate(self, pose: _Array, rates: _Array, t: float) -> tuple[_Array, _Array, _Array, _Array]: ...
    def expressions(
        self,
    ) -> tuple[
        list[tuple[str, str, list[int]]],
        list[int],
        list[tuple[int, int, int]],
        list[int],
        list[int],
    ]: ...
    def equations_as(self, form: str) -> str: ...
    def derivation_as(self, form: str) -> str: ...
    def code(self, language: str, single: bool) -> list[tuple[str, str]]: ...
    def compare(
        self, table: dict[str, Any], start: float | None, step: float
    ) -> tuple[list[tuple[str, str, tuple[int, float, float, float] | None]], str | None, list[str], Notes]: ...
    def calibrate(
        self,
        table: dict[str, Any],
        deviations: list[str],
        bounds: list[tuple[str, float, float]],
        step: float,
    ) -> dict[str, Any]: ...
    def drawing(self, t: float) -> str: ...
    def page(self, start: float, end: float, step: float) -> str: ...
