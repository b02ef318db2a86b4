"""The lights of the routes."""

from __future__ import annotations

import shutil
from datetime import UTC, datetime, timedelta
from pathlib import Path

from paintlink.daemon.health import RouteHealth, health
from tests.daemon.conftest import make_spec
from tests.daemon.test_line import Shop


def lights(shop: Shop, after_s: float = 0.0) -> dict[str, RouteHealth]:
    now = datetime.now(UTC) + timedelta(seconds=after_s)
    return {one.route: one for one in health(shop.journal, shop.settings.routes, now)}


def test_idle_routes_are_green(tmp_path: Path) -> None:
    shop = Shop(tmp_path / "shop", "colornet", "json")

    assert {one.light for one in lights(shop).values()} == {"green"}


def test_refused_file_turns_its_route_red_at_once(tmp_path: Path) -> None:
    shop = Shop(tmp_path / "shop", "colornet", "json")
    shutil.rmtree(shop.folder / "colornet")
    shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()

    found = lights(shop)

    assert (found["colornet"].light, found["json"].light) == ("red", "green")
    assert "create it" in found["colornet"].note
    assert found["colornet"].waiting == 1


def test_folder_that_hangs_is_red_within_five_seconds(tmp_path: Path) -> None:
    shop = Shop(tmp_path / "shop", "colornet")
    shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.line._advance()

    assert lights(shop, 1.0)["colornet"].light == "green"
    late = lights(shop, 5.0)["colornet"]
    assert (late.light, late.note) == ("red", "nothing gets through")
    assert late.oldest_s >= 4.0
