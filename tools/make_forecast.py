"""Make the data of the forecast: cloud, labels and network.

Run the two steps from the root of the repository, with the tools on the path:

    PYTHONPATH=tools python tools/make_forecast.py label FILE.csv [--part 0/3]
    PYTHONPATH=tools python tools/make_forecast.py learn FILE.csv...

``label`` asks the formulation stand-in about each colour, which takes some minutes to
an hour; it may be stopped and started again, and the work shared between processes by
parts with a file each. Set OPENBLAS_NUM_THREADS=1. ``learn`` takes a minute and writes
paintlink/snap/makeable/data.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from forecast.colours import colours, formulas
from forecast.labels import MAKEABLE_DE00, Bench, label
from forecast.learn import area_under_curve, calibration_error, learn, log_odds

from paintlink.snap.makeable.data import CLOUD, FOLDER, LABELS, NETWORK, STEP, cloud_of
from paintlink.snap.makeable.features import features, nearest, place

CLOUD_PAINTS = 120_000
BENCH_PAINTS = 60_000
SEED = 7
LABELLED = 6_000


def main() -> None:
    """Run one step."""
    step, *arguments = sys.argv[1:]
    if step == "label":
        path, *rest = arguments
        which, shares = (rest[1] if rest else "0/1").split("/")
        parts = formulas(BENCH_PAINTS, SEED)
        bench = Bench(parts, colours(parts))
        label(Path(path), bench, LABELLED, (int(which), int(shares)))
    else:
        write(list(map(Path, arguments)))


def write(paths: Sequence[Path]) -> None:
    """Write cloud, labels and network; print how well unseen colours are forecast."""
    FOLDER.mkdir(exist_ok=True)
    steps = np.rint(place(colours(formulas(CLOUD_PAINTS, SEED))) / STEP)
    np.save(FOLDER / CLOUD, steps.astype(np.int16))
    cloud = cloud_of(steps.astype(np.int16))
    squares = (cloud * cloud).sum(axis=1)
    kinds, residuals, lab = read(paths)
    np.savez_compressed(
        FOLDER / LABELS,
        design=kinds,
        residual_thousandths=np.minimum(np.rint(residuals * 1000.0), 65_535).astype(
            np.uint16
        ),
        lab_hundredths=np.rint(lab * 100.0).astype(np.int16),
    )
    spots = place(lab)
    x = np.array([
        features(cloud[nearest(cloud, squares, s)].astype(float), s) for s in spots
    ])
    made, seen = residuals <= MAKEABLE_DE00, trained_on(len(lab))
    mean, scale = x[seen].mean(axis=0), x[seen].std(axis=0)
    networks = learn((x[seen] - mean) / scale, made[seen])
    arrays = [np.array(one) for one in zip(*networks, strict=True)]
    weights = dict(zip(("inner", "bias", "outer", "offset"), arrays, strict=True))
    np.savez(FOLDER / NETWORK, mean=mean, scale=scale, **weights)
    score = log_odds(networks, (x - mean) / scale)
    for name, which in (("all unseen", ~seen), ("unseen designs", ~seen & kinds)):
        report(name, score[which], made[which])


def read(paths: Sequence[Path]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Whether a design, residual and Lab of each label: as many designs as paints."""
    rows = [row for path in paths for row in _rows(path)]
    paints = [row for row in rows if row[0] == "paint"]
    designs = [row for row in rows if row[0] == "design"]
    both = [row for pair in zip(paints, designs, strict=False) for row in pair]
    values = np.array([[float(text) for text in row[1:]] for row in both])
    kinds = np.array([row[0] == "design" for row in both])
    return kinds, values[:, 0], values[:, 1:].reshape(-1, 3, 3)


def trained_on(count: int) -> np.ndarray:
    """Every other pair; the rest is never seen while learning."""
    return (np.arange(count) // 2) % 2 == 0


def report(name: str, score: np.ndarray, made: np.ndarray) -> None:
    """Print the quality of a forecast."""
    chance = 1.0 / (1.0 + np.exp(-score))
    print(
        f"{name}: {len(made)} colours, {made.mean():.1%} makeable, "
        f"ROC AUC {area_under_curve(score, made):.4f}, "
        f"expected calibration error {calibration_error(chance, made):.4f}"
    )


def _rows(path: Path) -> Iterator[list[str]]:
    with path.open(encoding="ascii", newline="") as file:
        # A row that was cut off when the work was stopped is left out.
        yield from (row for row in csv.reader(file) if len(row) == 11)


if __name__ == "__main__":
    main()
