"""The panels of a job as an element behind its colour specification.

Stylesheets that know nothing of it copy nothing of it: all its values are attributes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from lxml import etree

from paintlink.formulation.values import Panel
from paintlink.model import Sample
from paintlink.spec import decimal

HISTORY: Final = "urn:paintlink:formulation-history:1"


def with_history(spec: bytes, panels: Sequence[Panel]) -> bytes:
    """The document of a specification, with the panels as its last child."""
    if not panels:
        return spec
    root = etree.fromstring(spec)
    history = etree.SubElement(root, _tag("history"))
    for panel in panels:
        node = etree.SubElement(
            history, _tag("panel"), {"iteration": f"{panel.iteration}"}
        )
        for one in panel.proposal.formula.components:
            values = {"toner": one.toner, "parts": decimal(one.parts)}
            etree.SubElement(node, _tag("component"), values)
        _add_labs(node, "predicted", panel.proposal.predicted)
        _add_labs(node, "measured", panel.measured)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True)


def _add_labs(node: etree._Element, name: str, samples: Sequence[Sample]) -> None:
    for sample in samples:
        numbers = {"aspecular": sample.aspecular_deg, **sample.lab._asdict()}
        values = {key: decimal(value) for key, value in numbers.items()}
        etree.SubElement(node, _tag(name), values)


def _tag(name: str) -> str:
    return f"{{{HISTORY}}}{name}"
