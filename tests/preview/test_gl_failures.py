"""Whatever OpenGL does, there is a picture; each case in a process of its own."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

DRAW = """
import json, sys
from paintlink.errors import PreviewError
from paintlink.preview import render
from tests.preview.truth import SILVER
try:
    picture = render([SILVER], object="sphere", size=32, backend=sys.argv[1])
    answer = [picture.backend, picture.reason, int(picture.rgb.sum())]
except PreviewError as error:
    answer = ["error", str(error), 0]
print(json.dumps(answer))
"""

FORK = """
import json, os
from paintlink.errors import PreviewError
from paintlink.preview import gl, render
from tests.preview.truth import SILVER
try:
    render([SILVER], object="sphere", size=32, backend="gl")
except PreviewError as error:
    print(json.dumps(["none", str(error), 0]))
    raise SystemExit
reader, writer = os.pipe()
child = os.fork()
if child == 0:
    picture = render([SILVER], object="sphere", size=32)
    answer = [picture.backend, picture.reason, int(picture.rgb.sum())]
    os.write(writer, json.dumps(answer).encode())
    os._exit(0)
os.waitpid(child, 0)
print(os.read(reader, 4096).decode())
"""

CRASHING = (
    "__attribute__((constructor)) static void die(void) { *(volatile int *)0 = 0; }"
)
HANGING = """
#include <unistd.h>
__attribute__((constructor)) static void wait(void) { for (;;) pause(); }
"""


def run(script: str, *arguments: str, **environment: str) -> tuple[str, str, int]:
    done = subprocess.run(
        [sys.executable, "-c", script, *arguments],
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == 0, done.stderr
    backend, reason, total = json.loads(done.stdout)
    return backend, reason, total


@pytest.fixture(scope="module")
def expected() -> int:
    backend, reason, total = run(DRAW, "cpu")

    assert (backend, reason) == ("cpu", "numpy, as asked for")
    return total


TROUBLES = [
    ({"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"}, "no OpenGL context: "),
    ({"MESA_GL_VERSION_OVERRIDE": "2.1"}, "no OpenGL context: "),
    ({"GLCONTEXT_LINUX_LIBEGL": "libnope.so"}, "libnope.so not loaded"),
]


@pytest.mark.parametrize(("environment", "words"), TROUBLES)
def test_without_opengl_numpy_draws_and_says_why(
    environment: dict[str, str], words: str, expected: int
) -> None:
    backend, reason, total = run(DRAW, "auto", **environment)

    assert backend == "cpu"
    assert reason.startswith("numpy: ")
    assert words in reason
    assert total == expected


@pytest.mark.parametrize(("environment", "words"), TROUBLES)
def test_asking_for_opengl_in_vain_is_an_error(
    environment: dict[str, str], words: str
) -> None:
    backend, message, _ = run(DRAW, "gl", **environment)

    assert backend == "error"
    assert words in message
    assert "install a working driver, or let numpy draw" in message


def library(folder: Path, source: str) -> str:
    """Path of a shared library made from C."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler to build a broken driver with")
    (folder / "driver.c").write_text(source)
    made = folder / "libbroken.so"
    command = [compiler, "-shared", "-fPIC", "-o", str(made), str(folder / "driver.c")]
    subprocess.run(command, check=True)
    return str(made)


def test_crashing_driver_costs_no_picture(tmp_path: Path, expected: int) -> None:
    broken = library(tmp_path, CRASHING)

    backend, reason, total = run(DRAW, "auto", GLCONTEXT_LINUX_LIBEGL=broken)

    assert (backend, total) == ("cpu", expected)
    assert reason == "numpy: no OpenGL context: the driver crashed (SIGSEGV)"


def test_hanging_driver_costs_no_picture(tmp_path: Path, expected: int) -> None:
    broken = library(tmp_path, HANGING)
    impatient = DRAW.replace(
        "import json, sys",
        "import json, sys\nfrom paintlink.preview import probe\nprobe.TIMEOUT_S = 1.0",
    )

    backend, reason, total = run(impatient, "auto", GLCONTEXT_LINUX_LIBEGL=broken)

    assert (backend, total) == ("cpu", expected)
    assert reason.endswith("no OpenGL context: the driver gave no answer within 1 s")


def test_missing_moderngl_costs_no_picture(tmp_path: Path, expected: int) -> None:
    (tmp_path / "moderngl.py").write_text("raise ImportError('broken installation')")
    path = f"{tmp_path}{os.pathsep}{ROOT}"

    backend, reason, total = run(DRAW, "auto", PYTHONPATH=path)

    assert (backend, total) == ("cpu", expected)
    assert "broken installation" in reason


def test_child_of_a_fork_never_touches_opengl(expected: int) -> None:
    backend, reason, total = run(FORK)

    if backend == "none":
        pytest.skip(f"no OpenGL here: {reason}")
    assert (backend, total) == ("cpu", expected)
    assert "this process was forked from one that used OpenGL" in reason
