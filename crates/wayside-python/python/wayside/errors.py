"""Exceptions with file, place and rule."""

from __future__ import annotations

from typing import TypedDict


class Fault(TypedDict):
    """A broken rule and its place."""

    file: str | None
    """File that was read; None of a dictionary."""
    line: int | None
    """Line in the file, from 1."""
    column: int | None
    """Column in the file, from 1."""
    place: str | None
    """Table, target or material concerned, as ``[radar]`` or ``target `bus-2```."""
    rule: str
    """Rule that is broken, in a sentence."""


class WaysideError(Exception):
    """Work that was refused, or that the system did not let end.

    The message is the one of the command line. ``file``, ``line``, ``column``, ``place`` and ``rule`` are
    those of the first broken rule, ``faults`` has all of them. ``kind`` is "refused" for an input that was
    read and refused (exit code 1 of the program), "system" where a file is missing, unreadable or
    unwritable (2).
    """

    def __init__(self, message: str, kind: str = "refused", faults: list[Fault] | None = None) -> None:
        super().__init__(message)
        self.kind = kind
        self.faults: list[Fault] = faults or []

    @property
    def file(self) -> str | None:
        """File of the first broken rule."""
        return self.faults[0]["file"] if self.faults else None

    @property
    def line(self) -> int | None:
        """Line of the first broken rule, from 1."""
        return self.faults[0]["line"] if self.faults else None

    @property
    def column(self) -> int | None:
        """Column of the first broken rule, from 1."""
        return self.faults[0]["column"] if self.faults else None

    @property
    def place(self) -> str | None:
        """Table, target or material of the first broken rule."""
        return self.faults[0]["place"] if self.faults else None

    @property
    def rule(self) -> str | None:
        """Rule that is broken first, in a sentence."""
        return self.faults[0]["rule"] if self.faults else None
