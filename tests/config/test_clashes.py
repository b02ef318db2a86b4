from __future__ import annotations

import pytest


def instrument(name: str) -> str:
    return f'[[instrument]]\nname = "{name}"\ndriver = "d"\nport = "p"\n'


def route(name: str, folder: str) -> str:
    return f'[[route]]\nname = "{name}"\nformat = "f"\nfolder = "{folder}"\n'


def test_instrument_name_is_used_once(refuse) -> None:
    faults = refuse(instrument("a") + instrument("b") + instrument("a"))

    assert faults == [
        'FILE: [[instrument]] 3 "a": name = "a": [[instrument]] 1 has it already; each '
        "needs its own"
    ]


def test_route_name_is_used_once(refuse) -> None:
    (fault,) = refuse(route("a", "/x") + route("a", "/y"))

    assert fault.startswith('FILE: [[route]] 2 "a": name = "a": [[route]] 1 has it')


def test_instrument_and_route_may_share_a_name(load) -> None:
    settings = load(instrument("a") + route("a", "/x"))

    assert settings.instruments[0].name == settings.routes[0].name


@pytest.mark.parametrize(
    ("first", "second"),
    [("/x", "/x"), ("/x", "/y/../x/"), ("/x", "/x/in"), ("/x/in", "/x")],
    ids=["same", "same in other words", "inside", "around"],
)
def test_routes_share_no_folder(refuse, first: str, second: str) -> None:
    (fault,) = refuse(route("a", first) + route("b", second))

    assert fault.startswith('FILE: [[route]] 2 "b": folder = "/x')
    assert f'[[route]] 1 uses "{first}"; give each program a folder of its' in fault


def test_unusable_folders_do_not_clash(refuse) -> None:
    faults = refuse(route("a", "~/x") + route("b", "~/x"))

    assert [fault.partition(": ")[0] for fault in faults] == ["FILE", "FILE"]
    assert all("must be a folder" in fault for fault in faults)


def test_folders_with_similar_names_are_two(load) -> None:
    assert len(load(route("a", "/x") + route("b", "/x2")).routes) == 2


@pytest.mark.parametrize(
    "own", ["inbox", "working", "done", "failed", "duplicate", "answers"]
)
def test_route_stays_out_of_our_folders(refuse, own: str) -> None:
    faults = refuse(f'[site]\nfolder = "/s"\n{route("a", f"/s/{own}")}')

    assert faults == [
        f'FILE: [[route]] 1 "a": folder = "/s/{own}": paintlink\'s own {own}; choose '
        "another"
    ]


def test_route_stays_out_of_a_moved_inbox(refuse) -> None:
    (fault,) = refuse(f'[inbox]\nfolder = "in"\n{route("a", "in")}')

    assert fault.endswith("paintlink's own inbox; choose another")


def test_green_stays_below_amber(refuse) -> None:
    assert refuse("[snap]\ngreen = 3.5") == [
        "FILE: [snap]: green = 3.5: must not be above amber = 3.0"
    ]


def test_equal_limits_are_fine(load) -> None:
    assert load("[snap]\namber = 1.5").snap.amber == 1.5


def test_clashes_are_told_beside_other_faults(refuse) -> None:
    faults = refuse(f"[snap]\ntop = 0\n{route('a', '/x')}{route('b', '/x')}")

    assert len(faults) == 2
