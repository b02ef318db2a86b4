"""Specifications as the journal stores them; recent ones are not read again."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock

from paintlink.model import ColorSpec
from paintlink.spec import read_spec, write_spec

LATELY = 256  # about ten MiB with spectra of five angles

_known: OrderedDict[bytes, ColorSpec] = OrderedDict()
_lock = Lock()


def stored(spec: ColorSpec) -> bytes:
    """The canonical form, which reads back as the same value."""
    document = write_spec(spec)
    _remember(document, spec)
    return document


def restored(document: bytes) -> ColorSpec:
    """The specification of a stored document.

    Raises
    ------
    SpecError
        When the document was changed since.
    """
    with _lock:
        spec = _known.get(document)
    if spec is None:
        spec = read_spec(document)
        _remember(document, spec)
    return spec


def _remember(document: bytes, spec: ColorSpec) -> None:
    with _lock:
        _known[document] = spec
        if len(_known) > LATELY:
            _known.popitem(last=False)
