"""The sections of the configuration file.

The fields of each class are the keys of the section: their types, limits, defaults and
explanations are written down here and nowhere else.
"""
