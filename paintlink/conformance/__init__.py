"""The exam every driver takes: its simulator, every fault, every connection."""

from paintlink.conformance._cases import Case, Result, Verdict
from paintlink.conformance._subjects import Subject, subject, subjects
from paintlink.conformance.exam import (
    CHUNKS,
    EXCHANGES,
    cases,
    differences,
    examine,
    examine_all,
)
from paintlink.conformance.mutations import Report, mutate
from paintlink.conformance.report import failed, rows
from paintlink.conformance.stands import TRANSPORTS, transports_of

__all__ = [
    "CHUNKS",
    "EXCHANGES",
    "TRANSPORTS",
    "Case",
    "Report",
    "Result",
    "Subject",
    "Verdict",
    "cases",
    "differences",
    "examine",
    "examine_all",
    "failed",
    "mutate",
    "rows",
    "subject",
    "subjects",
    "transports_of",
]
