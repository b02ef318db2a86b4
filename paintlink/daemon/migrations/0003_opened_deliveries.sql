-- Since when a delivery has been waiting, for the alarm about a stuck queue.

ALTER TABLE deliveries ADD COLUMN opened_at TEXT NOT NULL DEFAULT '';
UPDATE deliveries SET opened_at = (SELECT created_at FROM jobs WHERE id = job_id);
