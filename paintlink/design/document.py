"""A design as a JSON document: the same design always gives the same bytes."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from paintlink.design.catalogue import make_step
from paintlink.design.design import Design
from paintlink.design.parameters import Value
from paintlink.design.start import Start
from paintlink.design.step import Step
from paintlink.errors import DesignError, SpecError
from paintlink.model import ColorSpec, Finish, Gloss, Lab, Observer, Sample

FORMAT = "paintlink-design"
VERSION = 1
MAX_BYTES = 1 << 20
MOST_STEPS = 1000

Text = Annotated[str, Field(max_length=500)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class _Sample(_Part):
    aspecular_deg: float
    L: float
    a: float
    b: float


class _Gloss(_Part):
    value_gu: float
    angle_deg: float | None

    def value(self) -> Gloss:
        return Gloss(self.value_gu, self.angle_deg)


class _Color(_Part):
    name: Text
    code: Text
    finish: Finish
    observer: Observer
    gloss: _Gloss | None
    samples: list[_Sample]

    def spec(self) -> ColorSpec:
        samples = (
            Sample(one.aspecular_deg, Lab(one.L, one.a, one.b)) for one in self.samples
        )
        return ColorSpec(
            name=self.name,
            code=self.code,
            samples=tuple(samples),
            finish=self.finish,
            observer=self.observer,
            gloss=self.gloss.value() if self.gloss else None,
        )


class _Start(_Part):
    source: Text
    color: _Color


class _Step(_Part):
    step: Text
    parameters: dict[Text, float | Text | list[float] | _Color]

    def made(self) -> Step:
        return make_step(
            self.step,
            {
                name: value.spec() if isinstance(value, _Color) else value
                for name, value in self.parameters.items()
            },
        )


_Steps = Annotated[list[_Step], Field(max_length=MOST_STEPS)]


class _Document(_Part):
    format: Literal["paintlink-design"]
    version: int
    name: Text
    start: _Start
    steps: _Steps
    undone: _Steps


def to_json(design: Design) -> bytes:
    """The design as UTF-8 JSON; every number reads back as the same double.

    Raises
    ------
    DesignError
        When it is larger than `from_json` would read.
    """
    document = {
        "format": FORMAT,
        "version": VERSION,
        "name": design.name,
        "start": {
            "source": design.start.source,
            "color": color_document(design.start.spec),
        },
        "steps": [step_document(step) for step in design.steps],
        "undone": [step_document(step) for step in design.undone],
    }
    data = (json.dumps(document, indent=2, ensure_ascii=False) + "\n").encode()
    if len(data) > MAX_BYTES or len(design.steps) > MOST_STEPS:
        msg = (
            f"a design holds up to {MOST_STEPS} steps and {MAX_BYTES} bytes: "
            "export it and start a new one from there"
        )
        raise DesignError(msg)
    return data


def from_json(data: bytes, *, source: str | None = None) -> Design:
    """The design in a document, after its steps have been made once.

    Raises
    ------
    DesignError
        When the document is damaged, comes from a newer paintlink, or holds a step that
        cannot be made.
    """
    try:
        document = _Document.model_validate(_parsed(data))
        start = Start(document.start.color.spec(), document.start.source)
        design = Design(
            name=document.name,
            start=start,
            steps=tuple(step.made() for step in document.steps),
            undone=tuple(step.made() for step in document.undone),
        )
        design.history()
    except ValidationError as error:
        raise DesignError(_fault(error), source=source) from error
    except (DesignError, SpecError) as error:
        raise DesignError(str(error), source=source) from error
    return design


def step_document(step: Step) -> dict[str, Any]:
    """Name and parameters of a step."""
    values = {name: _plain(value) for name, value in step.values.items()}
    return {"step": step.name, "parameters": values}


def color_document(spec: ColorSpec) -> dict[str, Any]:
    """What a design keeps of a specification."""
    gloss = spec.gloss
    return {
        "name": spec.name,
        "code": spec.code,
        "finish": spec.finish,
        "observer": spec.observer,
        "gloss": gloss and {"value_gu": gloss.value_gu, "angle_deg": gloss.angle_deg},
        "samples": [
            {"aspecular_deg": one.aspecular_deg, **one.lab._asdict()}
            for one in spec.samples
        ],
    }


def _plain(value: Value) -> object:
    if isinstance(value, ColorSpec):
        return color_document(value)
    return list(value) if isinstance(value, Lab) else value


def _parsed(data: bytes) -> object:
    if len(data) > MAX_BYTES:
        msg = f"larger than {MAX_BYTES} bytes: no design needs as many"
        raise DesignError(msg)
    try:
        document = json.loads(data.decode())
    except (ValueError, RecursionError) as error:
        msg = f"not a JSON document ({error}): restore the file from a copy"
        raise DesignError(msg) from error
    version = document.get("version") if isinstance(document, dict) else None
    if isinstance(version, int) and version > VERSION:
        msg = (
            f"written by a newer paintlink (version {version}); "
            f"this one reads version {VERSION}: update paintlink"
        )
        raise DesignError(msg)
    return document


def _fault(error: ValidationError) -> str:
    first = error.errors()[0]
    place = ".".join(map(str, first["loc"])) or "the document"
    return f"not a design: {place}: {first['msg']}; restore the file from a copy"
