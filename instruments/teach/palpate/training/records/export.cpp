#include "palpate/training/records/export.h"

#include <fmt/format.h>

#include <set>

#include "palpate/base/json.h"
#include "palpate/training/records/row_fields.h"
#include "palpate/training/records/schema.h"

namespace palpate::training {

namespace {

std::string csvCell(const std::string& value, CsvText kind) { return csvTextCell(value, kind); }
std::string csvCell(const std::optional<double>& value, CsvText /*kind*/) {
  return value ? fmt::format("{}", *value) : std::string();
}
template <class Value>
std::string csvCell(const Value& value, CsvText /*kind*/) {
  if constexpr (std::is_enum_v<Value>) {
    return std::string(wordFor(value));
  } else {
    return fmt::format("{}", value);
  }
}

template <class R>
std::string csvHeader() {
  std::string line;
  const R row{};
  eachField([&line](const char* name, const auto& /*value*/,
                    const FieldRule& /*rule*/) { line += (line.empty() ? "" : ",") + std::string(name); },
            row);
  return line;
}

template <class R>
std::string csvLine(const R& row, CsvText kind) {
  std::string line;
  bool first = true;
  eachField(
      [&](const char* /*name*/, const auto& value, const FieldRule& /*rule*/) {
        if (!first) line += ',';
        line += csvCell(value, kind);
        first = false;
      },
      row);
  return line;
}

template <class R>
ExportedFile csvTable(const std::string& name, const std::vector<AnyRow>& rows, CsvText kind) {
  ExportedFile file{name, csvHeader<R>() + "\r\n"};
  for (const AnyRow& row : rows) {
    if (const auto* held = std::get_if<R>(&row)) file.text += csvLine(*held, kind) + "\r\n";
  }
  return file;
}

ExportedFile csvVisits(const std::vector<AnyRow>& rows, CsvText kind) {
  ExportedFile file{"site_visits.csv", "trial_id," + csvHeader<SiteVisit>() + "\r\n"};
  for (const AnyRow& row : rows) {
    const auto* trial = std::get_if<TrialRow>(&row);
    if (trial == nullptr) continue;
    for (const SiteVisit& visit : trial->visits) file.text += trial->id + "," + csvLine(visit, kind) + "\r\n";
  }
  return file;
}

ExportedFile csvDictionary() {
  const std::set<std::string_view> own = {"schema_version", "setting", "outbox", "origin", "audit"};
  ExportedFile file{"data_dictionary.csv", "table,column,meaning\r\n"};
  for (const TableInfo& table : tables()) {
    if (own.contains(table.name)) continue;
    for (const ColumnInfo& column : table.columns) {
      file.text += fmt::format("{},{},{}\r\n", table.name, column.name, csvTextCell(column.means));
    }
  }
  return file;
}

}  // namespace

std::vector<AnyRow> exportedRows(RowTables& rows) {
  std::vector<AnyRow> all = rows.all();
  std::set<Uuid> going_on;  // sessions with a block that will ask more
  for (const AnyRow& row : all) {
    const auto* block = std::get_if<BlockRow>(&row);
    if (block != nullptr && !block->finished) going_on.insert(block->session_id);
  }
  for (AnyRow& row : all) {
    if (auto* block = std::get_if<BlockRow>(&row); block != nullptr && !block->finished) block->state_json.clear();
    if (auto* event = std::get_if<EventRow>(&row); event != nullptr && event->kind == "message") event->text.clear();
    auto* session = std::get_if<SessionRow>(&row);
    if (session != nullptr && going_on.contains(session->id)) session->rng_seed = 0;
  }
  return all;
}

std::vector<ExportedFile> csvFiles(RowTables& rows, CsvText kind) {
  const std::vector<AnyRow> all = exportedRows(rows);
  return {csvTable<StationRow>("stations.csv", all, kind), csvTable<ClassRow>("classes.csv", all, kind),
          csvTable<TraineeRow>("trainees.csv", all, kind), csvTable<ProtocolRow>("protocols.csv", all, kind),
          csvTable<SessionRow>("sessions.csv", all, kind), csvTable<BlockRow>("blocks.csv", all, kind),
          csvTable<TrialRow>("trials.csv", all, kind),     csvVisits(all, kind),
          csvTable<EventRow>("events.csv", all, kind),     csvDictionary()};
}

std::string jsonText(RowTables& rows) {
  Json json = {{"format", "palpate train results"}, {"schema", kSchemaVersion}};
  for (const char* kind : {"station", "class", "trainee", "protocol", "session", "block", "trial", "event"}) {
    json[kind] = Json::array();
  }
  for (const AnyRow& row : exportedRows(rows)) {
    json[std::string(kindOf(row))].push_back(Json::parse(rowJson(row)));
  }
  return jsonDump(json, 1) + "\n";
}

}  // namespace palpate::training
