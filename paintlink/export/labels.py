"""Labels for panels and tins: ZPL for label printers, HTML for any other."""

from __future__ import annotations

import io
import unicodedata
from collections.abc import Mapping
from typing import Literal

from paintlink.errors import ExportError

LabelKind = Literal["zpl", "html"]

ZPL = """\
^XA^CI28^PW600^LL300
^FO30,30^BQN,2,6^FDMA,{{ job }}^FS
^FO220,40^A0N,40,40^FD{{ sample }}^FS
^FO220,95^A0N,30,30^FD{{ paint }}{% if total %}  {{ total }}{% endif %}^FS
^FO220,135^A0N,30,30^FD{{ repair_order }}  {{ panel }}^FS
^FO220,175^A0N,30,30^FD{{ vin }}^FS
^FO220,215^A0N,30,30^FD{{ date }}  {{ job }}^FS
{% if simulated %}^FO30,255^A0N,30,30^FDSIMULATED^FS
{% endif %}^XZ
"""

HTML = """\
<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{{ job }}</title>
<style>
  @page { size: 75mm 38mm; margin: 2mm }
  body { font: 10pt sans-serif; display: flex; gap: 3mm; margin: 0 }
  svg { width: 26mm; height: 26mm; flex: none } b { font-size: 13pt }
</style></head><body>
{{ qr }}
<div><b>{{ sample }}</b><br>{{ paint }}{% if total %} ({{ total }}){% endif %}<br>
{{ repair_order }} {{ panel }}<br>{{ vin }}<br>{{ date }} {{ job }}
{% if simulated %}<br><b>SIMULATED</b>{% endif %}</div>
</body></html>
"""


def label(kind: LabelKind, facts: Mapping[str, object], text: str = "") -> str:
    """The label of a job.

    Parameters
    ----------
    facts
        What may stand on it: ``job``, ``sample``, ``paint``, ``total``, ``date``,
        ``repair_order``, ``vin``, ``panel``, ``operator``, ``simulated``.
    text
        The site's own text in the language of Jinja2; the built-in one when empty.

    Raises
    ------
    ExportError
        When the site's text is no working template.
    """
    from jinja2 import TemplateError
    from jinja2.sandbox import ImmutableSandboxedEnvironment
    from markupsafe import Markup

    environment = ImmutableSandboxedEnvironment(autoescape=kind == "html")
    shown = dict(facts)
    if kind == "html":
        shown["qr"] = Markup(qr_svg(str(facts["job"])))
    else:
        shown = {name: _for_zpl(value) for name, value in shown.items()}
    try:
        made = environment.from_string(text or (HTML if kind == "html" else ZPL))
        return made.render(shown)
    except (TemplateError, ArithmeticError, TypeError, ValueError) as error:
        msg = f"the label text of the template does not work ({error}); correct it"
        raise ExportError(msg, kind="format") from error


def qr_svg(text: str) -> str:
    """A QR code of a text as an SVG element."""
    import segno

    file = io.BytesIO()
    segno.make(text, micro=False).save(file, kind="svg", xmldecl=False, scale=4)
    return file.getvalue().decode()


def _for_zpl(value: object) -> object:
    """A text that cannot end its field or begin a command."""
    if not isinstance(value, str):
        return value
    plain = value.replace("^", " ").replace("~", " ")
    return "".join(one for one in plain if unicodedata.category(one)[0] != "C")
