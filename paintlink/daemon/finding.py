"""Which of the ports that fit holds the configured instrument: the one that says so."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack

from paintlink.config import InstrumentSettings
from paintlink.daemon.session import Session
from paintlink.errors import (
    InstrumentError,
    LinkError,
    PaintlinkError,
    ProtocolError,
    WrongInstrumentError,
)
from paintlink.links import kind_of, matches

OpenSession = Callable[[str], Session]


def connect(settings: InstrumentSettings, open_session: OpenSession) -> Session:
    """An identified session at the configured port, or at the one of many that fits.

    Parameters
    ----------
    open_session
        Opens a session at a port.

    Raises
    ------
    LinkError, ProtocolError, InstrumentError
        When no instrument answers as it should.
    WrongInstrumentError
        When more than one does: nobody can say which is meant.
    """
    if kind_of(settings.port) != "device":
        return open_session(settings.port)
    ports = matches(settings.port)
    if not ports:
        msg = f"no device fits {settings.port}: plug the instrument in"
        raise LinkError(msg)
    if len(ports) == 1:
        return open_session(ports[0])
    return _only_one(settings, ports, open_session)


def _only_one(
    settings: InstrumentSettings, ports: list[str], open_session: OpenSession
) -> Session:
    faults: list[str] = []
    with ExitStack() as undo:
        found = []
        for port in ports:
            try:
                found.append(undo.enter_context(open_session(port)))
            except (LinkError, ProtocolError, InstrumentError) as fault:
                faults.append(f"{port}: {fault}")
        if len(found) == 1:
            undo.pop_all()
            return found[0]
        raise _undecided(settings, found, faults)


def _undecided(
    settings: InstrumentSettings, found: list[Session], faults: list[str]
) -> PaintlinkError:
    if not found:
        tried = "\n".join(faults)
        msg = f"none of the {len(faults)} devices is {settings.driver}:\n{tried}"
        return LinkError(msg)
    places = " and ".join(
        f"{one.port} (serial number {one.instrument.serial or 'unknown'})"
        for one in found
    )
    msg = (
        f"{places} fit {settings.name}: write the `serial` of the one you mean, or its "
        "name in /dev/serial/by-id as `port`"
    )
    return WrongInstrumentError(msg)
