"""Files for other programs: stylesheets, rendering, atomic delivery."""

from paintlink.export.delivery import (
    Outcome,
    discard,
    outcome,
    publish,
    publish_many,
    stage,
    stage_many,
)
from paintlink.export.folders import GUARD, require_share
from paintlink.export.formats import Format, Formats, load_format, load_formats
from paintlink.export.labels import LabelKind, label
from paintlink.export.names import safe_name
from paintlink.export.probe import probe
from paintlink.export.render import ExportFile, JobFacts, file_name, render

__all__ = [
    "GUARD",
    "ExportFile",
    "Format",
    "Formats",
    "JobFacts",
    "LabelKind",
    "Outcome",
    "discard",
    "file_name",
    "label",
    "load_format",
    "load_formats",
    "outcome",
    "probe",
    "publish",
    "publish_many",
    "render",
    "require_share",
    "safe_name",
    "stage",
    "stage_many",
]
