from __future__ import annotations

import subprocess
import sys

SCRIPT = """
import sys
import paintlink.preview
print(*sorted({"PIL", "moderngl", "glcontext", "rich"} & set(sys.modules)))
"""


def test_importing_preview_loads_no_heavy_library() -> None:
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True
    )

    assert done.stdout.strip() == ""
