"""Orders from other programs: what is to be measured, as XML or JSON."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from typing import Any, Final

from lxml import etree

from paintlink.errors import InputError, SpecError
from paintlink.intake.vin import vin_problem
from paintlink.spec import safe_root

NAMESPACE: Final = "urn:paintlink:order:1"
LONGEST = 200


@dataclass(frozen=True, slots=True)
class Order:
    """A sample to be measured, for whom and how; empty where it does not say."""

    sample: str
    template: str = ""
    repair_order: str = ""
    vin: str = ""
    paint_code: str = ""
    panel: str = ""
    operator: str = ""

    def document(self) -> dict[str, str]:
        """The same as a plain mapping."""
        return asdict(self)


NAMES = tuple(field.name for field in fields(Order))


def read_order(data: bytes, *, source: str) -> Order:
    """The order in a file.

    Raises
    ------
    InputError
        Naming the file and what is wrong with it.
    """
    try:
        is_xml = data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith((b"<", b"\xff\xfe"))
        values = _from_xml(data) if is_xml else _from_json(data)
        return _checked(values)
    except (InputError, SpecError) as error:
        msg = f"{source}: {error}"
        raise InputError(msg) from error


def _from_xml(data: bytes) -> dict[str, Any]:
    root = safe_root(data)
    if root.tag != f"{{{NAMESPACE}}}order":
        msg = f'no order: expected <order xmlns="{NAMESPACE}">'
        raise InputError(msg)
    return {etree.QName(child).localname: child.text or "" for child in root}


def _from_json(data: bytes) -> dict[str, Any]:
    try:
        values = json.loads(data.decode("utf-8-sig"))
    except (UnicodeDecodeError, ValueError, RecursionError) as error:
        msg = f"neither XML nor JSON ({error}); write it again"
        raise InputError(msg) from error
    if not isinstance(values, dict):
        msg = "expected one JSON object with the fields of an order"
        raise InputError(msg)
    return values


def _checked(values: dict[str, Any]) -> Order:
    unknown = [name for name in values if name not in NAMES]
    if unknown:
        msg = f"unknown field {unknown[0]!r}; there are {', '.join(NAMES)}"
        raise InputError(msg)
    for name, value in values.items():
        if not isinstance(value, str) or len(value) > LONGEST:
            msg = f"{name} must be a text of at most {LONGEST} characters"
            raise InputError(msg)
    order = Order(**{"sample": "", **{k: v.strip() for k, v in values.items()}})
    if not order.sample:
        msg = "sample is missing: the name that the reading will have"
        raise InputError(msg)
    problem = vin_problem(order.vin) if order.vin else None
    if problem:
        raise InputError(problem)
    return order
