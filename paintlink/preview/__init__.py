"""Pictures of paint from its aspecular curve."""
