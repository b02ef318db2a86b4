import os
import tty

import pytest

from paintlink.links import Hotplug, matches


@pytest.fixture
def hotplug(tmp_path):
    made = []

    def make(*addresses):
        made.append(Hotplug(addresses))
        return made[-1]

    yield make
    for one in made:
        one.close()


@pytest.fixture
def plug(tmp_path):
    """Return a function that makes a terminal and a link to it."""
    open_ends = []

    def make(name):
        master, slave = os.openpty()
        tty.setraw(slave)
        open_ends.extend((master, slave))
        link = tmp_path / name
        link.unlink(missing_ok=True)
        link.symlink_to(os.ttyname(slave))
        return link

    yield make
    for end in open_ends:
        os.close(end)


def test_quiet_machine_gives_no_hint(hotplug, plug):
    watch = hotplug(str(plug("by-id")))

    assert not watch.wait()


def test_device_that_comes_is_told_once(hotplug, plug, tmp_path):
    watch = hotplug(str(tmp_path / "by-id"))
    plug("by-id")

    assert watch.wait()
    assert not watch.wait()


def test_device_that_goes_is_told(hotplug, plug):
    link = plug("by-id")
    watch = hotplug(str(link))
    link.unlink()

    assert watch.wait()


def test_another_device_under_the_same_name_is_told(hotplug, plug, tmp_path):
    plug("by-id")
    watch = hotplug(str(tmp_path / "by-id"))
    plug("by-id")

    assert watch.wait()


def test_another_name_that_fits_the_pattern_is_told(hotplug, plug, tmp_path):
    plug("ttyUSB0").unlink()
    watch = hotplug(str(tmp_path / "ttyUSB*"))
    plug("ttyUSB1")

    assert watch.wait()


def test_pattern_stands_for_all_that_fit(plug, tmp_path):
    names = [str(plug(name)) for name in ("ttyUSB1", "ttyUSB0")]

    assert matches(str(tmp_path / "ttyUSB*")) == sorted(names)
    assert matches("/dev/ttyUSB7") == ["/dev/ttyUSB7"]
    assert matches(str(tmp_path / "none*")) == []
