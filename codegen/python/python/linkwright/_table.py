"""Tables of measured values, as the solver reads them."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from math import isnan
from typing import TYPE_CHECKING, Any, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike

if TYPE_CHECKING:
    import pandas
    import polars

#: Measured values: a file, the text or the bytes of a table, or a column per quantity.
Data = Union[str, bytes, os.PathLike[str], Mapping[str, ArrayLike], "pandas.DataFrame", "polars.DataFrame"]

#: Name in messages of a table that is not a file.
NAME = "data"


class Notes(TypedDict):
    """Notes on the reading of a table: columns that are left out, with the reason, and guesses, with the quantity and the others."""

    left_out: list[tuple[str, str]]
    guesses: list[tuple[str, str, str]]


def table(
    data: Data,
    columns: Mapping[str, str] | None,
    units: Mapping[str, str] | Sequence[str] | str | None,
    skip: Sequence[str],
    time: str | None,
    shift: float,
    delimiter: str | None,
    decimal: str | None,
) -> dict[str, Any]:
    """Return a table with its reading, as the solver takes both."""
    name, contents = NAME, None
    if isinstance(data, os.PathLike):
        name = os.fspath(data)
    elif isinstance(data, bytes):
        contents = data
    elif isinstance(data, str):
        if "\n" in data:
            contents = data.encode()
        else:
            name = data
    else:
        contents, delimiter, decimal = _written(data), ",", "."
    return {
        "name": name,
        "contents": contents,
        "columns": listed(columns),
        "units": listed(units),
        "skip": [skip] if isinstance(skip, str) else list(skip),
        "time": time,
        "shift": float(shift),
        "delimiter": delimiter,
        "decimal": decimal,
    }


def listed(given: Mapping[str, str] | Mapping[str, float | str] | Sequence[str] | str | None) -> list[str]:
    """Return values of columns as options of the command: ``COLUMN=VALUE``, or values of all columns."""
    if given is None:
        return []
    if isinstance(given, str):
        return [given]
    if isinstance(given, Mapping):
        return [f"{name}={it if isinstance(it, str) else repr(float(it))}" for name, it in given.items()]
    return list(given)


def _written(data: Any) -> bytes:
    """Return columns as CSV, in which numbers have all their digits."""
    index = getattr(data, "index", None)
    if getattr(index, "name", None) is not None:
        data = data.reset_index()
    names = [str(it) for it in getattr(data, "columns", data)]
    columns = [_cells(data[name]) for name in names]
    lengths = [len(it) for it in columns]
    if len(set(lengths)) > 1:
        both = ", ".join(f"{name}: {length}" for name, length in zip(names, lengths, strict=True))
        raise ValueError(f"columns have different numbers of values: {both}")
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows(zip(*columns, strict=True))
    return text.getvalue().encode()


def _cells(values: ArrayLike) -> list[str]:
    try:
        numbers = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        return [str(it) for it in np.asarray(values, dtype=object)]
    if numbers.ndim != 1:
        raise ValueError(f"a column has {numbers.ndim} dimensions; values are along one")
    return ["" if isnan(it) else repr(it) for it in numbers.tolist()]
