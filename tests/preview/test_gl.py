from __future__ import annotations

import gc
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec, Gloss
from paintlink.preview import (
    backends,
    gl,
    light_names,
    object_names,
    painter,
    probe,
    render,
)
from tests.preview.truth import GREY, PEARL, RED, SILVER

pytestmark = pytest.mark.usefixtures("coarse_bake")

DULL = ColorSpec("dull", SILVER.samples, gloss=Gloss(20.0, 60.0))


@pytest.fixture(autouse=True, scope="module")
def opengl() -> str:
    try:
        probe.require_context()
    except PreviewError as error:
        pytest.skip(f"no OpenGL here: {error}")
    return gl.renderer()


@pytest.mark.parametrize("object", object_names())
@pytest.mark.parametrize("light", light_names())
@pytest.mark.parametrize(
    "specs",
    [
        [PEARL, GREY, RED, DULL],
        pytest.param([SILVER], marks=pytest.mark.proof),
        pytest.param([RED, DULL], marks=pytest.mark.proof),
    ],
)
def test_opengl_and_numpy_draw_the_same(
    object: str, light: str, specs: list[ColorSpec]
) -> None:
    by_gl, by_cpu = (
        render(specs, object=object, light=light, size=150, backend=backend)
        for backend in ("gl", "cpu")
    )

    difference = np.abs(by_gl.rgb.astype(int) - by_cpu.rgb)
    assert difference.max() <= 1
    assert (difference > 0).mean() < 0.03
    assert (by_gl.backend, by_cpu.backend) == ("gl", "cpu")


def test_many_bands_draw_the_same_too() -> None:
    by_gl, by_cpu = (
        render([RED, SILVER], size=700, backend=backend).rgb.astype(int)
        for backend in ("gl", "cpu")
    )

    assert np.abs(by_gl - by_cpu).max() <= 1


def test_automatic_choice_is_opengl_on_hardware_and_says_which(
    opengl: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(backends, "SOFTWARE", ())

    picture = render([SILVER], size=64)

    assert picture.backend == "gl"
    assert picture.reason == opengl


def test_automatic_choice_is_numpy_where_opengl_is_software(
    opengl: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(backends, "SOFTWARE", (opengl.split()[0].lower(),))

    picture = render([SILVER], size=64)

    assert picture.backend == "cpu"
    assert picture.reason == f"numpy: faster than {opengl}"


def test_threads_share_the_one_context() -> None:
    specs = [RED, SILVER, PEARL, GREY] * 4
    alone = [render([spec], size=96, backend="gl").rgb for spec in specs]

    with ThreadPoolExecutor(4) as pool:
        jobs = [pool.submit(render, [s], size=96, backend="gl") for s in specs]

    for job, expected in zip(jobs, alone, strict=True):
        np.testing.assert_array_equal(job.result().rgb, expected)


def test_driver_that_draws_wrong_colours_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    wrong = painter.FRAGMENT.replace("12.92", "12.92 + 1.0")
    monkeypatch.setattr(painter, "FRAGMENT", wrong.replace("1.055 *", "1.02 *"))

    with pytest.raises(PreviewError, match="draws other colours than it should"):
        painter.Painter()


def test_objects_of_old_bands_are_released() -> None:
    for size in range(40, 40 + 3 * painter.KEPT):
        render([RED], size=size, backend="gl")

    kept = gl._lend(
        lambda owned: (len(owned._textures._kept), len(owned._targets._kept))
    )
    assert kept == (painter.KEPT, painter.KEPT)


def test_memory_levels_off_over_many_pictures() -> None:
    sizes = [24, 25, 26, 27, 28, 29]

    def draw_all() -> None:
        for size in sizes:
            render([RED], object="sphere", size=size, backend="gl")

    for _ in range(20):
        draw_all()
    gc.collect()
    before = resident_kib()
    for _ in range(60):
        draw_all()

    gc.collect()
    assert resident_kib() - before < 8 * 1024


def resident_kib() -> int:
    lines = Path("/proc/self/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith("VmRSS")).split()[1])
