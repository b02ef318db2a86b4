"""The XML colour specification: schema, hardened reader, canonical writer."""

from paintlink.spec.document import safe_root, safe_root_of_text
from paintlink.spec.files import read_spec_file
from paintlink.spec.markup import decimal
from paintlink.spec.reader import read_spec
from paintlink.spec.schema import NAMESPACE, schema_path
from paintlink.spec.writer import spec_id, write_spec

__all__ = [
    "NAMESPACE",
    "decimal",
    "read_spec",
    "read_spec_file",
    "safe_root",
    "safe_root_of_text",
    "schema_path",
    "spec_id",
    "write_spec",
]
