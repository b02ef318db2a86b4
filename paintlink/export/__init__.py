"""Files for other programs: stylesheets, rendering, atomic delivery."""
