"""The job files of paintlink, as a foreign program reads them.

Written from docs/formats.md, not from the code that writes the files.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, cast

import numpy as np
from lxml import etree

from paintlink.errors import InputError
from paintlink.model import FloatArray, Observer, Origin
from paintlink_simulators.colornet.correction import Attempt
from paintlink_simulators.colornet.target import Target

JOB: Final = {"j": "urn:paintlink:colornet-job:1"}
_PARSER = etree.XMLParser(
    resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False
)


@dataclass(frozen=True, slots=True, eq=False)
class ColorNetJob:
    """What a job file asks for."""

    id: str
    iteration: int
    origin: Origin
    starting_paint: str
    target: Target
    attempts: tuple[Attempt, ...]


def read_job(data: bytes, source: str) -> ColorNetJob:
    """The job in a file.

    Raises
    ------
    InputError
        When it is no job file, or one of its numbers cannot be read.
    """
    try:
        return _job(etree.fromstring(data, _PARSER))
    except (etree.XMLSyntaxError, ValueError, IndexError, TypeError) as error:
        msg = f"{source} is no job file that this stand-in can read: {error}"
        raise InputError(msg) from error


def _job(root: etree._Element) -> ColorNetJob:
    target = _found(root, "j:target")[0]
    angles, lab = _labs(target)
    return ColorNetJob(
        id=str(root.attrib["id"]),
        iteration=int(root.attrib["iteration"]),
        origin=cast("Origin", root.attrib["origin"]),
        starting_paint=str(_found(root, "j:startingPaint/j:code")[0].text),
        target=Target(angles, lab, cast("Observer", target.attrib["observer"])),
        attempts=tuple(_attempt(panel, angles) for panel in _found(root, "j:panel")),
    )


def _attempt(panel: etree._Element, angles: FloatArray) -> Attempt:
    parts = {
        str(one.attrib["toner"]): float(one.attrib["parts"])
        for one in _found(panel, "j:formula/j:component")
    }
    predicted = _at(angles, _found(panel, "j:predicted")[0])
    return Attempt(parts, predicted, _at(angles, _found(panel, "j:measured")[0]))


def _at(angles: FloatArray, labs: etree._Element) -> FloatArray:
    """Lab at the angles of the target, in their order."""
    found, lab = _labs(labs)
    rows = [int(np.flatnonzero(found == angle)[0]) for angle in angles]
    return lab[rows]


def _labs(parent: etree._Element) -> tuple[FloatArray, FloatArray]:
    rows = [
        [float(one.attrib[name]) for name in ("aspecular", "L", "a", "b")]
        for one in _found(parent, "j:lab")
    ]
    table = np.array(rows, dtype=np.float64)
    return table[:, 0], table[:, 1:]


def _found(node: etree._Element, path: str) -> list[Any]:
    return list(cast("Any", node.xpath(path, namespaces=JOB)))
