"""The configuration file that says the same as no file, every key explained."""

from __future__ import annotations

import inspect
from dataclasses import MISSING, Field, fields
from textwrap import wrap
from typing import Any, get_args

from paintlink.config._document import REPEATED, SECTIONS, keys
from paintlink.config._keys import Key, allowed
from paintlink.config._toml import toml

WIDTH = 78
HEAD = """\
# Configuration of paintlink.
#
# A line that begins with "# " explains. A line that begins with "#" and no blank is a
# setting that is switched off: take the "#" away to use it. A setting that is written
# out has its default value: change the value to change it, or leave the line alone.
#
# A folder that does not begin with "/" is seen from the folder of this file.
#
# After a change run `paintlink config check`: it names every mistake at once.
"""


def explain() -> str:
    """Every key with its meaning, its limits and its default, as a file to start from.

    Keys that have no default are switched off, and so are the sections that may be
    repeated.
    """
    return "\n".join([HEAD, *(_section(name) for name in SECTIONS)]).rstrip()


def _section(name: str) -> str:
    text = " ".join(inspect.cleandoc(SECTIONS[name].__doc__ or "").split())
    head = f"#[[{name}]]" if name in REPEATED else f"[{name}]"
    hints = keys(name)
    blocks = [
        _key(field, hints[field.name], off=name in REPEATED)
        for field in fields(SECTIONS[name])
    ]
    return "\n".join([*_comment(text), head, "", *blocks])


def _key(field: Field[Any], hint: object, *, off: bool) -> str:
    key = next(part for part in get_args(hint) if isinstance(part, Key))
    default = _default(field)
    shown = key.example if default is None else default
    mark = "#" if off or default is None else ""
    return "\n".join([
        *_comment(key.meaning),
        *_comment(f"Write {allowed(hint)}."),
        *_comment(_without(field, key)),
        f"{mark}{field.name} = {toml(shown)}",
        "",
    ])


def _default(field: Field[Any]) -> object:
    if field.default_factory is not MISSING:
        return field.default_factory()
    return None if field.default is MISSING else field.default


def _without(field: Field[Any], key: Key) -> str:
    if key.unset:
        return f"Left out: {key.unset}."
    needed = field.default is MISSING and field.default_factory is MISSING
    return "It has no default and must be written." if needed else ""


def _comment(text: str) -> list[str]:
    return [f"# {line}" for line in wrap(text, WIDTH)]
