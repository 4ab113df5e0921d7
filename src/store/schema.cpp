#include "store/schema.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace morsel::store {
namespace {

// A published step is never changed.
//
// Version 1, with stored thumbnails, was never released. Version 2: a signature is stored once for
// a content; a row's checksum is over its other columns (rows.cpp). Version 3: each change has a
// number, which the shapes it concerns keep, so that a copy of the signatures is brought up to date
// from what changed, and proves by the digest of all rows that it is complete, also after the
// database was replaced by a backup; files that could not be stored are remembered.
constexpr int kOldestSqlite = 2;
constexpr std::array<const char*, kSchemaVersion - kOldestSqlite + 1> kSqliteSteps{R"(
CREATE TABLE signatures (
  id INTEGER PRIMARY KEY,
  content TEXT NOT NULL UNIQUE,
  options TEXT NOT NULL,
  points INTEGER NOT NULL,
  signature BLOB NOT NULL,
  sketch BLOB NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;
CREATE TABLE shapes (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  class TEXT NOT NULL,
  tags TEXT NOT NULL,
  source TEXT NOT NULL,
  signature INTEGER NOT NULL REFERENCES signatures (id),
  checksum INTEGER NOT NULL
) STRICT;
CREATE INDEX shapes_of_signature ON shapes (signature);
CREATE TABLE state (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  token INTEGER NOT NULL
) STRICT;
INSERT INTO state VALUES (1, random());
CREATE TRIGGER shape_added AFTER INSERT ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER shape_changed AFTER UPDATE ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER shape_removed AFTER DELETE ON shapes BEGIN UPDATE state SET token = random(); END;
CREATE TRIGGER signature_changed AFTER UPDATE ON signatures
  BEGIN UPDATE state SET token = random(); END;
)",
                                                                                   R"(
DROP TRIGGER shape_added;
DROP TRIGGER shape_changed;
DROP TRIGGER shape_removed;
DROP TRIGGER signature_changed;
DROP TABLE state;
CREATE TABLE state (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  sequence INTEGER NOT NULL,
  digest INTEGER NOT NULL,
  shapes INTEGER NOT NULL
) STRICT;
INSERT INTO state VALUES (1, 0, 0, 0);
ALTER TABLE shapes ADD COLUMN changed INTEGER NOT NULL DEFAULT 0;
CREATE INDEX shapes_by_change ON shapes (changed);
CREATE TABLE removed (
  id INTEGER PRIMARY KEY,
  changed INTEGER NOT NULL
) STRICT;
CREATE INDEX removed_by_change ON removed (changed);
CREATE TABLE failures (
  name TEXT PRIMARY KEY,
  reason TEXT NOT NULL
) STRICT;
CREATE TRIGGER first_number AFTER UPDATE ON shapes BEGIN
  UPDATE state SET shapes = shapes + 1,
    digest = (digest | NEW.checksum) & ~(digest & NEW.checksum);
END;
UPDATE shapes SET changed = 1;
UPDATE state SET sequence = 1;
DROP TRIGGER first_number;
CREATE TRIGGER shape_added AFTER INSERT ON shapes BEGIN
  UPDATE state SET sequence = sequence + 1, shapes = shapes + 1,
    digest = (digest | NEW.checksum) & ~(digest & NEW.checksum);
  UPDATE shapes SET changed = (SELECT sequence FROM state) WHERE id = NEW.id;
END;
CREATE TRIGGER shape_changed
  AFTER UPDATE OF id, name, class, tags, source, signature, checksum ON shapes BEGIN
  UPDATE state SET sequence = sequence + 1,
    digest = (digest | OLD.checksum) & ~(digest & OLD.checksum);
  UPDATE state SET digest = (digest | NEW.checksum) & ~(digest & NEW.checksum);
  UPDATE shapes SET changed = (SELECT sequence FROM state) WHERE id = NEW.id;
END;
CREATE TRIGGER shape_removed AFTER DELETE ON shapes BEGIN
  UPDATE state SET sequence = sequence + 1, shapes = shapes - 1,
    digest = (digest | OLD.checksum) & ~(digest & OLD.checksum);
  INSERT OR REPLACE INTO removed SELECT OLD.id, sequence FROM state;
END;
CREATE TRIGGER signature_changed AFTER UPDATE ON signatures BEGIN
  UPDATE state SET sequence = sequence + 1;
  UPDATE shapes SET changed = (SELECT sequence FROM state) WHERE signature = NEW.id;
END;
)"};

// Names are ordered by their bytes, as everywhere in morsel. A source may be no UTF-8. Signatures
// and sketches do not get smaller by the server's own compression.
constexpr int kOldestPostgres = 3;
constexpr std::array<const char*, kSchemaVersion - kOldestPostgres + 1> kPostgresSteps{R"(
CREATE SCHEMA morsel;
CREATE TABLE morsel.version (version INTEGER NOT NULL);
INSERT INTO morsel.version VALUES (0);
CREATE TABLE morsel.signatures (
  id BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  content TEXT COLLATE "C" NOT NULL UNIQUE,
  options TEXT NOT NULL,
  points BIGINT NOT NULL,
  signature BYTEA NOT NULL,
  sketch BYTEA NOT NULL,
  checksum BIGINT NOT NULL
);
ALTER TABLE morsel.signatures ALTER COLUMN signature SET STORAGE EXTERNAL;
ALTER TABLE morsel.signatures ALTER COLUMN sketch SET STORAGE EXTERNAL;
CREATE TABLE morsel.shapes (
  id BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  name TEXT COLLATE "C" NOT NULL UNIQUE,
  class TEXT NOT NULL,
  tags TEXT NOT NULL,
  source BYTEA NOT NULL,
  signature BIGINT NOT NULL REFERENCES morsel.signatures (id),
  checksum BIGINT NOT NULL,
  changed BIGINT NOT NULL DEFAULT 0
);
CREATE INDEX shapes_of_signature ON morsel.shapes (signature);
CREATE INDEX shapes_by_change ON morsel.shapes (changed);
CREATE TABLE morsel.removed (
  id BIGINT PRIMARY KEY,
  changed BIGINT NOT NULL
);
CREATE INDEX removed_by_change ON morsel.removed (changed);
CREATE TABLE morsel.failures (
  name TEXT COLLATE "C" PRIMARY KEY,
  reason BYTEA NOT NULL
);
CREATE TABLE morsel.state (
  id BIGINT PRIMARY KEY CHECK (id = 1),
  sequence BIGINT NOT NULL,
  digest BIGINT NOT NULL,
  shapes BIGINT NOT NULL
);
INSERT INTO morsel.state VALUES (1, 0, 0, 0);
CREATE FUNCTION morsel.number_change() RETURNS trigger LANGUAGE plpgsql AS $$
DECLARE
  number BIGINT;
BEGIN
  UPDATE morsel.state SET sequence = sequence + 1,
    shapes = shapes + CASE TG_OP WHEN 'INSERT' THEN 1 WHEN 'DELETE' THEN -1 ELSE 0 END,
    digest = digest # COALESCE(OLD.checksum, 0) # COALESCE(NEW.checksum, 0)
    RETURNING sequence INTO number;
  IF TG_OP = 'DELETE' THEN
    INSERT INTO morsel.removed VALUES (OLD.id, number);
    RETURN OLD;
  END IF;
  NEW.changed := number;
  RETURN NEW;
END $$;
CREATE TRIGGER shape_changed BEFORE INSERT OR UPDATE OR DELETE ON morsel.shapes
  FOR EACH ROW EXECUTE FUNCTION morsel.number_change();
CREATE FUNCTION morsel.number_signature() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  UPDATE morsel.shapes SET changed = 0 WHERE signature = NEW.id;
  RETURN NULL;
END $$;
CREATE TRIGGER signature_changed AFTER UPDATE ON morsel.signatures
  FOR EACH ROW EXECUTE FUNCTION morsel.number_signature();
)"};

}  // namespace

const Schema kSqliteSchema{kOldestSqlite, kSqliteSteps.data(), ""};
const Schema kPostgresSchema{kOldestPostgres, kPostgresSteps.data(), "OVERRIDING SYSTEM VALUE "};

int check_version(Connection& connection) {
  const int version = connection.version();
  if (version > kSchemaVersion) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: was written by a newer morsel (version {} of the tables, this "
                            "program knows {}); update morsel",
                            connection.name(), version, kSchemaVersion));
  }
  if (version != 0 && version < connection.schema().oldest) {
    throw Error(ErrorCode::kInput,
                fmt::format("{}: was written by an early state of morsel (version {} of the "
                            "tables, this program knows {}); index its shapes into a new database",
                            connection.name(), version, kSchemaVersion));
  }
  return version;
}

void migrate(Connection& connection) {
  Transaction transaction(connection, Connection::Mode::kWrite);
  // Another process may have done it while this one waited for its turn.
  const int version = check_version(connection);
  if (version == kSchemaVersion) return;
  const Schema& schema = connection.schema();
  for (int to = version == 0 ? schema.oldest : version + 1; to <= kSchemaVersion; ++to) {
    connection.run_script(schema.steps[to - schema.oldest]);
  }
  connection.set_version(kSchemaVersion);
  transaction.commit();
}

}  // namespace morsel::store
