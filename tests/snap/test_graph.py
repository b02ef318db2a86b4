"""The data of the 3D graph, and its picture."""

from __future__ import annotations

import io
import json
import sys
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from paintlink.color import lab_to_hex
from paintlink.errors import ConfigError
from paintlink.library import bundled, find, paint_spec
from paintlink.model import PaintTable
from paintlink.snap import nearest
from paintlink.snap.graph import MOST_PAINTS, Graph, graph, plotly
from paintlink.snap.picture import picture
from tests.snap.conftest import STANDARD, make_table, make_target


@pytest.fixture(scope="module")
def drawn() -> Graph:
    table = bundled()
    design = paint_spec(table, find(table, "RM209")).lab(*STANDARD) * (1.0, 1.35, 1.35)
    spec = make_target(design)
    return graph(spec, nearest(spec, table, top=6), table)


def test_target_nearest_and_candidates_have_their_own_lab(drawn: Graph) -> None:
    table = bundled()

    assert drawn.nearest.label == "RM209"
    assert len(drawn.others) == 5
    expected = paint_spec(table, find(table, "RM209")).lab(*STANDARD)
    np.testing.assert_allclose(drawn.nearest.lab, expected, atol=1e-9)
    assert drawn.target.colors[1] == lab_to_hex(drawn.target.lab[1])


def test_whole_library_is_there_with_its_travel(drawn: Graph) -> None:
    table = bundled()
    row = find(table, "RM331")

    assert drawn.library.shape == (len(table), 3, 3)
    assert drawn.library_codes[row] == "RM331"
    expected = paint_spec(table, row).lab(*STANDARD)
    np.testing.assert_array_equal(drawn.library[row], expected)
    assert "#" + bytes(drawn.library_colors[row]).hex() == lab_to_hex(expected[1])


def test_plotly_document_is_strict_json_with_matching_lengths(drawn: Graph) -> None:
    document = json.loads(json.dumps(plotly(drawn), allow_nan=False))

    names = [trace["name"] for trace in document["data"]]
    assert names[-2:] == ["RM209", "target"]
    for trace in document["data"]:
        assert trace["type"] == "scatter3d"
        colors = trace.get("line", trace.get("marker"))["color"]
        assert len(trace["x"]) == len(trace["y"]) == len(trace["z"]) == len(colors)
    travel = next(t for t in document["data"] if t["name"].startswith("travel"))
    assert travel["x"][3::4] == [None] * len(drawn.library)
    assert document["layout"]["scene"]["zaxis"]["title"]["text"] == "L*"


def test_lightness_points_upwards(drawn: Graph) -> None:
    target = plotly(drawn)["data"][-1]

    assert target["z"] == np.round(drawn.target.lab[:, 0], 2).tolist()
    assert target["x"] == np.round(drawn.target.lab[:, 1], 2).tolist()


def test_large_library_is_thinned_and_gaps_left_out() -> None:
    lab = np.full((MOST_PAINTS + 5, 3, 3), 50.0)
    lab[2, 1, 0] = np.nan
    table = make_table(lab)
    spec = make_target(np.full((3, 3), 50.0))

    drawn = graph(spec, nearest(spec, table, top=3), table)

    assert len(drawn.library) == len(drawn.library_codes) <= MOST_PAINTS
    assert np.isfinite(drawn.library).all()


def small(table: PaintTable) -> PaintTable:
    return replace(
        table,
        ids=table.ids[:80],
        codes=table.codes[:80],
        names=table.names[:80],
        finishes=table.finishes[:80],
        lab=table.lab[:80],
        gloss_gu=None,
        facets={},
    )


def test_picture_shows_the_target_in_its_own_colour() -> None:
    table = small(bundled())
    spec = make_target([[60.0, 0.0, 90.0]] * 3)

    data = picture(graph(spec, nearest(spec, table, top=3), table))

    pixels = np.array(Image.open(io.BytesIO(data)).convert("RGB")).reshape(-1, 3)
    wanted = np.frombuffer(
        bytes.fromhex(lab_to_hex((60.0, 0.0, 90.0))[1:]), dtype=np.uint8
    )
    near = np.abs(pixels.astype(int) - wanted.astype(int)).max(axis=1) <= 2
    assert near.sum() > 40


def test_picture_without_matplotlib_says_what_to_install(
    drawn: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)

    with pytest.raises(ConfigError, match=r"pip install 'paintlink\[plots\]'"):
        picture(drawn)
