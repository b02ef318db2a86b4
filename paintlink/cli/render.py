"""Rendering one specification for the commands that have no job."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from paintlink.errors import ConfigError

if TYPE_CHECKING:
    from paintlink.export import ExportFile
    from paintlink.model import ColorSpec


def rendered(spec: ColorSpec, format_id: str) -> ExportFile:
    """The file of a format; a missing starting paint is looked up.

    Raises
    ------
    ConfigError
        When there is no such format.
    """
    from paintlink.export import JobFacts, load_formats, render
    from paintlink.spec import spec_id

    formats = load_formats(None)
    if format_id not in formats:
        msg = f"no export format {format_id!r}; there are {', '.join(sorted(formats))}"
        raise ConfigError(msg)
    chosen = formats[format_id]
    if chosen.requires_starting_paint and spec.starting_paint is None:
        spec = with_starting_paint(spec)
    origin = spec.provenance.origin if spec.provenance else "real"
    facts = JobFacts(spec_id(spec)[:10], datetime.now(UTC), origin)
    return render(spec, chosen, job=facts)


def with_starting_paint(spec: ColorSpec) -> ColorSpec:
    """The specification with the nearest paint of the bundled library."""
    from paintlink.library import bundled
    from paintlink.snap import nearest, starting_paint

    best = nearest(spec, bundled(), top=1)[0]
    return replace(spec, starting_paint=starting_paint(best))
