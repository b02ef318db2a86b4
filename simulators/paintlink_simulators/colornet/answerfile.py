"""The answers to paintlink, as a foreign program writes them.

Written from docs/formats.md, not from the code that reads the files.
"""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Any, Final

import numpy as np
from lxml import etree

from paintlink_simulators.colornet.formulation import Formulation
from paintlink_simulators.colornet.jobfile import ColorNetJob

ANSWER: Final = "urn:paintlink:formula-answer:1"
PROGRAM: Final = "ColorNet stand-in"


def formula_answer(job: ColorNetJob, found: Formulation, moment: datetime) -> bytes:
    """The answer that brings a formula."""
    root = _root(job, moment)
    formula = _child(root, "formula")
    for toner, parts in found.parts.items():
        added = {"added": "true"} if toner in found.added else {}
        _child(formula, "component", toner=toner, parts=f"{parts:.2f}", **added)
    observer = job.target.observer
    predicted = _child(root, "predicted", illuminant="D65", observer=observer)
    for angle, lab in zip(job.target.aspecular_deg, found.predicted, strict=True):
        values = dict(zip("Lab", map(_number, lab), strict=True))
        _child(predicted, "lab", aspecular=_number(angle), **values)
    remaining = float(job.target.mean_difference(found.predicted))
    _child(root, "remaining", dE00=_number(remaining))
    return _bytes(root)


def refusal_answer(job: ColorNetJob, why: str, moment: datetime) -> bytes:
    """The answer that says why there is no formula."""
    root = _root(job, moment)
    _child(root, "refusal").text = why
    return _bytes(root)


def _root(job: ColorNetJob, moment: datetime) -> etree._Element:
    created = moment.astimezone(UTC).replace(tzinfo=None)
    names: Any = {None: ANSWER}  # the stubs of lxml know no default namespace
    root = etree.Element(f"{{{ANSWER}}}formulaAnswer", nsmap=names)
    root.attrib.update({
        "job": job.id,
        "iteration": str(job.iteration),
        "origin": "simulated",
        "program": PROGRAM,
        "created": f"{created.isoformat(timespec='seconds')}Z",
    })
    _child(root, "startingPaint", code=job.starting_paint)
    return root


def _child(parent: etree._Element, tag: str, **attributes: str) -> etree._Element:
    return etree.SubElement(parent, f"{{{ANSWER}}}{tag}", attributes)


def _number(value: float) -> str:
    return np.format_float_positional(round(float(value), 6) + 0.0, trim="-")


def _bytes(root: etree._Element) -> bytes:
    return etree.tostring(
        root, encoding="UTF-8", xml_declaration=True, pretty_print=True
    )
