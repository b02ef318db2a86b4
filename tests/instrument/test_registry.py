import sys
import textwrap

import pytest

from paintlink.errors import ConfigError
from paintlink.instrument import drivers, failures, load_driver, modules_in_group

DRIVER = """
from dataclasses import dataclass
from paintlink.instrument import DriverInfo, SerialSettings

@dataclass(frozen=True)
class Options:
    pass

INFO = DriverInfo(
    id="{id}", maker="Acme", models={{"X1": ()}}, options=Options(),
    serial=SerialSettings(), hardware_tested=False,
)

def create(link, options):
    return None
"""


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Return a function that installs a distribution with the given modules."""
    monkeypatch.syspath_prepend(tmp_path)

    def put(package, modules, *, group="paintlink.drivers", target=None):
        info = tmp_path / f"{package}-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Name: {package}\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(
            f"[{group}]\nany = {target or package}\n"
        )
        (tmp_path / package).mkdir()
        for name, source in {"__init__": "", **modules}.items():
            text = textwrap.dedent(source)
            (tmp_path / package / f"{name}.py").write_text(text)

    yield put
    for name in [name for name in sys.modules if name.startswith("acme_paint")]:
        del sys.modules[name]


def test_own_driver_is_found_by_its_file_name():
    driver = load_driver("xrite_ma")

    assert driver.INFO.id == "xrite_ma"
    assert drivers()["xrite_ma"] is driver


def test_foreign_driver_stands_beside_our_own(install):
    install("acme_paint_a", {"acme_x1": DRIVER.format(id="acme_x1")})

    assert {"acme_x1", "xrite_ma"} <= drivers().keys()
    assert load_driver("acme_x1").INFO.label == "Acme X1"


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("import nothing_of_this_name", "ModuleNotFoundError: No module named"),
        ("this is no Python", "SyntaxError"),
        ("1 / 0", "ZeroDivisionError"),
        ("raise SystemExit(3)", "SystemExit: 3"),
        ("x = 1", r"is no driver: it needs INFO \(DriverInfo\) and create\(\)"),
        (DRIVER.format(id="other"), "says its id is 'other'"),
    ],
)
def test_broken_driver_costs_only_itself(install, source, reason):
    install("acme_paint_b", {"bad": source, "good": DRIVER.format(id="good")})

    assert "bad" not in drivers()
    assert {"good", "xrite_ma"} <= drivers().keys()
    with pytest.raises(ConfigError, match=rf"acme_paint_b\.bad .*{reason}"):
        load_driver("bad")
    assert failures().keys() == {"bad"}


def test_missing_package_is_reported(install):
    install("acme_paint_c", {}, target="acme_paint_nowhere")

    assert "cannot be imported" in failures()["acme_paint_nowhere"]
    assert "xrite_ma" in drivers()


def test_entry_point_at_a_module_is_reported(install):
    install("acme_paint_d", {"single": ""}, target="acme_paint_d.single")

    assert "must name a package" in failures()["acme_paint_d.single"]


def test_private_modules_and_packages_are_no_drivers(install):
    install("acme_paint_e", {"_helper": "1 / 0"})

    assert failures() == {}


def test_taken_id_stays_with_paintlink(install):
    install("acme_paint_f", {"xrite_ma": DRIVER.format(id="xrite_ma")})

    assert load_driver("xrite_ma").INFO.maker == "X-Rite"
    assert failures() == {
        "acme_paint_f.xrite_ma": "acme_paint_f.xrite_ma is left out: "
        "paintlink_drivers.xrite_ma has the same id"
    }


def test_unknown_driver_brings_the_nearest():
    with pytest.raises(
        ConfigError, match=r"'xrite_mb', did you mean '\w+'\? known: .*xrite_ma"
    ):
        load_driver("xrite_mb")


def test_any_group_can_be_listed(install):
    install("acme_paint_g", {"one": "x = 1", "two": "x = 2"}, group="paintlink.test")

    found, broken = modules_in_group("paintlink.test")

    assert {name: module.x for name, module in found.items()} == {"one": 1, "two": 2}
    assert broken == {}
