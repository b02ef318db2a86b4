"""What many tests of pictures need."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from paintlink.preview import bake, coat, scene, store


@pytest.fixture(scope="module")
def coarse_bake() -> Iterator[None]:
    """Bakes in little time: for tests in which the colours need not be exact."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bake, "SIZE", 48)
        patch.setattr(bake, "COARSE_SIZE", 32)
        patch.setattr(coat, "FINE_SIZE", 64)
        patch.setattr(coat, "COARSE_SIZE", 48)
        forget()
        yield
    forget()


def forget() -> None:
    for kept in (store.base_table, store.coat_table, scene._band, scene._light):
        kept.cache_clear()
