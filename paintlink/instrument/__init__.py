"""What a driver author may import: the link, the contract, options, geometry codes."""

from paintlink.instrument._contract import (
    Confirming,
    Driver,
    DriverInfo,
    DriverModule,
    Prompt,
    ReadingMemory,
    SerialSettings,
    UsbSettings,
    confirm,
)
from paintlink.instrument._dialogue import ask
from paintlink.instrument._framing import fixed, line_size, up_to
from paintlink.instrument._geometry import parse_geometry
from paintlink.instrument._link import BUFFER_LIMIT, ByteStream, Direction, Link, Tap
from paintlink.instrument._options import (
    Option,
    OptionSet,
    describe_options,
    option,
    parse_options,
)
from paintlink.instrument._readings import (
    BANDS_NM,
    ReadingCheck,
    complete,
    parse_band_rows,
)
from paintlink.instrument._registry import (
    Modules,
    drivers,
    failures,
    load_driver,
    modules_in_group,
)
from paintlink.instrument._text import did_you_mean, quoted

__all__ = [
    "BANDS_NM",
    "BUFFER_LIMIT",
    "ByteStream",
    "Confirming",
    "Direction",
    "Driver",
    "DriverInfo",
    "DriverModule",
    "Link",
    "Modules",
    "Option",
    "OptionSet",
    "Prompt",
    "ReadingCheck",
    "ReadingMemory",
    "SerialSettings",
    "Tap",
    "UsbSettings",
    "ask",
    "complete",
    "confirm",
    "describe_options",
    "did_you_mean",
    "drivers",
    "failures",
    "fixed",
    "line_size",
    "load_driver",
    "modules_in_group",
    "option",
    "parse_band_rows",
    "parse_geometry",
    "parse_options",
    "quoted",
    "up_to",
]
