"""Objects a paint is drawn on: one file each, found by its name.

A file declares ``LABEL``, ``SPAN`` (left and right end, where a comparison is split),
``SHADOWS`` (ellipses where it meets the floor: centre x and y, half axes) and two
functions of places in the picture, x to the right and y up, both from -1 to 1:
``margin(x, y)``, the distance inside the outline, negative outside, and
``normals(x, y)``, the unit normals there and just outside the outline, shape (n, 3).
"""
