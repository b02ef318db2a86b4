"""Make the data of the forecast: cloud, labels, weights.

Run the three steps in order from the root of the repository:

    python tools/make_forecast.py label FILE.csv        about 20 minutes of one core
    python tools/make_forecast.py learn FILE.csv...     about a minute

``label`` may be stopped and started again; ``--part 0/2`` and ``--part 1/2`` with a
file each share the work.
"""

from __future__ import annotations

import sys
from pathlib import Path

from forecast.colours import colours, formulas
from forecast.labels import Bench, label

CLOUD_PAINTS = 60_000
CLOUD_SEED = 7
LABELLED = 6_000


def main() -> None:
    """Run one step."""
    step, *arguments = sys.argv[1:]
    if step == "label":
        path, *rest = arguments
        which, shares = (rest[1] if rest else "0/1").split("/")
        parts = formulas(CLOUD_PAINTS, CLOUD_SEED)
        bench = Bench(parts, colours(parts))
        label(Path(path), bench, LABELLED, (int(which), int(shares)))


if __name__ == "__main__":
    main()
