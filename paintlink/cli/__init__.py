"""The command line.

Each command is one module, loaded when it is called. Modules import what is heavy
inside their functions, so that `paintlink --help` starts at once.
"""

from __future__ import annotations

from importlib import import_module

import click

from paintlink import __version__
from paintlink.errors import PaintlinkError

COMMANDS = {
    "backup": "backup",
    "calibrate": "calibrate",
    "config": "config",
    "convert": "convert",
    "demo": "demo",
    "design": "design",
    "devices": "devices",
    "driver-test": "driver_test",
    "export": "export",
    "graph": "graph",
    "import": "import_",
    "formulation": "formulation",
    "health": "health",
    "jobs": "jobs",
    "library": "library",
    "measure": "measure",
    "preview": "preview",
    "previews": "previews",
    "replay": "replay",
    "restore": "restore",
    "run": "run",
    "simulate": "simulate",
    "sketch": "sketch",
    "snap": "snap",
    "tile": "tile",
    "trace": "trace",
    "turntable": "turntable",
    "validate": "validate",
}

EXIT_CODES = """\b
Exit codes:
  0    done
  1    a fault of the program
  2    wrong call or configuration
  3    a file or value from outside cannot be used
  4    the instrument cannot be reached, or refused
  5    a file or picture could not be written
  6    the journal cannot be used
  130  stopped by the operator
"""


class LazyGroup(click.Group):
    """Commands found by name and imported when used."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of all commands."""
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of a name, or None."""
        if cmd_name not in COMMANDS:
            return None
        module = import_module(f"paintlink.cli.{COMMANDS[cmd_name]}")
        command: click.Command = module.command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command to run; an unknown name gets the nearest one suggested."""
        if args and args[0] not in COMMANDS:
            from difflib import get_close_matches

            near = get_close_matches(args[0], COMMANDS, n=1)
            hint = f" Did you mean `paintlink {near[0]}`?" if near else ""
            msg = f"there is no command {args[0]!r}.{hint}"
            raise click.UsageError(msg, ctx)
        return super().resolve_command(ctx, args)


class _Program(LazyGroup):
    def invoke(self, ctx: click.Context) -> object:
        """Run the command; an expected error becomes one message and its exit code."""
        try:
            return super().invoke(ctx)
        except PaintlinkError as error:
            click.secho(f"paintlink: {error}", err=True, fg="red")
            ctx.exit(error.exit_code)


@click.group(
    cls=_Program,
    epilog=EXIT_CODES,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 88},
)
@click.version_option(__version__, prog_name="paintlink")
def main() -> None:
    """From multi-angle spectrophotometer to paint formula.

    New here? `paintlink demo --once` runs the whole line on simulated instruments.
    """
