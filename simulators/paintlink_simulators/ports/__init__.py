"""Places a simulated instrument can be reached at: memory, pty, TCP."""
