"""Comparison of what a file holds with what it should hold; the first difference ends the check."""

import math
import sys

from google.protobuf.message import Message


def same(ours, theirs, what, within=1e-9):
    """Numbers to a relative difference, anything else to the letter."""
    is_number = isinstance(ours, float) and isinstance(theirs, (int, float))
    equal = abs(ours - theirs) <= within * max(1.0, abs(ours)) if is_number else ours == theirs
    if not equal:
        sys.exit(f"{what}: the file has {theirs}, expected is {ours}")


class About:
    """A number to its own relative difference, beside others that are exact."""

    def __init__(self, value, within):
        self.value, self.within = value, within


def alike(expected, found, what):
    """A message with the fields of a dictionary and no others, and all that is in them; number of values."""
    if isinstance(found, Message):
        same(sorted(expected), sorted(field.name for field, _ in found.ListFields()), f"fields of {what}")
        return sum(alike(value, getattr(found, name), f"{what}.{name}") for name, value in expected.items())
    if isinstance(expected, list):
        same(len(expected), len(found), f"number of {what}")
        return sum(alike(*pair, f"{what}[{at}]") for at, pair in enumerate(zip(expected, found)))
    about = expected if isinstance(expected, About) else About(expected, 1e-9)
    if isinstance(found, float) and not math.isfinite(found):
        sys.exit(f"{what}: the file has {found}")
    same(about.value, found, what, about.within)
    return 1
