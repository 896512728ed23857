// Statements are made from the list of fields (row_fields.h): other fields are neither written nor read.
#include "palpate/training/records/row_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <map>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/records/row_fields.h"

namespace palpate::training {

namespace {

/// Ids that may be missing are null, because they refer to a row.
bool isMissingReference(std::string_view name, const std::string& value) {
  return value.empty() && name.ends_with("_id");
}

struct FieldsToSql {
  SqlValues& values;
  void operator()(const char* name, const std::string& value, const FieldRule& /*rule*/) const {
    values.emplace_back(isMissingReference(name, value) ? SqlValue() : SqlValue(value));
  }
  void operator()(const char* /*name*/, const std::optional<double>& value, const FieldRule& /*rule*/) const {
    values.emplace_back(value ? SqlValue(*value) : SqlValue());
  }
  template <class Value>
  void operator()(const char* /*name*/, const Value& value, const FieldRule& /*rule*/) const {
    if constexpr (std::is_enum_v<Value>) {
      values.emplace_back(std::string(wordFor(value)));
    } else if constexpr (std::is_floating_point_v<Value>) {
      values.emplace_back(value);
    } else {
      values.emplace_back(static_cast<std::int64_t>(value));  // a seed's 64 bits as a signed number
    }
  }
};

struct FieldsFromSql {
  const SqlValues& values;
  std::string_view table;
  std::size_t next = 0;

  template <class Value>
  void operator()(const char* name, Value& value, const FieldRule& /*rule*/) {
    if (next >= values.size()) throw Error(fmt::format("{}: the database left out '{}'", table, name));
    const SqlValue& from = values[next++];
    if (!read(from, value))
      throw Error(fmt::format("{}: column '{}' has a value of the wrong type; see `palpate train results verify`",
                              table, name));
  }

 private:
  static bool read(const SqlValue& from, std::string& value) {
    value.clear();
    if (std::holds_alternative<std::monostate>(from)) return true;
    const auto* held = std::get_if<std::string>(&from);
    if (held != nullptr) value = *held;
    return held != nullptr;
  }
  static bool read(const SqlValue& from, double& value) {
    const auto* held = std::get_if<double>(&from);
    if (held != nullptr) value = *held;
    return held != nullptr;
  }
  static bool read(const SqlValue& from, std::optional<double>& value) {
    value.reset();
    if (std::holds_alternative<std::monostate>(from)) return true;
    return read(from, value.emplace());
  }
  template <class Value>
  static bool read(const SqlValue& from, Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      const auto* word = std::get_if<std::string>(&from);
      const auto named = word != nullptr ? valueNamed<Value>(*word) : std::nullopt;
      if (named) value = *named;
      return named.has_value();
    } else {
      const auto* held = std::get_if<std::int64_t>(&from);
      if (held != nullptr) value = static_cast<Value>(*held);
      return held != nullptr;
    }
  }
};

template <class R>
std::vector<std::string> columnNames(std::string_view table = {}) {
  std::vector<std::string> names;
  const R row{};
  eachField(
      [&](const char* name, const auto& /*value*/, const FieldRule& /*rule*/) {
        names.push_back(table.empty() ? name : fmt::format("{}.{}", table, name));
      },
      row);
  return names;
}

template <class R>
std::string tableOf() {
  return std::string(kindOf(AnyRow(R{})));
}

template <class R>
constexpr std::string_view kKeyOf = "id";
template <>
constexpr std::string_view kKeyOf<ProtocolRow> = "id, version";

/// Condition for a row from a network to replace the stored one.
template <class R>
constexpr std::string_view kNewerThanKept;
template <>
constexpr std::string_view kNewerThanKept<StationRow> = "excluded.calibrated_ms >= station.calibrated_ms";
template <>
constexpr std::string_view kNewerThanKept<SessionRow> =
    "excluded.end_ms >= session.end_ms AND length(excluded.file_sha256) >= length(session.file_sha256)";
// A state holds all outcomes so far: the longer one is the later one.
template <>
constexpr std::string_view kNewerThanKept<BlockRow> =
    "excluded.finished >= block.finished AND excluded.trials >= block.trials AND "
    "length(excluded.state_json) >= length(block.state_json)";

/// Over a network. Retention is set by the class's own folder (RowSink), not by a station.
template <class R>
constexpr bool kNeverChanges =
    std::same_as<R, TrialRow> || std::same_as<R, EventRow> || std::same_as<R, ProtocolRow> || std::same_as<R, ClassRow>;

template <class R>
std::string insertStatement(RowTables::Update update) {
  const std::vector<std::string> columns = columnNames<R>();
  std::vector<std::string> places, sets;
  for (const std::string& column : columns) {
    places.push_back(fmt::format("${}", places.size() + 1));
    if (kKeyOf<R>.find(column) == std::string_view::npos) sets.push_back(fmt::format("{0} = excluded.{0}", column));
  }
  const bool careful = update == RowTables::Update::when_newer;
  std::string text = fmt::format("INSERT INTO {} ({}) VALUES ({}) ON CONFLICT ({}) DO ", tableOf<R>(),
                                 fmt::join(columns, ", "), fmt::join(places, ", "), kKeyOf<R>);
  if (careful && kNeverChanges<R>) return text + "NOTHING";
  text += fmt::format("UPDATE SET {}", fmt::join(sets, ", "));
  if (careful && !kNewerThanKept<R>.empty()) text += fmt::format(" WHERE {}", kNewerThanKept<R>);
  return text;
}

/// Made once.
template <class R>
const std::string& cachedInsertStatement(RowTables::Update update) {
  static const std::string always = insertStatement<R>(RowTables::Update::always);
  static const std::string newer = insertStatement<R>(RowTables::Update::when_newer);
  return update == RowTables::Update::always ? always : newer;
}

template <class R>
bool insertRow(Sql& sql, const R& row, RowTables::Update update) {
  SqlValues values;
  eachField(FieldsToSql{values}, row);
  return sql.change(cachedInsertStatement<R>(update), values) > 0;
}

/// Inserts this many rows at once: over a network each statement costs a round trip.
std::string visitsStatement(std::size_t rows) {
  const auto columns = columnNames<SiteVisit>();
  std::string text = fmt::format("INSERT INTO site_visit (trial_id, {}) VALUES ", fmt::join(columns, ", "));
  std::size_t place = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i <= columns.size(); ++i) {
      text += fmt::format("{}${}", i > 0 ? ", " : row > 0 ? "), (" : "(", ++place);
    }
  }
  return text + ")";
}

void insertVisits(Sql& sql, const TrialRow& trial) {
  if (trial.visits.empty()) return;
  SqlValues values;
  for (const SiteVisit& visit : trial.visits) {
    values.emplace_back(trial.id);
    eachField(FieldsToSql{values}, visit);
  }
  sql.change(visitsStatement(trial.visits.size()), values);
}

template <class R>
bool storeRow(Sql& sql, const R& row, RowTables::Update update) {
  if constexpr (std::same_as<R, DeletionRow>) {
    throw Error("a deletion cannot be stored as a row");
  } else {
    checkRow(kindOf(AnyRow(row)), row);
    if constexpr (std::same_as<R, TraineeRow>) {
      // A sender that does not know the class's name still has its id.
      if (!row.class_id.empty()) {
        static const std::string insert =
            "INSERT INTO class (id, label, retain_days, retain_samples_days) VALUES ($1, $2, $3, $4) "
            "ON CONFLICT (id) DO NOTHING";
        const ClassRow standard;
        sql.change(insert, {row.class_id, row.class_id, std::int64_t{standard.retain_days},
                            std::int64_t{standard.retain_samples_days}});
      }
    }
    const bool changed = insertRow(sql, row, update);
    if constexpr (std::same_as<R, TrialRow>) {
      if (!changed) return false;
      if (update == RowTables::Update::always) sql.change("DELETE FROM site_visit WHERE trial_id = $1", {row.id});
      insertVisits(sql, row);
    }
    return changed;
  }
}

/// Names the row that is missing where the database says "foreign key".
std::string explained(const AnyRow& row, std::string_view cause) {
  const std::string what = fmt::format("{} {}", kindOf(row), oneLine(rowId(row)));
  const bool lacks =
      cause.find("FOREIGN KEY") != std::string_view::npos || cause.find("foreign key") != std::string_view::npos;
  if (!lacks) return fmt::format("{} cannot be stored: {}", what, cause);
  if (const auto* block = std::get_if<BlockRow>(&row)) {
    return fmt::format("{} cannot be stored before its session {} and protocol {} version {}", what,
                       oneLine(block->session_id), oneLine(block->protocol_id), block->protocol_version);
  }
  if (const auto* session = std::get_if<SessionRow>(&row)) {
    return fmt::format("{} cannot be stored before its trainee {} and station {}", what, oneLine(session->trainee_id),
                       oneLine(session->station_id));
  }
  if (const auto* trial = std::get_if<TrialRow>(&row)) {
    return fmt::format("{} cannot be stored before its block {} and session {}", what, oneLine(trial->block_id),
                       oneLine(trial->session_id));
  }
  return fmt::format("{} cannot be stored before the row that it belongs to", what);
}

}  // namespace

bool RowTables::save(const AnyRow& row, Update update) {
  try {
    return std::visit([&](const auto& held) { return storeRow(sql_, held, update); }, row);
  } catch (const DatabaseAway&) {
    throw;  // nothing is wrong with the row
  } catch (const Error& error) {
    const std::string words = explained(row, error.cause());
    throw error.file().empty() ? Error(words) : Error::inFile(error.file(), words);
  }
}

template <class R>
std::vector<R> RowTables::read(const std::string& condition, const SqlValues& values) {
  const std::string table = tableOf<R>();
  const std::string text =
      fmt::format("SELECT {} FROM {} {}", fmt::join(columnNames<R>(table), ", "), table, condition);
  std::vector<R> rows;
  for (const SqlValues& found : sql_.ask(text, values)) eachField(FieldsFromSql{found, table}, rows.emplace_back());
  return rows;
}

template <class R>
std::optional<R> RowTables::one(const Uuid& id) {
  if (!isUuid(id)) return std::nullopt;  // PostgreSQL would call it an error
  std::vector<R> rows = read<R>("WHERE id = $1", {id});
  return rows.empty() ? std::nullopt : std::optional(std::move(rows.front()));
}

void RowTables::fillVisits(std::vector<TrialRow>& trials, const std::string& condition, const SqlValues& values) {
  std::map<Uuid, TrialRow*> by_id;
  for (TrialRow& trial : trials) by_id[trial.id] = &trial;
  const std::string text =
      fmt::format("SELECT {}, site_visit.trial_id FROM site_visit JOIN trial ON trial.id = site_visit.trial_id {}",
                  fmt::join(columnNames<SiteVisit>("site_visit"), ", "), condition);
  for (const SqlValues& found : sql_.ask(text, values)) {
    const auto* id = found.empty() ? nullptr : std::get_if<std::string>(&found.back());
    const auto trial = id == nullptr ? by_id.end() : by_id.find(*id);
    if (trial == by_id.end()) continue;
    eachField(FieldsFromSql{found, "site_visit"}, trial->second->visits.emplace_back());
  }
}

std::vector<StationRow> RowTables::stations() { return read<StationRow>("ORDER BY id", {}); }
std::vector<ClassRow> RowTables::classes() { return read<ClassRow>("ORDER BY id", {}); }
std::vector<TraineeRow> RowTables::trainees() { return read<TraineeRow>("ORDER BY created_ms, id", {}); }
std::optional<TraineeRow> RowTables::trainee(const Uuid& id) { return one<TraineeRow>(id); }
std::vector<ProtocolRow> RowTables::protocols() { return read<ProtocolRow>("ORDER BY id, version", {}); }

std::vector<SessionRow> RowTables::sessions(const Uuid& trainee) {
  if (trainee.empty()) return read<SessionRow>("ORDER BY start_ms, id", {});
  if (!isUuid(trainee)) return {};
  return read<SessionRow>("WHERE trainee_id = $1 ORDER BY start_ms, id", {trainee});
}

std::optional<SessionRow> RowTables::session(const Uuid& id) { return one<SessionRow>(id); }

std::vector<BlockRow> RowTables::blocks(const Uuid& session) {
  return isUuid(session) ? read<BlockRow>("WHERE session_id = $1 ORDER BY number, id", {session})
                         : std::vector<BlockRow>();
}

std::optional<BlockRow> RowTables::block(const Uuid& id) { return one<BlockRow>(id); }

std::vector<TrialRow> RowTables::trials(const Uuid& block) {
  if (!isUuid(block)) return {};
  std::vector<TrialRow> found = read<TrialRow>("WHERE block_id = $1 ORDER BY number", {block});
  fillVisits(found, "WHERE trial.block_id = $1 ORDER BY trial.number, site_visit.site", {block});
  return found;
}

std::optional<TrialRow> RowTables::trial(const Uuid& id) {
  std::optional<TrialRow> found = one<TrialRow>(id);
  if (!found) return found;
  std::vector<TrialRow> list = {std::move(*found)};
  fillVisits(list, "WHERE trial.id = $1 ORDER BY site_visit.site", {id});
  return std::move(list.front());
}

std::vector<EventRow> RowTables::events(const Uuid& session) {
  return isUuid(session) ? read<EventRow>("WHERE session_id = $1 ORDER BY at_ms, id", {session})
                         : std::vector<EventRow>();
}

std::optional<InterruptedBlock> RowTables::interrupted(const Uuid& trainee, SessionKind kind) {
  if (!isUuid(trainee)) return std::nullopt;
  const std::vector<BlockRow> newest = read<BlockRow>(
      "JOIN session ON session.id = block.session_id WHERE session.trainee_id = $1 AND session.kind = $2 "
      "AND block.state_json <> '' ORDER BY session.start_ms DESC, block.number DESC, block.id DESC LIMIT 1",
      {trainee, std::string(wordFor(kind))});
  if (newest.empty() || newest.front().finished) return std::nullopt;
  const std::optional<SessionRow> of = session(newest.front().session_id);
  return of ? std::optional(InterruptedBlock{*of, newest.front()}) : std::nullopt;
}

std::optional<BlockRow> RowTables::lastMeasured(const Uuid& trainee) {
  if (!isUuid(trainee)) return std::nullopt;
  const std::vector<BlockRow> newest = read<BlockRow>(
      "JOIN session ON session.id = block.session_id WHERE session.trainee_id = $1 AND block.finished "
      "AND block.threshold > 0 AND block.method <> 'mastery' "
      "AND session.kind IN ('pre_test', 'post_test', 'exam', 'retention') "
      "ORDER BY session.start_ms DESC, block.number DESC, block.id DESC LIMIT 1",
      {trainee});
  return newest.empty() ? std::nullopt : std::optional(newest.front());
}

std::int64_t RowTables::trialCount() { return sql_.number("SELECT count(*) FROM trial"); }

std::vector<AnyRow> RowTables::all() {
  std::vector<AnyRow> rows;
  const auto add = [&rows](const auto& more) { rows.insert(rows.end(), more.begin(), more.end()); };
  add(stations());
  add(classes());
  add(protocols());
  add(trainees());
  for (const SessionRow& session : sessions()) {
    rows.emplace_back(session);
    for (const BlockRow& block : blocks(session.id)) {
      rows.emplace_back(block);
      add(trials(block.id));
    }
    add(events(session.id));
  }
  return rows;
}

bool RowTables::erase(const Uuid& trainee) {
  if (!isUuid(trainee)) return false;
  sql_.change("DELETE FROM origin WHERE subject = $1", {trainee});
  return sql_.change("DELETE FROM trainee WHERE id = $1", {trainee}) > 0;  // the rest follows (ON DELETE CASCADE)
}

void RowTables::note(std::int64_t at_ms, std::string_view actor, std::string_view action, std::string_view subject) {
  sql_.change("INSERT INTO audit (at_ms, actor, action, subject) VALUES ($1, $2, $3, $4)",
              {at_ms, std::string(actor), std::string(action), std::string(subject)});
}

std::optional<std::int64_t> RowTables::noted(std::string_view action, std::string_view subject) {
  const auto rows = sql_.ask("SELECT at_ms FROM audit WHERE action = $1 AND subject = $2 ORDER BY at_ms DESC LIMIT 1",
                             {std::string(action), std::string(subject)});
  if (rows.empty()) return std::nullopt;
  return std::get<std::int64_t>(rows.front().front());
}

}  // namespace palpate::training
