"""How long one forecast takes, and how good the forecasts are.

Run ``python benchmarks/forecast.py``. Quality is that on the labelled colours which the
network never saw, designs apart. Times are processor time of one thread.
"""

from __future__ import annotations

import time

import numpy as np

from paintlink.model import ColorSpec, FloatArray, Lab, Sample
from paintlink.snap import forecast
from paintlink.snap.makeable import ANGLES_DEG, chances, data

COLOURS = 500


def main() -> None:
    """Print quality and times."""
    with np.load(data.FOLDER / data.LABELS) as labels:
        lab = labels["lab_hundredths"].astype(float) / 100.0
        made = labels["residual_thousandths"] <= 1000
        design = labels["design"]
    unseen = (np.arange(len(lab)) // 2) % 2 == 1
    chance = chances(lab)
    for name, which in (("all unseen", unseen), ("designs", unseen & design)):
        quality(name, chance[which], made[which])
    for colours in (lab[unseen][:1], lab[unseen][:COLOURS]):
        speed(colours)


def quality(name: str, chance: FloatArray, made: FloatArray) -> None:
    """Print area under the curve and calibration error."""
    able, unable = chance[made], np.sort(chance[~made])
    auc = np.searchsorted(unable, able).mean() / len(unable)
    bins = np.minimum((chance * 10).astype(int), 9)
    each = [bins == one for one in np.unique(bins)]
    error = sum(abs(chance[i].mean() - made[i].mean()) * i.mean() for i in each)
    print(
        f"{name:12s} {len(chance):5d} colours, {made.mean():.1%} makeable: "
        f"ROC AUC {auc:.4f}, expected calibration error {error:.4f}"
    )


def speed(colours: FloatArray) -> None:
    """Print the median and 99th percentile of a forecast."""
    seconds = []
    for lab in colours:
        samples = (
            Sample(angle, Lab(*values))
            for angle, values in zip(ANGLES_DEG, lab.tolist(), strict=True)
        )
        spec = ColorSpec(name="design", samples=tuple(samples))
        start = time.thread_time()
        forecast(spec)
        seconds.append(time.thread_time() - start)
    p50, p99 = np.percentile(seconds, [50, 99]) * 1e3
    print(f"{len(colours)} forecasts: p50 {p50:.2f} ms, p99 {p99:.2f} ms")


if __name__ == "__main__":
    main()
