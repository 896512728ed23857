PRAGMA application_id = 1348562002;
CREATE TABLE schema_version (
  number INTEGER NOT NULL PRIMARY KEY,
  at_ms INTEGER NOT NULL
) STRICT;
CREATE TABLE setting (
  name TEXT NOT NULL PRIMARY KEY,
  value TEXT NOT NULL
) STRICT;
CREATE TABLE station (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) = 36),
  name TEXT NOT NULL,
  certificate_sha256 TEXT NOT NULL,
  device TEXT NOT NULL,
  calibrated_ms INTEGER NOT NULL
) STRICT;
CREATE TABLE class (
  id TEXT NOT NULL PRIMARY KEY,
  label TEXT NOT NULL,
  retain_days INTEGER NOT NULL,
  retain_samples_days INTEGER NOT NULL
) STRICT;
CREATE TABLE trainee (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) = 36),
  class_id TEXT REFERENCES class (id),
  created_ms INTEGER NOT NULL,
  dominant_hand TEXT NOT NULL,
  consent INTEGER NOT NULL CHECK (consent IN (0, 1)),
  key_ref TEXT NOT NULL
) STRICT;
CREATE TABLE protocol (
  id TEXT NOT NULL,
  version INTEGER NOT NULL,
  text TEXT NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY (id, version)
) STRICT;
CREATE TABLE session (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) = 36),
  trainee_id TEXT NOT NULL REFERENCES trainee (id) ON DELETE CASCADE CHECK (length(trainee_id) = 36),
  station_id TEXT NOT NULL REFERENCES station (id) CHECK (length(station_id) = 36),
  kind TEXT NOT NULL,
  start_ms INTEGER NOT NULL,
  end_ms INTEGER NOT NULL,
  app_version TEXT NOT NULL,
  rng_seed INTEGER NOT NULL,
  device TEXT NOT NULL,
  file TEXT NOT NULL,
  file_sha256 TEXT NOT NULL
) STRICT;
CREATE INDEX session_index_1 ON session (trainee_id, start_ms);
CREATE INDEX session_index_2 ON session (station_id);
CREATE TABLE block (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) = 36),
  session_id TEXT NOT NULL REFERENCES session (id) ON DELETE CASCADE CHECK (length(session_id) = 36),
  number INTEGER NOT NULL,
  method TEXT NOT NULL,
  change_meaning TEXT NOT NULL,
  protocol_id TEXT NOT NULL,
  protocol_version INTEGER NOT NULL,
  state_json TEXT NOT NULL,
  finished INTEGER NOT NULL CHECK (finished IN (0, 1)),
  threshold REAL NOT NULL,
  threshold_low REAL NOT NULL,
  threshold_high REAL NOT NULL,
  trials INTEGER NOT NULL,
  mastered_change REAL,
  verdict TEXT NOT NULL,
  FOREIGN KEY (protocol_id, protocol_version) REFERENCES protocol (id, version)
) STRICT;
CREATE INDEX block_index_1 ON block (session_id, number);
CREATE TABLE trial (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) = 36),
  block_id TEXT NOT NULL REFERENCES block (id) ON DELETE CASCADE CHECK (length(block_id) = 36),
  session_id TEXT NOT NULL REFERENCES session (id) ON DELETE CASCADE CHECK (length(session_id) = 36),
  number INTEGER NOT NULL,
  start_ms INTEGER NOT NULL,
  end_ms INTEGER NOT NULL,
  seconds REAL NOT NULL,
  kind TEXT NOT NULL,
  change REAL NOT NULL,
  site_true INTEGER NOT NULL,
  site_answer INTEGER NOT NULL,
  correct INTEGER NOT NULL CHECK (correct IN (0, 1)),
  timed_out INTEGER NOT NULL CHECK (timed_out IN (0, 1)),
  excluded TEXT NOT NULL,
  sites_felt INTEGER NOT NULL,
  file_tick_first INTEGER NOT NULL,
  file_tick_last INTEGER NOT NULL,
  mean_force_n REAL NOT NULL,
  peak_force_n REAL NOT NULL,
  mean_speed_mm_per_s REAL NOT NULL,
  UNIQUE (block_id, number)
) STRICT;
CREATE INDEX trial_index_1 ON trial (session_id);
CREATE TABLE site_visit (
  trial_id TEXT NOT NULL REFERENCES trial (id) ON DELETE CASCADE CHECK (length(trial_id) = 36),
  site INTEGER NOT NULL,
  presses INTEGER NOT NULL,
  dwell_ms REAL NOT NULL,
  peak_force_n REAL NOT NULL,
  mean_force_n REAL NOT NULL,
  deepest_mm REAL NOT NULL,
  PRIMARY KEY (trial_id, site)
) STRICT;
CREATE TABLE event (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) = 36),
  session_id TEXT NOT NULL REFERENCES session (id) ON DELETE CASCADE CHECK (length(session_id) = 36),
  at_ms INTEGER NOT NULL,
  kind TEXT NOT NULL,
  text TEXT NOT NULL
) STRICT;
CREATE INDEX event_index_1 ON event (session_id, at_ms);
CREATE TABLE outbox (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  kind TEXT NOT NULL,
  subject TEXT NOT NULL,
  row_id TEXT NOT NULL,
  body TEXT NOT NULL
) STRICT;
CREATE INDEX outbox_index_1 ON outbox (subject);
CREATE INDEX outbox_index_2 ON outbox (row_id);
CREATE TABLE audit (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  at_ms INTEGER NOT NULL,
  actor TEXT NOT NULL,
  action TEXT NOT NULL,
  subject TEXT NOT NULL
) STRICT;
CREATE INDEX audit_index_1 ON audit (subject);
