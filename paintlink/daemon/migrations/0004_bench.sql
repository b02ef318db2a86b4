-- When instruments were calibrated, and how they see their check tiles.

CREATE TABLE calibrations (
    id INTEGER PRIMARY KEY,
    instrument TEXT NOT NULL,
    at TEXT NOT NULL,
    how TEXT NOT NULL
) STRICT;
CREATE INDEX calibrations_of ON calibrations (instrument, id);

CREATE TABLE tile_checks (
    id INTEGER PRIMARY KEY,
    instrument TEXT NOT NULL,
    tile TEXT NOT NULL,
    at TEXT NOT NULL,
    document TEXT NOT NULL
) STRICT;
CREATE INDEX tile_checks_of ON tile_checks (instrument, tile, id);
