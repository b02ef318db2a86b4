"""What one cold `paintlink snap` costs, beside the import of numpy alone.

Run ``python benchmarks/cold_start.py``. Both are whole processes of this interpreter,
taken in turn in the same run; the least of each counts, in wall and processor time.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from paintlink.library import bundled, find, paint_spec
from paintlink.spec import write_spec

ROUNDS = 15
PROGRAM = "from paintlink.cli import main; main()"


def main() -> None:
    """Print the times and their ratio."""
    with tempfile.TemporaryDirectory() as folder:
        spec = Path(folder) / "spec.xml"
        table = bundled()
        paint = paint_spec(table, find(table, "RM209"), angles_deg=(15.0, 45.0, 110.0))
        spec.write_bytes(write_spec(paint))
        commands = {
            "python -c 'import numpy'": ["-c", "import numpy"],
            "paintlink snap SPEC": ["-c", PROGRAM, "snap", str(spec)],
            "paintlink snap SPEC --json": ["-c", PROGRAM, "snap", str(spec), "--json"],
        }
        taken: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
        for _ in range(ROUNDS):
            for name, arguments in commands.items():
                taken[name].append(run(arguments))
    report(taken)


def run(arguments: list[str]) -> tuple[float, float]:
    """Wall and processor time of one process, in seconds."""
    used, start = processor_s(), time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start, processor_s() - used


def processor_s() -> float:
    """Processor time of all processes started so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def report(taken: dict[str, list[tuple[float, float]]]) -> None:
    """Print the least times and how often they hold the first one."""
    least = {name: np.array(times).min(axis=0) for name, times in taken.items()}
    wall, cpu = next(iter(least.values()))
    for name, (one_wall, one_cpu) in least.items():
        print(
            f"{name:28s} wall {one_wall * 1e3:6.0f} ms  x {one_wall / wall:.2f}   "
            f"processor {one_cpu * 1e3:6.0f} ms  x {one_cpu / cpu:.2f}"
        )


if __name__ == "__main__":
    main()
