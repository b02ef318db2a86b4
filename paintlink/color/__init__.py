"""Pure colour numerics: spectra to Lab, differences, indices, curves, display."""
