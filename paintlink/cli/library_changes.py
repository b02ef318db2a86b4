"""`paintlink library`: changes to the shop's own libraries, and taking them back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.library_state import on_shelf
from paintlink.cli.library_views import say_changed
from paintlink.cli.output import json_option, print_json, print_table

if TYPE_CHECKING:
    from paintlink.library.diff import Difference, PaintChange
    from paintlink.library.shelf import Shelf


@click.command("remove")
@click.argument("name")
@click.argument("codes", nargs=-1)
@on_shelf
@json_option
def remove(name: str, codes: tuple[str, ...], shelf: Shelf, as_json: bool) -> None:
    """Take the library NAME off the shelf, or only the paints of CODES out of it.

    Jobs keep what they refer to, and `paintlink library undo NAME` brings it back.
    """
    if codes:
        say_changed(shelf.editor.remove_paints(name, codes), as_json)
    else:
        say_changed(shelf.editor.remove(name), as_json)


@click.command("rename")
@click.argument("name")
@click.argument("new_name", default="")
@click.option("--paint", default="", help="Code of the paint to rename instead.")
@click.option("--code", "new_code", default="", help="New code of that paint.")
@on_shelf
@json_option
def rename(
    *, name: str, new_name: str, paint: str, new_code: str, shelf: Shelf, as_json: bool
) -> None:
    """Call the library NAME by NEW_NAME.

    With --paint, give that paint of the library NAME another name, code or both.
    """
    if not (new_name or (paint and new_code)):
        msg = "say the new name" + (", or --code" if paint else "")
        raise click.UsageError(msg)
    if paint:
        made = shelf.editor.rename_paint(
            name, paint, new_code=new_code, new_name=new_name
        )
    else:
        made = shelf.editor.rename(name, new_name)
    say_changed(made, as_json)


@click.command("undo")
@click.argument("name")
@on_shelf
@json_option
def undo(name: str, shelf: Shelf, as_json: bool) -> None:
    """Take back the last change of the library NAME; again for the one before."""
    say_changed(shelf.editor.undo(name), as_json)


@click.command("restore")
@click.argument("generation")
@on_shelf
@json_option
def restore(generation: str, shelf: Shelf, as_json: bool) -> None:
    """Make an old GENERATION of a library the present one again."""
    say_changed(shelf.editor.restore(generation), as_json)


@click.command("diff")
@click.argument("old")
@click.argument("new", default="")
@on_shelf
@json_option
def diff(old: str, new: str, shelf: Shelf, as_json: bool) -> None:
    """Say what changed from the generation OLD to the generation NEW.

    Without NEW, to the present one of the same library; OLD may also be the name of a
    library, for its last change.
    """
    found = shelf.difference(old, new)
    if as_json:
        print_json(_document(found))
        return
    for title, changes in (
        ("new", found.added), ("gone", found.removed), ("changed", found.changed),
    ):  # fmt: skip
        rows = [(one.code, one.name, _words(one)) for one in changes]
        if rows:
            print_table(("code", "name", ""), rows, title=f"{title}: {len(rows)}")
    if not len(found):
        click.echo("no difference")


def _words(change: PaintChange) -> str:
    words = [f"{name} {old or '-'} -> {new or '-'}" for name, old, new in change.fields]
    if change.differences:
        values = "/".join(f"{value:.2f}" for value in change.differences)
        words.append(f"dE {values}")
    return ", ".join(words)


def _document(found: Difference) -> dict[str, Any]:
    from dataclasses import asdict

    return {
        "angles_deg": list(found.angles_deg),
        "added": [asdict(one) for one in found.added],
        "removed": [asdict(one) for one in found.removed],
        "changed": [asdict(one) for one in found.changed],
    }


COMMANDS = (remove, rename, undo, restore, diff)
