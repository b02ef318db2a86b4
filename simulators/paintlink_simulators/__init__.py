"""Simulated instruments, one module each; the file name is the driver id."""
