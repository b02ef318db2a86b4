"""How the forecast learns what the virtual paint system can make."""
