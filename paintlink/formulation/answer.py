"""Answers of formulation software: XML of unknown origin into values, and back."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from datetime import UTC, datetime
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, Final, cast

from lxml import etree

from paintlink.errors import AnswerError, SpecError
from paintlink.formulation.values import Answer, Component, Formula, Proposal
from paintlink.model import Lab, Observer, Origin, Sample
from paintlink.spec import decimal, safe_root

NAMESPACE: Final = "urn:paintlink:formula-answer:1"
_NAMES = {"a": NAMESPACE}

# An XMLSchema keeps the errors of its last run in itself, whoever ran it.
_LOCK = threading.Lock()


def schema_path() -> Path:
    """File of the schema, for other programs to validate with."""
    folder = resources.files("paintlink.formulation")
    return Path(str(folder / "formula-answer-1.xsd"))


def read_answer(data: bytes, *, source: str = "answer") -> Answer:
    """The answer in an XML document; nothing that it names is ever opened.

    Raises
    ------
    AnswerError
        When the document is refused, with the line and what to do next.
    """
    try:
        root = safe_root(data)
        _require_valid(root)
        return _answer(root)
    except (AnswerError, SpecError) as error:
        msg = f"{source}: {error}"
        raise AnswerError(msg) from error


def write_answer(answer: Answer) -> bytes:
    """The XML document of an answer."""
    created = answer.created_at.astimezone(UTC).replace(tzinfo=None)
    names: Any = {None: NAMESPACE}  # the stubs of lxml know no default namespace
    root = etree.Element(
        _tag("formulaAnswer"),
        {
            "job": answer.job,
            "iteration": str(answer.iteration),
            "origin": answer.origin,
            "program": answer.program,
            "created": f"{created.isoformat(timespec='seconds')}Z",
        },
        nsmap=names,
    )
    etree.SubElement(root, _tag("startingPaint"), {"code": answer.starting_paint})
    if answer.proposal is None:
        etree.SubElement(root, _tag("refusal")).text = answer.refusal
    else:
        _add_proposal(root, answer.proposal)
    if answer.note:
        etree.SubElement(root, _tag("note")).text = answer.note
    return etree.tostring(
        root, encoding="UTF-8", xml_declaration=True, pretty_print=True
    )


def _add_proposal(root: etree._Element, proposal: Proposal) -> None:
    formula = etree.SubElement(root, _tag("formula"))
    for one in proposal.formula.components:
        added = {"added": "true"} if one.added else {}
        values = {"toner": one.toner, "parts": decimal(one.parts)}
        etree.SubElement(formula, _tag("component"), values | added)
    predicted = etree.SubElement(
        root,
        _tag("predicted"),
        {"illuminant": "D65", "observer": proposal.observer},
    )
    for sample in proposal.predicted:
        numbers = {"aspecular": sample.aspecular_deg, **sample.lab._asdict()}
        values = {name: decimal(value) for name, value in numbers.items()}
        etree.SubElement(predicted, _tag("lab"), values)
    remaining = {"dE00": decimal(proposal.remaining_dE00)}
    etree.SubElement(root, _tag("remaining"), remaining)


def _answer(root: etree._Element) -> Answer:
    formula = root.find("a:formula", _NAMES)
    return Answer(
        job=root.get("job", ""),
        iteration=int(root.get("iteration", "0")),
        starting_paint=_child(root, "startingPaint").get("code", ""),
        proposal=None if formula is None else _proposal(root, formula),
        refusal=_text(root, "refusal"),
        origin=cast("Origin", root.get("origin")),
        program=root.get("program", ""),
        created_at=_time(root.get("created", "")),
        note=_text(root, "note"),
    )


def _proposal(root: etree._Element, formula: etree._Element) -> Proposal:
    predicted = _child(root, "predicted")
    return Proposal(
        Formula(tuple(_components(formula))),
        samples(predicted),
        cast("Observer", predicted.get("observer")),
        float(_child(root, "remaining").get("dE00", "nan")),
    )


def _components(formula: etree._Element) -> Iterable[Component]:
    for node in formula:
        added = node.get("added", "false") in {"true", "1"}
        yield Component(node.get("toner", ""), float(node.get("parts", "nan")), added)


def samples(parent: etree._Element) -> tuple[Sample, ...]:
    """Lab values of the children of an element, in ascending order of their angle."""
    found = [
        Sample(
            float(node.get("aspecular", "nan")),
            Lab(*(float(node.get(letter, "nan")) for letter in "Lab")),
        )
        for node in parent
    ]
    return tuple(sorted(found, key=lambda sample: sample.aspecular_deg))


def _time(text: str) -> datetime:
    """An aware time; one without a zone is taken as UTC."""
    try:
        moment = datetime.fromisoformat(text)
    except ValueError as error:
        msg = f"created={text!r} is no time that a calendar knows; write UTC"
        raise AnswerError(msg) from error
    return moment if moment.tzinfo else moment.replace(tzinfo=UTC)


def _child(root: etree._Element, name: str) -> etree._Element:
    found = root.find(f"a:{name}", _NAMES)
    if found is None:
        msg = f"<{name}> is missing"
        raise AnswerError(msg)
    return found


def _text(root: etree._Element, name: str) -> str:
    return (root.findtext(f"a:{name}", "", _NAMES) or "").strip()


def _tag(name: str) -> str:
    return f"{{{NAMESPACE}}}{name}"


def _require_valid(root: etree._Element) -> None:
    if root.tag != _tag("formulaAnswer"):
        msg = f'no answer to a job: expected <formulaAnswer xmlns="{NAMESPACE}">'
        raise AnswerError(msg)
    with _LOCK:
        schema = _schema()
        if schema.validate(root):
            return
        log: Any = schema.error_log
        line, what = log[0].line, log[0].message
    plain = what.replace(f"{{{NAMESPACE}}}", "")
    msg = f"line {line}: {plain} Correct the program that writes the answers."
    raise AnswerError(msg)


@cache
def _schema() -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(str(schema_path())))
