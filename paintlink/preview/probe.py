"""Whether an OpenGL context can be had, tried out where a crash does no harm."""

from __future__ import annotations

import signal
import subprocess
import sys

from paintlink.errors import PreviewError

TIMEOUT_S = 20.0
SCRIPT = """
import moderngl
moderngl.create_context(standalone=True, backend="egl", require=330)
"""


def require_context() -> None:
    """Return when a process of its own could open a context.

    Raises
    ------
    PreviewError
        When it could not, crashed or hung: in this process a driver that crashes
        would end the program.
    """
    trouble = _trouble()
    if trouble:
        msg = f"no OpenGL context: {trouble}"
        raise PreviewError(msg)


def _trouble() -> str:
    """What the driver said or did; empty when all is well."""
    command = [sys.executable, "-c", SCRIPT]
    try:
        run = subprocess.run(command, capture_output=True, timeout=TIMEOUT_S)
    except subprocess.TimeoutExpired:
        return f"the driver gave no answer within {TIMEOUT_S:g} s"
    except OSError as error:
        return f"it could not be tried out ({error})"
    if run.returncode < 0:
        return f"the driver crashed ({signal.Signals(-run.returncode).name})"
    said = run.stderr.decode(errors="replace").strip().splitlines()
    return said[-1] if run.returncode else ""
