"""Assemblies and singular poses of a mechanism."""

from __future__ import annotations

import html
from dataclasses import dataclass
from typing import Any

from linkwright._columns import Array


@dataclass(frozen=True)
class Assembly:
    """Way to assemble a mechanism.

    Attributes
    ----------
    label : str
        Signs of its loops, and letters of loops without a closed form: ``"+-"``. It is the argument of `Mechanism.in_assembly`.
    pose : ndarray, (n,)
        Coordinates (m, rad).
    drawn : bool
        True for the assembly of the design configuration.
    """

    label: str
    pose: Array
    drawn: bool


class Check:
    """Results of a check.

    Attributes
    ----------
    results : dict
        What ``linkwright check --json`` writes, key by key.
    warnings : tuple of str
        Warnings.
    error : str or None
        Reason that the motion ends early; None if it is complete.
    proven : bool or None
        True if the motion is proven over the whole range; None if no proof was requested.
    """

    def __init__(self, results: dict[str, Any], text: str) -> None:
        self.results = results
        self.warnings = tuple(results["warnings"])
        self.error: str | None = results.get("error")
        proof = results.get("proof")
        self.proven: bool | None = None if proof is None else proof["status"] == "proven"
        self._text = text

    def __getitem__(self, key: str) -> Any:
        return self.results[key]

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Check of {self.results['mechanism']}: {len(self.results['assemblies'])} assemblies>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self._text)}</pre>"
