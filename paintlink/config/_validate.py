"""Types, limits and unknown keys of the file, checked by pydantic in one pass."""

from __future__ import annotations

import json

from pydantic import ConfigDict, TypeAdapter, ValidationError, with_config
from pydantic_core import ErrorDetails

from paintlink.config._document import REPEATED, SECTIONS, Document, keys
from paintlink.config._faults import Fault
from paintlink.config._tables import Table
from paintlink.config._texts import missing, unknown, wrong

_ADAPTER = TypeAdapter(with_config(ConfigDict(extra="forbid", strict=True))(Document))


def validate(table: Table) -> tuple[Document | None, list[Fault]]:
    """The document, or all that is wrong with it.

    The table goes through JSON because pydantic then insists on the written types and
    still builds dataclasses and tuples from tables and lists.
    """
    try:
        return _ADAPTER.validate_json(json.dumps(table, default=str)), []
    except ValidationError as error:
        return None, [_fault(one) for one in error.errors(include_url=False)]


def _fault(error: ErrorDetails) -> Fault:
    section, *rest = map(str, error["loc"])
    if section not in SECTIONS:
        return Fault("", None, "", _outside(section, error["input"]))
    index = int(rest.pop(0)) if rest and section in REPEATED else None
    if not rest:
        return Fault(section, index, "", _wrong_kind(section))
    return Fault(section, index, rest[0], _about_key(section, rest[0], error))


def _outside(name: str, value: object) -> str:
    if isinstance(value, dict | list):
        return unknown("section", name, SECTIONS)
    return f'key "{name}" stands outside every section: move it below one like [site]'


def _wrong_kind(section: str) -> str:
    if section in REPEATED:
        return f"write [[{section}]], in double brackets, and its keys below it"
    return f"write [{section}] once, in single brackets, and its keys below it"


def _about_key(section: str, key: str, error: ErrorDetails) -> str:
    known = keys(section)
    if key not in known:
        return unknown("key", key, known)
    if error["type"] == "missing":
        return missing(key, known[key])
    return wrong(key, error["input"], known[key])
