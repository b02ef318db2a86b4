"""A renderer by other people comes to the same colours."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from paintlink.model import FloatArray
from paintlink.preview import basis, disc, environment, store
from tests.preview import truth

pytestmark = [pytest.mark.proof, pytest.mark.timeout(600)]

SIDE = 96
SAMPLES = 256
OUR_ERROR = 0.02
"""Mean dE00 that `test_accuracy` proves."""

PAINTS = (truth.RED, truth.SILVER, truth.PEARL)


def renderer() -> Any:
    """Mitsuba with a material whose reflectance depends on the aspecular angle."""
    mi = pytest.importorskip("mitsuba")
    mi.set_variant("llvm_ad_rgb")
    import drjit as dr

    class Paint(mi.BSDF):  # type: ignore[misc, name-defined]
        def __init__(self, props: Any) -> None:
            mi.BSDF.__init__(self, props)
            factors = truth.rgb_from_lab(truth.sheet_curve(PAINTS[int(props["paint"])]))
            self.table = [mi.Float(np.ascontiguousarray(part)) for part in factors.T]
            flags = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide
            self.m_components, self.m_flags = [flags], flags

        def value(self, si: Any, wo: Any) -> Any:
            mirror = mi.Vector3f(-si.wi.x, -si.wi.y, si.wi.z)
            cosine = dr.clip(dr.dot(mirror, wo), -1, 1)
            place = dr.acos(cosine) * (180 / np.pi) / truth.STEP_DEG
            left = dr.minimum(mi.UInt32(place), len(truth.BIN_DEG) - 2)
            share = place - mi.Float(left)
            parts = [
                dr.gather(mi.Float, t, left) * (1 - share)
                + dr.gather(mi.Float, t, left + 1) * share
                for t in self.table
            ]
            return mi.Color3f(*parts) * (dr.maximum(wo.z, 0) / np.pi)

        def sample(self, ctx: Any, si: Any, _one: Any, two: Any, active: Any) -> Any:
            drawn = mi.BSDFSample3f()
            drawn.wo = mi.warp.square_to_cosine_hemisphere(two)
            drawn.pdf = mi.warp.square_to_cosine_hemisphere_pdf(drawn.wo)
            drawn.eta = 1.0
            drawn.sampled_type = mi.UInt32(+mi.BSDFFlags.DiffuseReflection)
            drawn.sampled_component = 0
            good = active & (si.wi.z > 0) & (drawn.pdf > 0)
            return drawn, self.value(si, drawn.wo) / drawn.pdf & good

        def eval(self, ctx: Any, si: Any, wo: Any, active: Any) -> Any:
            return self.value(si, wo) & (active & (si.wi.z > 0) & (wo.z > 0))

        def pdf(self, ctx: Any, si: Any, wo: Any, active: Any) -> Any:
            pdf = mi.warp.square_to_cosine_hemisphere_pdf(wo)
            return dr.select(active & (si.wi.z > 0) & (wo.z > 0), pdf, 0)

        def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any) -> Any:
            return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    mi.register_bsdf("aspecular", Paint)
    # the first scene with an environment comes out black in this version
    np.array(mi.render(scene(mi, 0), spp=1))
    return mi


def scene(mi: Any, paint: int) -> Any:
    light = environment.load("studio")
    grid = (light.grid * light.exposure).astype(np.float32)
    towards = mi.ScalarTransform4f().look_at([0, 0, 5], [0, 0, 0], [0, 1, 0])
    film = {"type": "hdrfilm", "width": SIDE, "height": SIDE, "pixel_format": "rgb"}
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "direct", "hide_emitters": True},
        "sensor": {
            "type": "orthographic",
            "to_world": towards,
            "film": {**film, "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"},
        },
        "light": {"type": "envmap", "bitmap": mi.Bitmap(grid)},
        "ball": {"type": "sphere", "bsdf": {"type": "aspecular", "paint": paint}},
    })


def ball() -> tuple[FloatArray, FloatArray]:
    """Normals of 4 x 4 samples in each pixel, and which pixels lie well inside."""
    across = 2 * (np.arange(4 * SIDE) + 0.5) / (4 * SIDE) - 1
    x, y = np.meshgrid(across, -across)
    z = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    inside = z.reshape(SIDE, 4, SIDE, 4).min(axis=(1, 3)) > 0.15
    return np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32), inside


def test_mitsuba_agrees_within_its_own_noise(
    record_property: Callable[[str, object], None],
) -> None:
    mi = renderer()
    normals, inside = ball()
    light = environment.load("studio")
    start = time.perf_counter()
    table = store.base_table(light, None)
    bake_s = time.perf_counter() - start
    samples = disc.look_up(table, normals).reshape(SIDE, 4, SIDE, 4, -1)
    terms = samples.mean(axis=(1, 3))
    for number, spec in enumerate(PAINTS):
        start = time.perf_counter()
        first, second = (
            np.array(mi.render(scene(mi, number), spp=SAMPLES, seed=seed))[..., :3]
            for seed in (1, 2)
        )
        theirs_s = (time.perf_counter() - start) / 2
        start = time.perf_counter()
        ours = (terms @ basis.coefficients([spec])[0].astype(np.float32))[inside]
        ours_s = time.perf_counter() - start
        mean = ((first.astype(float) + second) / 2)[inside]

        noise = truth.difference(first.astype(float), second.astype(float))[inside]
        error = truth.difference(mean, ours).mean()
        energy = (mean @ truth.XYZ_FROM_RGB[1]).sum() / (
            ours @ truth.XYZ_FROM_RGB[1]
        ).sum()

        # the mean of two runs is half as far from the truth as they are apart
        assert error < 0.6 * noise.mean()
        assert energy == pytest.approx(1, abs=0.002)
        # its error falls with the root of its time
        equal_s = theirs_s * float(noise.mean() / np.sqrt(2) / OUR_ERROR) ** 2
        record_property(f"times faster, paint {number}", equal_s / ours_s)
        record_property(
            f"times faster with the bake, paint {number}", equal_s / (bake_s + ours_s)
        )
