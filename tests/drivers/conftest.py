import pytest

from tests.drivers import ma_peer as ma


@pytest.fixture
def peer():
    """Return a peer that holds the golden transcript."""
    return ma.Peer(ma.golden_answers(), report=ma.golden_report())
