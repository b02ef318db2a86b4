"""Whether paints may come into a library: never others among those it holds."""

from __future__ import annotations

from dataclasses import replace

from paintlink.errors import LibraryError
from paintlink.library.generations import Generation
from paintlink.library.incoming import Incoming


def fitting(incoming: Incoming, head: Generation) -> Incoming:
    """The incoming paints at the angles of a library.

    Raises
    ------
    LibraryError
        When they were measured at other angles, for another observer, or when invented
        paints would come among real ones.
    """
    ours, theirs = head.conditions, incoming.conditions
    advice = "import them into a library of their own"
    if ours.observer != theirs.observer:
        msg = (
            f"{incoming.source} is for the {theirs.observer} degree observer, the "
            f"library {head.name} for {ours.observer} degrees: {advice}"
        )
        raise LibraryError(msg)
    if ours.synthetic != theirs.synthetic:
        kinds = {True: "synthetic", False: "real"}
        msg = (
            f"{incoming.source} holds {kinds[theirs.synthetic]} paints, the library "
            f"{head.name} {kinds[ours.synthetic]} ones: {advice}"
        )
        raise LibraryError(msg)
    missing = [one for one in ours.angles_deg if one not in theirs.angles_deg]
    if missing:
        msg = (
            f"{incoming.source} has no Lab at {missing[0]:g} degrees, as the paints of "
            f"the library {head.name} have: {advice}"
        )
        raise LibraryError(msg)
    places = [theirs.angles_deg.index(angle) for angle in ours.angles_deg]
    blocks = tuple(replace(one, lab=one.lab[:, places]) for one in incoming.blocks)
    return Incoming(incoming.source, ours, blocks)
