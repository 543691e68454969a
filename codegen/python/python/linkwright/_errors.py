"""Exceptions and warnings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Finding:
    """Finding in a description.

    Attributes
    ----------
    code : str
        Class of the finding, such as ``"K07"``; empty for a finding about the description as a whole.
    is_error : bool
        True for an error, False for a warning.
    message : str
        Fault in one sentence.
    help : tuple of str
        Remedies.
    line, column : int
        First place in the text, from 1; 0 without a place.
    rendered : str
        Message with its place and the marked line, as the command line prints it.
    """

    code: str
    is_error: bool
    message: str
    help: tuple[str, ...]
    line: int
    column: int
    rendered: str

    @classmethod
    def of(cls, found: dict[str, Any]) -> Finding:
        return cls(**{**found, "help": tuple(found["help"])})

    def __str__(self) -> str:
        return self.rendered


class DescriptionError(ValueError):
    """Description that cannot be solved.

    Attributes
    ----------
    findings : tuple of Finding
        Errors and warnings in the order of the text.
    code : str
        Code of the first error.
    line, column : int
        Place of the first error, from 1; 0 without a place.
    """

    def __init__(self, message: str, findings: Sequence[Finding] = ()) -> None:
        super().__init__(message, tuple(findings))
        self.findings = tuple(findings)
        first = next((it for it in self.findings if it.is_error), None)
        self.code = first.code if first else ""
        self.line = first.line if first else 0
        self.column = first.column if first else 0

    @classmethod
    def of(cls, findings: list[dict[str, Any]]) -> DescriptionError:
        listed = [Finding.of(it) for it in findings]
        return cls("\n".join(it.rendered.rstrip() for it in listed), listed)

    def __str__(self) -> str:
        return str(self.args[0])


class DescriptionWarning(UserWarning):
    """Warning of a description or of its solution."""


class MotionWarning(UserWarning):
    """Motion that ends early, or that comes close to a singular pose."""
