"""A design: a starting colour, the steps made on it, and those taken back."""

from __future__ import annotations

from dataclasses import dataclass, replace

from paintlink.design.start import Start, designed
from paintlink.design.state import State
from paintlink.design.step import Applied, Step
from paintlink.errors import DesignError
from paintlink.model import ColorSpec


@dataclass(frozen=True, slots=True)
class Design:
    """A chain of steps; every state is found by making the steps again.

    Parameters
    ----------
    undone
        Steps taken back, the next one to redo last.
    """

    name: str
    start: Start
    steps: tuple[Step, ...] = ()
    undone: tuple[Step, ...] = ()

    def apply(self, step: Step) -> Design:
        """The design with one more step; what was undone is forgotten.

        Raises
        ------
        DesignError
            When the present colour does not have what the step needs.
        """
        step.applied(self.state)
        return replace(self, steps=(*self.steps, step), undone=())

    def undo(self, count: int = 1) -> Design:
        """The design without its last steps, which are kept for `redo`.

        Raises
        ------
        DesignError
            When it has fewer.
        """
        _require(count, len(self.steps), "undo")
        kept = len(self.steps) - count
        taken = tuple(reversed(self.steps[kept:]))
        return replace(self, steps=self.steps[:kept], undone=self.undone + taken)

    def redo(self, count: int = 1) -> Design:
        """The design with the steps undone last made again.

        Raises
        ------
        DesignError
            When fewer were undone.
        """
        _require(count, len(self.undone), "redo")
        left = len(self.undone) - count
        back = tuple(reversed(self.undone[left:]))
        return replace(self, steps=self.steps + back, undone=self.undone[:left])

    def history(self) -> tuple[Applied, ...]:
        """Each step with the colour it led to.

        Raises
        ------
        DesignError
            When a step cannot be made on the colour before it.
        """
        state, made = self.start.state, []
        for step in self.steps:
            made.append(step.applied(state))
            state = made[-1].state
        return tuple(made)

    @property
    def state(self) -> State:
        """The colour after the last step."""
        history = self.history()
        return history[-1].state if history else self.start.state

    @property
    def spec(self) -> ColorSpec:
        """The design as an ordinary colour specification."""
        return designed(self.start, self.state, self.name)


def _require(count: int, there: int, what: str) -> None:
    if not 1 <= count <= there:
        msg = f"cannot {what} {count} steps: ask for 1 to {there}"
        if there == 0:
            msg = f"there is nothing to {what}"
        raise DesignError(msg)
