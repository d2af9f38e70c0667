"""Stubs say of every class and function what the package itself says."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from pathlib import Path

import pytest

import wayside
from wayside import _core

STUBS = Path(wayside.__file__).with_name("_core.pyi")


def told() -> Iterator[tuple[str, str]]:
    """Names of what has a docstring in the stubs, with that."""
    for node in ast.parse(STUBS.read_text(encoding="utf-8")).body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            yield node.name, ast.get_docstring(node) or ""
        if isinstance(node, ast.ClassDef):
            members = [member for member in node.body if isinstance(member, ast.FunctionDef)]
            of_members = [(member.name, ast.get_docstring(member)) for member in members]
            yield from ((f"{node.name}.{name}", doc) for name, doc in of_members if doc)


@pytest.mark.parametrize(("name", "of_stub"), list(told()), ids=[name for name, _ in told()])
def test_a_docstring_of_the_stubs_is_the_packages(name: str, of_stub: str) -> None:
    of_package: object = _core
    for part in name.split("."):
        of_package = getattr(of_package, part)
    assert of_stub.split() == (inspect.getdoc(of_package) or "").split()
    assert of_stub.endswith(".")
    assert "…" not in of_stub


def test_what_the_package_says_is_in_the_stubs() -> None:
    stubs = {name for name, _ in told()}
    classes = [value for value in vars(_core).values() if inspect.isclass(value)]
    public = [
        f"{each.__name__}.{name}"
        for each in classes
        for name in vars(each)
        if not name.startswith("_") and getattr(each, name).__doc__
    ]
    assert len(public) > 60
    assert set(public) <= stubs
