"""paintlink's own colour specification."""

from __future__ import annotations

from paintlink.intake.contract import Certainty, Contents, ImporterInfo, Options
from paintlink.intake.source import Source
from paintlink.spec import read_spec

INFO = ImporterInfo("paintlink_xml", "paintlink colour specification (XML)")


def sniff(source: Source) -> Certainty:
    """Sure of its own namespace; any other XML may still get a good message here."""
    if "urn:paintlink:color-specification:" in source.head:
        return Certainty.SURE
    return Certainty.MAYBE if source.head.startswith("<") else Certainty.NO


def read(source: Source, options: Options) -> Contents:
    """The one specification of the file."""
    return Contents(specs=(read_spec(source.data, source=source.name),))
