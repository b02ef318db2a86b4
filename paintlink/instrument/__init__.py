"""All that a driver author may import: link, framing, driver contract, registry."""
