from datetime import UTC, datetime

import pytest

from tests.drivers import ma_peer as ma


@pytest.fixture
def peer():
    """Return a peer that holds the golden transcript."""
    return ma.Peer(ma.golden_answers(), report=ma.golden_report())


@pytest.fixture
def aware_now():
    """Return one moment with its time zone."""
    return datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)
