-- Readings, jobs, deliveries, pictures.

CREATE TABLE readings (
    id INTEGER PRIMARY KEY,
    key TEXT NOT NULL UNIQUE,
    source TEXT NOT NULL,
    taken_at TEXT NOT NULL,
    document TEXT NOT NULL,
    raw BLOB NOT NULL
) STRICT;

CREATE TABLE jobs (
    id INTEGER PRIMARY KEY,
    token TEXT NOT NULL UNIQUE,
    reading_id INTEGER REFERENCES readings (id),
    source TEXT NOT NULL,
    origin TEXT NOT NULL CHECK (origin IN ('real', 'simulated')),
    state TEXT NOT NULL
        CHECK (state IN ('received', 'specified', 'matched', 'done', 'failed')),
    spec BLOB,
    error TEXT NOT NULL DEFAULT '',
    created_at TEXT NOT NULL,
    CHECK (reading_id IS NOT NULL OR spec IS NOT NULL)
) STRICT;
CREATE INDEX jobs_waiting ON jobs (state, id) WHERE state NOT IN ('done', 'failed');

CREATE TABLE matches (
    job_id INTEGER NOT NULL REFERENCES jobs (id),
    rank INTEGER NOT NULL,
    document TEXT NOT NULL,
    PRIMARY KEY (job_id, rank)
) STRICT, WITHOUT ROWID;

CREATE TABLE deliveries (
    id INTEGER PRIMARY KEY,
    job_id INTEGER NOT NULL REFERENCES jobs (id),
    route TEXT NOT NULL,
    copy INTEGER NOT NULL DEFAULT 1,
    folder TEXT NOT NULL,
    state TEXT NOT NULL CHECK (
        state IN ('pending', 'publishing', 'written', 'stale', 'taken', 'failed',
            'unknown')
    ),
    name TEXT NOT NULL DEFAULT '',
    sha256 TEXT NOT NULL DEFAULT '',
    error TEXT NOT NULL DEFAULT '',
    attempts INTEGER NOT NULL DEFAULT 0,
    retry_at REAL NOT NULL DEFAULT 0,
    written_at TEXT NOT NULL DEFAULT '',
    UNIQUE (job_id, route, copy)
) STRICT;
CREATE INDEX deliveries_open ON deliveries (state, retry_at)
    WHERE state IN ('pending', 'publishing', 'written', 'stale');

CREATE TABLE previews (
    job_id INTEGER PRIMARY KEY REFERENCES jobs (id),
    state TEXT NOT NULL CHECK (state IN ('pending', 'done', 'failed')),
    path TEXT NOT NULL DEFAULT '',
    note TEXT NOT NULL DEFAULT ''
) STRICT;

CREATE TABLE files (
    sha256 TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    job_id INTEGER NOT NULL REFERENCES jobs (id),
    accepted_at TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE instruments (
    name TEXT PRIMARY KEY,
    state TEXT NOT NULL,
    text TEXT NOT NULL,
    identity TEXT NOT NULL,
    changed_at TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE events (
    id INTEGER PRIMARY KEY,
    at TEXT NOT NULL,
    job_id INTEGER REFERENCES jobs (id),
    kind TEXT NOT NULL,
    text TEXT NOT NULL
) STRICT;
CREATE INDEX events_of_job ON events (job_id, id);
