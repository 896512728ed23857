#include "palpate/training/records/store.h"

#include <algorithm>
#include <cstdlib>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/records/sqlite_sql.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::training {

namespace {

namespace fs = std::filesystem;

/// The id by which tools identify a file: schema.cpp writes it.
constexpr std::int64_t kOurApplicationId = 0x50616c52;
// Settings that are on or off.
constexpr const char* kOutboxSetting = "outbox";
constexpr const char* kCopiesSetting = "copies";
/// Before a class's id.
const std::string kTraineeKeySetting = "trainee_key/";

bool isOn(Sql& sql, const char* setting) {
  return !sql.ask("SELECT value FROM setting WHERE name = $1 AND value = 'on'", {std::string(setting)}).empty();
}

void turn(Sql& sql, const char* setting, bool on) {
  sql.change(
      "INSERT INTO setting (name, value) VALUES ($1, $2) ON CONFLICT (name) DO UPDATE SET value = excluded.value",
      {std::string(setting), std::string(on ? "on" : "off")});
}

/// An empty file: its creator was killed before it had a table.
void makeEmptyFile(const fs::path& file) {
  std::error_code error;
  const bool was_there = fs::exists(file, error);
  try {
    trace::Database(file, trace::Database::Mode::create).run("VACUUM");
  } catch (...) {  // a full disk
    if (!was_there && fs::file_size(file, error) == 0 && !error) fs::remove(file, error);
    throw;
  }
}

/// Tables of every version, created or migrated.
const trace::KnownSchema& schemaOfRecords() {
  static const trace::KnownSchema known = [] {
    trace::KnownSchema all;
    for (int begun = 1; begun <= kSchemaVersion; ++begun) {
      std::string text = ddl(Dialect::sqlite, begun);
      all.merge(trace::schemaMadeBy(text));
      for (int to = begun + 1; to <= kSchemaVersion; ++to)
        all.merge(trace::schemaMadeBy(text += migration(Dialect::sqlite, to)));
    }
    return all;
  }();
  return known;
}

/// Asked of nothing but a table of ours.
bool isOfNewerSchema(SqliteSql& sql) {
  const auto found = sql.ask("SELECT sql FROM sqlite_schema WHERE name = 'schema_version'");
  if (found.size() != 1) return false;
  const auto* text = std::get_if<std::string>(&found.front().front());
  return text != nullptr && trace::isKnown(schemaOfRecords(), *text) && readSchemaVersion(sql) > kSchemaVersion;
}

std::unique_ptr<SqliteSql> openedRecords(const fs::path& file, Store::Open how,
                                         std::optional<std::chrono::milliseconds> max_wait) {
  std::error_code error;
  if (how == Store::Open::create_too && !fs::exists(file, error)) {
    if (file.has_parent_path()) makePrivateFolder(file.parent_path());
    makeEmptyFile(file);
  }
  using Mode = trace::Database::Mode;
  auto sql = std::make_unique<SqliteSql>(file, how == Store::Open::read_only ? Mode::read : Mode::write);
  if (max_wait) sql->setMaxWait(*max_wait);
  std::int64_t id = 0;
  try {
    id = sql->number("PRAGMA application_id");
    // Never tables of ours into a stranger's database, such as a recording.
    if (id == 0 && sql->number("SELECT count(*) FROM sqlite_schema") == 0 && how != Store::Open::read_only) {
      id = kOurApplicationId;
    }
  } catch (const Error& cause) {
    if (cause.cause().find("is not a recording") == std::string_view::npos) throw;
  }
  if (id != kOurApplicationId) throw Error::inFile(file.string(), "holds no training records");
  if (!isOfNewerSchema(*sql))
    sql->requireKnownSchema(schemaOfRecords(), "training records");  // newer: `settle` says so
  return sql;
}

void settle(SqliteSql& sql, const fs::path& file, Store::Open how) {
  sql.run("PRAGMA foreign_keys = ON");
  if (how == Store::Open::read_only) {
    const int version = readSchemaVersion(sql);
    if (version == kSchemaVersion) return;
    throw Error::inFile(file.string(),
                        version > kSchemaVersion
                            ? "was written by a newer palpate"
                            : "was written by an older palpate; `palpate train results list` upgrades it");
  }
  // Rows are on the disk when `save` returns: every commit waits for it. Deleted data is overwritten.
  sql.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA secure_delete = ON");
  migrateSchema(sql, file.string());
}

}  // namespace

struct Store::Impl {
  fs::path file;
  std::unique_ptr<SqliteSql> sql;
  RowTables rows;
  bool outbox = false;
  bool copies = false;

  Impl(const fs::path& named, std::unique_ptr<SqliteSql> opened, Open how)
      : file(named), sql(std::move(opened)), rows(*sql) {
    settle(*sql, file, how);
    outbox = isOn(*sql, kOutboxSetting);
    copies = isOn(*sql, kCopiesSetting);
  }

  void queue(const AnyRow& row) {
    const std::string kind(kindOf(row));
    const std::string key = outboxKey(row);
    const std::string body = rowJson(row);
    // A waiting older version is replaced in place: rows that refer to it come after it.
    if (sql->change("UPDATE outbox SET row_id = $1, body = $2, refused = '' WHERE subject = $3 AND kind = $4",
                    {key, body, rowId(row), kind}) == 0) {
      sql->change("INSERT INTO outbox (kind, subject, row_id, body) VALUES ($1, $2, $3, $4)",
                  {kind, rowId(row), key, body});
    }
  }
  void save(const AnyRow& row) {
    rows.save(row);
    if (outbox) queue(row);
  }
  void storeAlone(const AnyRow& row) {
    SqlTransaction transaction(*sql);
    save(row);
    transaction.commit();
  }
};

Store::Store(const fs::path& file, Open how, std::optional<std::chrono::milliseconds> max_wait)
    : impl_(std::make_unique<Impl>(file, openedRecords(file, how, max_wait), how)) {}
Store::Store(std::unique_ptr<Impl> tables) : impl_(std::move(tables)) {}
Store Store::inMemory(const std::string& called) {
  auto sql = std::make_unique<SqliteSql>(":memory:", trace::Database::Mode::create, called);
  Store store(std::make_unique<Impl>(called, std::move(sql), Open::create_too));
  store.holdCopies();
  return store;
}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;

void Store::save(const StationRow& row) { impl_->storeAlone(row); }
void Store::save(const ClassRow& row) { impl_->storeAlone(row); }
void Store::save(const TraineeRow& row) { impl_->storeAlone(row); }
void Store::save(const ProtocolRow& row) { impl_->storeAlone(row); }

void Store::save(std::span<const Row> rows) {
  if (rows.empty()) return;
  SqlTransaction transaction(*impl_->sql);
  for (const Row& row : rows) impl_->save(anyRow(row));
  transaction.commit();
}

void Store::storeAnyRows(std::span<const AnyRow> rows) {
  if (rows.empty()) return;
  SqlTransaction transaction(*impl_->sql);
  for (const AnyRow& row : rows) impl_->save(row);
  transaction.commit();
}

std::vector<StationRow> Store::stations() { return impl_->rows.stations(); }
std::vector<ClassRow> Store::classes() { return impl_->rows.classes(); }
std::vector<TraineeRow> Store::trainees() { return impl_->rows.trainees(); }
std::optional<TraineeRow> Store::trainee(const Uuid& id) { return impl_->rows.trainee(id); }
std::vector<ProtocolRow> Store::protocols() { return impl_->rows.protocols(); }
std::vector<SessionRow> Store::sessions(const Uuid& trainee) { return impl_->rows.sessions(trainee); }
std::vector<BlockRow> Store::blocks(const Uuid& session) { return impl_->rows.blocks(session); }
std::vector<TrialRow> Store::trials(const Uuid& block) { return impl_->rows.trials(block); }
std::vector<EventRow> Store::events(const Uuid& session) { return impl_->rows.events(session); }

std::optional<Store::Interrupted> Store::interrupted(const Uuid& trainee, SessionKind kind) {
  return impl_->rows.interrupted(trainee, kind);
}
std::optional<BlockRow> Store::lastMeasured(const Uuid& trainee) { return impl_->rows.lastMeasured(trainee); }

void Store::fillOutbox(bool on) {
  if (on == impl_->outbox) return;
  SqlTransaction transaction(*impl_->sql);
  turn(*impl_->sql, kOutboxSetting, on);
  if (on) {
    for (const AnyRow& row : impl_->rows.all()) impl_->queue(row);
  }
  transaction.commit();
  impl_->outbox = on;
}

bool Store::fillsOutbox() const { return impl_->outbox; }

void Store::holdCopies() {
  if (!impl_->copies) turn(*impl_->sql, kCopiesSetting, true);
  impl_->copies = true;
}

bool Store::holdsCopies() const { return impl_->copies; }

void Store::queueDeletion(const DeletionRow& notice) { impl_->queue(notice); }

std::vector<OutboxEntry> Store::waiting(std::size_t most) {
  std::vector<OutboxEntry> entries;
  for (const SqlValues& row :
       impl_->sql->ask("SELECT number, kind, row_id, body FROM outbox WHERE refused = '' ORDER BY number LIMIT $1",
                       {static_cast<std::int64_t>(most)})) {
    entries.push_back({std::get<std::int64_t>(row[0]), std::get<std::string>(row[1]), std::get<std::string>(row[2]),
                       std::get<std::string>(row[3])});
  }
  return entries;
}

void Store::acknowledged(std::span<const Uuid> rows) {
  if (rows.empty()) return;
  SqlTransaction transaction(*impl_->sql);
  for (const Uuid& row : rows) impl_->sql->change("DELETE FROM outbox WHERE row_id = $1", {row});
  transaction.commit();
}

std::size_t Store::waitingCount() {
  return static_cast<std::size_t>(impl_->sql->number("SELECT count(*) FROM outbox"));
}

void Store::refused(std::span<const Uuid> rows, std::string_view why) {
  SqlTransaction transaction(*impl_->sql);
  for (const Uuid& row : rows) {
    impl_->sql->change("UPDATE outbox SET refused = $1 WHERE row_id = $2", {std::string(why), row});
  }
  transaction.commit();
}

std::size_t Store::refusedCount() {
  return static_cast<std::size_t>(impl_->sql->number("SELECT count(*) FROM outbox WHERE refused <> ''"));
}

void Store::tryRefusedAgain() { impl_->sql->change("UPDATE outbox SET refused = '' WHERE refused <> ''"); }

void Store::applyDeletionNotice(std::span<const std::string> marks) {
  SqlTransaction transaction(*impl_->sql);
  // A waiting trainee's row would not be kept: a later one must come after this notice.
  std::vector<Uuid> gone;
  for (const SqlValues& row : impl_->sql->ask("SELECT subject FROM outbox WHERE kind = 'trainee'")) {
    const auto& subject = std::get<std::string>(row[0]);
    if (std::ranges::find(marks, deletedMark(subject)) != marks.end()) gone.push_back(subject);
  }
  for (const Uuid& id : gone) impl_->sql->change("DELETE FROM outbox WHERE kind = 'trainee' AND subject = $1", {id});
  for (const std::string& mark : marks) {
    // A waiting one, or one that requests the deletion itself, says so already.
    if (impl_->sql->number("SELECT count(*) FROM outbox WHERE kind = 'delete' AND subject = $1", {mark}) == 0) {
      impl_->queue(DeletionRow{mark, 0});
    }
  }
  transaction.commit();
}

void Store::rememberTraineeKey(const std::string& class_id, const std::string& key) {
  if (key.empty()) return;
  impl_->sql->change(
      "INSERT INTO setting (name, value) VALUES ($1, $2) ON CONFLICT (name) DO UPDATE SET value = excluded.value",
      {kTraineeKeySetting + class_id, key});
}

std::vector<Uuid> Store::derivePseudonyms(std::string_view code) {
  std::vector<std::string> classes = {""};
  for (const ClassRow& row : this->classes()) classes.push_back(row.id);
  std::vector<Uuid> ids;
  for (const std::string& class_id : classes) {
    for (const SqlValues& row :
         impl_->sql->ask("SELECT value FROM setting WHERE name = $1", {kTraineeKeySetting + class_id})) {
      ids.push_back(derivePseudonym(class_id, code, std::get<std::string>(row[0])));
    }
    ids.push_back(derivePseudonym(class_id, code));
  }
  return ids;
}

RowTables& Store::rows() { return impl_->rows; }

const fs::path& Store::file() const { return impl_->file; }
fs::path Store::folder() const {
  const fs::path folder = impl_->file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

std::filesystem::path defaultRecords() {
  const std::filesystem::path name = "palpate/palpate.results";
  // The specification of base directories: a relative path there is to be ignored.
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/') {
    return std::filesystem::path(data) / name;
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".local/share" / name;
  }
  throw Error("no folder for records: set XDG_DATA_HOME or HOME, or name a file");
}

}  // namespace palpate::training
