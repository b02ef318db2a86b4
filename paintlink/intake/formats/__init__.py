"""One module per file format: `INFO`, `sniff` and `read`."""
