"""What formulation software answers: formulas, predictions, and how they converge."""

from paintlink.formulation.answer import (
    NAMESPACE,
    read_answer,
    schema_path,
    write_answer,
)
from paintlink.formulation.convergence import Step, best_step, convergence
from paintlink.formulation.history import HISTORY, with_history
from paintlink.formulation.judging import (
    AngleError,
    errors_per_angle,
    mean_error,
    require_fitting,
)
from paintlink.formulation.plot import plot_convergence
from paintlink.formulation.values import Answer, Component, Formula, Panel, Proposal

__all__ = [
    "HISTORY",
    "NAMESPACE",
    "AngleError",
    "Answer",
    "Component",
    "Formula",
    "Panel",
    "Proposal",
    "Step",
    "best_step",
    "convergence",
    "errors_per_angle",
    "mean_error",
    "plot_convergence",
    "read_answer",
    "require_fitting",
    "schema_path",
    "with_history",
    "write_answer",
]
