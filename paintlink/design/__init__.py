"""The designer: colours made by named steps on a starting colour."""

from paintlink.design.catalogue import STEPS, kind_of, make_step, value_from_text
from paintlink.design.design import Design
from paintlink.design.document import color_document, from_json, step_document, to_json
from paintlink.design.files import read_design, write_design
from paintlink.design.parameters import Paint, Parameter, Value, parameters
from paintlink.design.plot import plot
from paintlink.design.review import rates, warnings
from paintlink.design.start import Start, blank, from_library, from_spec
from paintlink.design.state import State
from paintlink.design.step import Applied, Step

__all__ = [
    "STEPS",
    "Applied",
    "Design",
    "Paint",
    "Parameter",
    "Start",
    "State",
    "Step",
    "Value",
    "blank",
    "color_document",
    "from_json",
    "from_library",
    "from_spec",
    "kind_of",
    "make_step",
    "parameters",
    "plot",
    "rates",
    "read_design",
    "step_document",
    "to_json",
    "value_from_text",
    "warnings",
    "write_design",
]
