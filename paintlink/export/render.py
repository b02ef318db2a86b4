"""From a colour specification to a file for another program: its bytes, its name."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from datetime import UTC, datetime

from paintlink.errors import ExportError
from paintlink.export.formats import Format
from paintlink.export.names import SIMULATED_PREFIX, job_hash, safe_name
from paintlink.export.stylesheet import run_stylesheet
from paintlink.formulation import Panel, with_history
from paintlink.model import ColorSpec, Origin
from paintlink.spec import write_spec


@dataclass(frozen=True, slots=True)
class JobFacts:
    """What a file says about the job it belongs to.

    ``id`` is unique for ever; ``created_at`` is an aware time; ``copy`` counts explicit
    resends from 1. ``panels`` have been sprayed with earlier answers to the job.
    """

    id: str
    created_at: datetime
    origin: Origin
    copy: int = 1
    panels: tuple[Panel, ...] = ()


@dataclass(frozen=True, slots=True)
class ExportFile:
    """A file as it will be delivered; ``sha256`` is the hash of ``data`` in hex."""

    name: str
    data: bytes
    format_id: str
    sha256: str


def render(
    spec: ColorSpec, format: Format, *, job: JobFacts, document: bytes = b""
) -> ExportFile:
    """The file of a job in one format.

    Parameters
    ----------
    document
        The specification as `write_spec` wrote it, where that is at hand.

    Raises
    ------
    ExportError
        Kind ``starting-paint`` when the format needs one and the specification has
        none; kind ``format`` when the stylesheet fails on this specification.
    """
    if format.requires_starting_paint and not _paint_code(spec):
        msg = (
            f"{format.label} needs a starting paint and {spec.name!r} has none; "
            "run ColorSnap first (paintlink snap)"
        )
        raise ExportError(msg, kind="starting-paint")
    data = run_stylesheet(
        format.transform,
        with_history(document or write_spec(spec), job.panels),
        _parameters(spec, job),
        format.source,
    )
    return ExportFile(
        name=file_name(spec, format, job),
        data=data,
        format_id=format.id,
        sha256=hashlib.sha256(data).hexdigest(),
    )


def file_name(spec: ColorSpec, format: Format, job: JobFacts) -> str:
    """Name of the file of a job in one format; no other job or format has the same."""
    key = f"{job.id}\0{format.id}\0{job.copy}"
    created = job.created_at.astimezone(UTC)
    text = format.name_pattern.format(
        date=f"{created:%Y%m%d}",
        time=f"{created:%H%M%S}",
        name=spec.name,
        code=spec.code,
        paint=_paint_code(spec),
        format=format.id,
        copy=job.copy,
        id6=job_hash(key)[:6],
    )
    prefix = SIMULATED_PREFIX if _origin(spec, job) == "simulated" else ""
    return safe_name(prefix + text, suffix=format.suffix, key=key)


def _paint_code(spec: ColorSpec) -> str:
    return spec.starting_paint.code if spec.starting_paint else ""


def _origin(spec: ColorSpec, job: JobFacts) -> Origin:
    """``simulated`` as soon as either the job or the measurement says so."""
    origins = {job.origin, spec.provenance.origin if spec.provenance else job.origin}
    return "simulated" if "simulated" in origins else "real"


def _parameters(spec: ColorSpec, job: JobFacts) -> dict[str, str]:
    created = job.created_at.astimezone(UTC).replace(tzinfo=None, microsecond=0)
    return {
        "job-id": job.id,
        "created-at": f"{created.isoformat()}Z",
        "origin": _origin(spec, job),
        "copy": str(job.copy),
        "iteration": str(len(job.panels)),
    }
