"""Lights an object stands in: one file each, found by its name.

A file declares ``LABEL`` and ``radiance(directions)``: linear sRGB, shape (n, 3), of
unit directions, shape (n, 3), x right, y up, z towards the viewer. The scale is free:
the exposure is fixed later by a perfect diffuser.
"""
