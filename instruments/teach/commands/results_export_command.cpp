// `palpate train results export`: tables, one JSON file, or statements for a learning record store.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/private_folder.h"
#include "palpate/training/records/class_names.h"
#include "palpate/training/records/export.h"
#include "palpate/training/records/schema.h"
#include "palpate/training/records/trainee_code.h"
#include "teach/commands/class_part.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  ResultsArguments results;
  std::string csv, json, xapi;
  training::XapiSettings settings;
  bool columns = false;
  bool raw = false;
  bool force = false;
};

void refuseThere(const fs::path& file, bool force) {
  std::error_code error;
  if (!force && fs::exists(file, error)) throw Error::inFile(file.string(), "exists already; replace it with --force");
}

/// In the records themselves: of a database `store` is a copy.
void noteExport(const std::string& file_or_address, training::Store& store, std::size_t files) {
  constexpr const char* kActor = "palpate train results";
  const std::string what = fmt::format("{} files", files);
  if (training::isDatabaseAddress(file_or_address)) return classPart().note(file_or_address, kActor, "exported", what);
  store.rows().note(training::utcMs(), kActor, "exported", what);
}

void runResultsExport(const ExportArguments& arguments) {
  if (arguments.columns) {
    fmt::print("{}", training::schemaPage());
    return;
  }
  if (arguments.csv.empty() && arguments.json.empty() && arguments.xapi.empty()) {
    throw Error("export: expected --csv DIR, --json FILE or --xapi FILE");
  }
  if (arguments.raw && arguments.csv.empty()) throw Error("export: --raw needs --csv DIR");
  training::Store store = openedResults(arguments.results);
  std::vector<std::pair<fs::path, std::string>> files;
  if (!arguments.csv.empty()) {
    const CsvText kind = arguments.raw ? CsvText::raw : CsvText::safe;
    for (const auto& [name, text] : training::csvFiles(store.rows(), kind))
      files.emplace_back(fs::path(arguments.csv) / name, text);
  }
  if (!arguments.json.empty()) files.emplace_back(arguments.json, training::jsonText(store.rows()));
  if (!arguments.xapi.empty()) files.emplace_back(arguments.xapi, training::xapiText(store.rows(), arguments.settings));
  for (const auto& [file, text] : files) refuseThere(file, arguments.force);
  if (!arguments.csv.empty()) makePrivateFolder(arguments.csv);
  for (const auto& [file, text] : files) {
    writePrivateFile(file, text);
    fmt::print("{}\n", file.string());
  }
  noteExport(arguments.results.file, store, files.size());
  if (!arguments.xapi.empty()) {
    fmt::print(stderr,
               "note: deleting a trainee here does not delete statements in a record store; delete them there\n");
  }
}

}  // namespace

void addResultsExportCommand(Command& parent) {
  const auto [command, arguments] =
      addCommand(parent, "export", "Export records for statistics (CSV, JSON) or a learning record store (xAPI)",
                 runResultsExport);
  command.add_option("FILE", arguments.results.file, "Training records (default: your own, palpate.results)");
  command.add_option("--csv", arguments.csv, "Write one file per table, with a dictionary of the columns")
      ->type_name("DIR");
  command.add_option("--json", arguments.json, "Write everything to one file")->type_name("FILE");
  command.add_option("--xapi", arguments.xapi, "Write xAPI 1.0.3 statements")->type_name("FILE");
  command.add_option("--home-page", arguments.settings.home_page, "Home page of the xAPI accounts: a page of your own")
      ->capture_default_str()
      ->type_name("URL");
  command.add_flag("--raw", arguments.raw,
                   "Write texts that begin like a formula (= + - @) unchanged, for programs; without it an apostrophe "
                   "goes before them");
  command.add_flag("--force", arguments.force, "Replace existing files");
  command.add_flag("--columns", arguments.columns, "Print every table and column of the records (Markdown) and stop");
}

}  // namespace palpate::app
