"""Times as foreign programs write them."""

from __future__ import annotations

from datetime import UTC, datetime, tzinfo

from paintlink.errors import InputError

YEARS = range(1970, 2201)


def to_utc(moment: datetime, zone: tzinfo | None) -> datetime:
    """The same moment in UTC; a time without zone is in ``zone`` or the machine's own.

    Raises
    ------
    InputError
        When no instrument can have measured then.
    """
    if moment.year not in YEARS:
        msg = (
            f"the year {moment.year} is none an instrument has measured in: "
            "correct the time"
        )
        raise InputError(msg)
    if moment.tzinfo is None and zone is not None:
        moment = moment.replace(tzinfo=zone)
    return moment.astimezone(UTC)


def parse_time(text: str, zone: tzinfo | None, pattern: str = "") -> datetime:
    """The moment a text names, in UTC: ISO 8601, or by a ``strptime`` pattern.

    Raises
    ------
    InputError
        When it is no time of that form.
    """
    try:
        if pattern:
            moment = datetime.strptime(text.strip(), pattern)  # noqa: DTZ007
        else:
            moment = datetime.fromisoformat(text.strip())
    except ValueError as error:
        form = pattern or "2026-03-14 09:26:53"
        msg = f"not a time of the form {form}: correct it, or time_format in a profile"
        raise InputError(msg) from error
    return to_utc(moment, zone)


def from_seconds(seconds: float) -> datetime:
    """The moment so many seconds after 1970, in UTC.

    Raises
    ------
    InputError
        When no instrument can have measured then.
    """
    try:
        moment = datetime.fromtimestamp(seconds, UTC)
    except (OverflowError, ValueError, OSError) as error:
        msg = "no time in seconds since 1970: correct it or export again"
        raise InputError(msg) from error
    return to_utc(moment, UTC)
