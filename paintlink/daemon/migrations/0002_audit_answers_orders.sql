-- Events become a chain of hashes and the outbox of the sinks; answers of the
-- formulation software, sprayed panels, orders and verdicts get their tables.

ALTER TABLE events ADD COLUMN facts TEXT NOT NULL DEFAULT '{}';
ALTER TABLE events ADD COLUMN chain TEXT NOT NULL DEFAULT '';

CREATE TABLE meta (
    key TEXT PRIMARY KEY,
    value TEXT NOT NULL
) STRICT, WITHOUT ROWID;
INSERT INTO meta SELECT 'audit_after', coalesce(max(id), 0) FROM events;

CREATE TABLE orders (
    id INTEGER PRIMARY KEY,
    token TEXT NOT NULL UNIQUE,
    sample TEXT NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('open', 'measured', 'cancelled')),
    document TEXT NOT NULL,
    created_at TEXT NOT NULL
) STRICT;
CREATE INDEX orders_open ON orders (sample, id) WHERE state = 'open';

CREATE TABLE jobs_2 (
    id INTEGER PRIMARY KEY,
    token TEXT NOT NULL UNIQUE,
    reading_id INTEGER REFERENCES readings (id),
    source TEXT NOT NULL,
    origin TEXT NOT NULL CHECK (origin IN ('real', 'simulated')),
    state TEXT NOT NULL CHECK (
        state IN ('collecting', 'received', 'specified', 'matched', 'done', 'failed')
    ),
    spec BLOB,
    error TEXT NOT NULL DEFAULT '',
    created_at TEXT NOT NULL,
    order_id INTEGER REFERENCES orders (id),
    panel_of INTEGER REFERENCES jobs (id),
    iteration INTEGER NOT NULL DEFAULT 0,
    CHECK (reading_id IS NOT NULL OR spec IS NOT NULL)
) STRICT;
INSERT INTO jobs_2 (
    id, token, reading_id, source, origin, state, spec, error, created_at
) SELECT id, token, reading_id, source, origin, state, spec, error, created_at FROM jobs;
DROP TABLE jobs;
ALTER TABLE jobs_2 RENAME TO jobs;
CREATE INDEX jobs_waiting ON jobs (state, id) WHERE state NOT IN ('done', 'failed');
CREATE INDEX jobs_panels ON jobs (panel_of, iteration) WHERE panel_of IS NOT NULL;
CREATE INDEX jobs_of_order ON jobs (order_id) WHERE order_id IS NOT NULL;

ALTER TABLE readings ADD COLUMN job_id INTEGER REFERENCES jobs (id);
UPDATE readings SET job_id = (SELECT id FROM jobs WHERE reading_id = readings.id);
CREATE INDEX readings_of_job ON readings (job_id);

CREATE TABLE deliveries_2 (
    id INTEGER PRIMARY KEY,
    job_id INTEGER NOT NULL REFERENCES jobs (id),
    route TEXT NOT NULL,
    copy INTEGER NOT NULL DEFAULT 1,
    folder TEXT NOT NULL,
    state TEXT NOT NULL CHECK (
        state IN ('pending', 'publishing', 'written', 'stale', 'taken', 'answered',
            'failed', 'unknown', 'closed')
    ),
    name TEXT NOT NULL DEFAULT '',
    sha256 TEXT NOT NULL DEFAULT '',
    error TEXT NOT NULL DEFAULT '',
    attempts INTEGER NOT NULL DEFAULT 0,
    retry_at REAL NOT NULL DEFAULT 0,
    written_at TEXT NOT NULL DEFAULT '',
    UNIQUE (job_id, route, copy)
) STRICT;
INSERT INTO deliveries_2 SELECT id, job_id, route, copy, folder, state, name, sha256,
    error, attempts, retry_at, written_at FROM deliveries;
DROP TABLE deliveries;
ALTER TABLE deliveries_2 RENAME TO deliveries;
CREATE INDEX deliveries_open ON deliveries (state, retry_at)
    WHERE state IN ('pending', 'publishing', 'written', 'stale');

CREATE TABLE answers (
    id INTEGER PRIMARY KEY,
    sha256 TEXT NOT NULL UNIQUE,
    file TEXT NOT NULL,
    job_id INTEGER NOT NULL REFERENCES jobs (id),
    iteration INTEGER NOT NULL,
    state TEXT NOT NULL CHECK (
        state IN ('open', 'accepted', 'rejected', 'refused', 'superseded')
    ),
    document BLOB NOT NULL,
    received_at TEXT NOT NULL,
    decided_at TEXT NOT NULL DEFAULT ''
) STRICT;
CREATE INDEX answers_of_job ON answers (job_id, iteration);

CREATE TABLE verdicts (
    job_id INTEGER NOT NULL REFERENCES jobs (id),
    judge TEXT NOT NULL CHECK (judge IN ('machine', 'human')),
    verdict TEXT NOT NULL CHECK (verdict IN ('pass', 'marginal', 'fail')),
    document TEXT NOT NULL,
    at TEXT NOT NULL,
    PRIMARY KEY (job_id, judge)
) STRICT, WITHOUT ROWID;

CREATE TABLE sinks (
    name TEXT PRIMARY KEY,
    last_event INTEGER NOT NULL,
    attempts INTEGER NOT NULL DEFAULT 0,
    retry_at REAL NOT NULL DEFAULT 0,
    error TEXT NOT NULL DEFAULT ''
) STRICT, WITHOUT ROWID;
