"""A dictionary with the keys of a scene file as the text of one."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ._core import file_keys

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml_of(document: Mapping[str, Any], folder: str | os.PathLike[str] | None = None) -> str:
    """Text of a scene as TOML.

    Names of files are made whole, seen from ``folder`` (the folder of the process where it is left out), as
    those in a scene file are seen from that file.

    Raises TypeError for a value that TOML does not have, and ValueError for a text that is no Unicode, with
    its key.
    """
    here = os.path.abspath(os.fspath(folder) if folder is not None else os.curdir)
    return "\n".join(_lines(document, (), here, frozenset(file_keys()))) + "\n"


def _lines(
    table: Mapping[str, Any], name: tuple[str, ...], folder: str, files: frozenset[str]
) -> Iterator[str]:
    """Lines of a table: its own values first, as the tables below end it."""
    below = []
    for key, value in table.items():
        place = (*name, str(key))
        if isinstance(value, Mapping):
            below.append((f"[{_dotted(place)}]", value, place))
        elif _is_tables(value):
            below += [(f"[[{_dotted(place)}]]", each, place) for each in value]
        else:
            yield f"{_key(str(key), place)} = {_value(_named(value, place, folder, files), place)}"
    for heading, value, place in below:
        yield heading
        yield from _lines(value, place, folder, files)


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(v, Mapping) for v in value)


def _named(value: Any, place: tuple[str, ...], folder: str, files: frozenset[str]) -> Any:
    """A value with whole names of files; an own vehicle, whose name has no ending, is none."""
    is_model = place[-1] == "model" or place[:-1] == ("traffic", "models")
    if not is_model and place[-1] not in files:
        return value
    if isinstance(value, (list, tuple)):
        return [_named(each, place, folder, files) for each in value]
    if not isinstance(value, (str, bytes, os.PathLike)):
        return value
    name = os.fsdecode(value)
    return name if is_model and "." not in os.path.basename(name) else os.path.join(folder, name)


def _dotted(place: tuple[str, ...]) -> str:
    return ".".join(_key(key, place) for key in place)


def _key(key: str, place: tuple[str, ...]) -> str:
    return key if _BARE.fullmatch(key) else _text(key, place)


def _text(text: str, place: tuple[str, ...]) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        where = ".".join(place).encode("utf-8", "backslashreplace").decode()
        raise ValueError(f"{where}: a scene holds Unicode, which {text!a} is not") from None
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any, place: tuple[str, ...]) -> str:
    plain = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(plain, bool):
        return "true" if plain else "false"
    if isinstance(plain, int):
        return str(plain)
    if isinstance(plain, float):
        return repr(plain) if math.isfinite(plain) else str(plain)
    if isinstance(plain, (str, os.PathLike)):
        return _text(os.fsdecode(plain), place)
    if isinstance(plain, Sequence):
        return "[" + ", ".join(_value(each, place) for each in plain) + "]"
    if isinstance(plain, Mapping):
        pairs = (f"{_key(str(key), place)} = {_value(each, (*place, str(key)))}" for key, each in plain.items())
        return "{ " + ", ".join(pairs) + " }"
    raise TypeError(f"{_dotted(place)}: a scene holds no {type(value).__name__}; leave a key out for nothing")
