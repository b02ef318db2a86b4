"""The XML colour specification: schema, hardened reader, canonical writer."""
