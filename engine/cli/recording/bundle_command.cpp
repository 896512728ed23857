// `palpate recording bundle`: a recording with the files that its scene names, in one file to give away.
#include <fmt/format.h>

#include <Eigen/Core>
#include <memory>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/system/process.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/trace/recording_edit.h"

namespace palpate::app {

namespace {

struct BundleArguments {
  std::filesystem::path file;
  std::filesystem::path out;
  std::filesystem::path folder;
  std::vector<std::filesystem::path> included;
  bool json = false;
};

using Words = std::vector<std::pair<std::string, std::string>>;

/// Names that are too short or too common to identify a person stay.
void addWord(Words& words, const std::string& word, const char* with) {
  if (word.size() < 3 || word == "root" || word == "localhost" || word == "user") return;
  words.emplace_back(word, with);
}

void addFolder(Words& words, const std::string& folder) {
  if (folder.size() > 1 && folder != "/root") words.emplace_back(folder, "~");
}

/// Words that identify this user and computer: account, full name, home, computer.
Words collectPrivateNames() {
  Words words;
  const system::Identity here = system::identity();
  for (const std::string& account : here.accounts) addWord(words, account, "user");
  addWord(words, here.full_name, "user");
  for (const std::string& home : here.homes) addFolder(words, home);
  addWord(words, here.computer, "host");
  addWord(words, here.computer.substr(0, here.computer.find('.')), "host");
  return words;
}

std::string versionsText(const BundleArguments& arguments, const trace::RecordingFacts& facts) {
  trace::Database database(arguments.file, trace::Database::Mode::read);
  trace::Statement sqlite(database, "SELECT sqlite_version()");
  sqlite.next();
  const trace::RecordingHeader here = engine::recordingHeader(facts.header.ticks_per_s);
  return fmt::format(
      "recorded by  {} on {}\nbundled by   {} on {}\ntables       version {}\ncompiler     {}\nSQLite       {}\n"
      "Eigen        {}.{}.{}\nfmt          {}\n",
      facts.header.software, facts.header.machine, here.software, here.machine, facts.version, __VERSION__,
      sqlite.text(0), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, FMT_VERSION);
}

/// Allows real files, not the names that a foreign scene has for them.
std::vector<std::filesystem::path> allowedBy(const BundleArguments& arguments) {
  std::vector<std::filesystem::path> allowed = arguments.included;
  const std::filesystem::path beside = arguments.file.parent_path();
  allowed.push_back(beside.empty() ? "." : beside);
  if (!arguments.folder.empty()) allowed.push_back(arguments.folder);
  return allowed;
}

void refuseFilesOutside(trace::RecordingReader& recording, const BundleArguments& arguments,
                        const engine::BundleSettings& settings) {
  const std::vector<std::filesystem::path> files = engine::filesOutside(recording, settings);
  if (files.empty()) return;
  std::string names;
  std::string options;
  for (const std::filesystem::path& file : files) {
    names += (names.empty() ? "" : ", ") + file.string();
    options += fmt::format(" --include '{}'", file.string());
  }
  throw Error::inFile(
      arguments.file.string(),
      fmt::format("its scene uses files outside the recording's folder: {}; to include them, add{}", names, options));
}

void print(const BundleArguments& arguments, const engine::BundleReport& report) {
  if (arguments.json) {
    Json files = Json::array();
    for (const auto& file : report.files) files.push_back({{"name", file.name}, {"bytes", file.bytes}});
    const Json json = {
        {"file", arguments.out.string()}, {"samples", report.samples}, {"files", files}, {"notes", report.notes}};
    printReadable(jsonText(json));
    return;
  }
  std::string text =
      fmt::format("{}: {} samples, {} files of the scene; `palpate recording replay` needs no other files\n",
                  arguments.out.string(), report.samples, report.files.size());
  for (const auto& file : report.files) text += fmt::format("  file  {}, {} bytes\n", file.name, file.bytes);
  for (const std::string& note : report.notes) text += "  note  " + note + "\n";
  printReadable(text);
}

void runBundle(const BundleArguments& arguments) {
  trace::refuseSame(arguments.out, arguments.file);
  const FinishesInOrder in_order;  // carried files are in a folder that must be removed again
  const trace::ReadingWatch watch(throwIfInterrupted);
  ProgressLine progress;
  trace::RecordingReader recording(arguments.file);
  engine::BundleSettings settings;
  settings.folder = arguments.folder;
  settings.allowed = allowedBy(arguments);
  settings.hidden = collectPrivateNames();
  settings.versions = versionsText(arguments, recording.facts());
  refuseFilesOutside(recording, arguments, settings);
  const engine::BundleReport report = engine::bundle(recording, arguments.out, settings, progress.callback());
  progress.clear();
  print(arguments, report);
}

}  // namespace

void addBundleCommand(Command& recording) {
  const auto [command, a] = addCommand(
      recording, "bundle",
      "Write a self-contained copy with all files of its scene, and without names of people or folders", runBundle);
  command.add_option("RECORDING", a.file, "Recording file")->required();
  namesFileToWrite(command.add_option("-o,--out", a.out, "Recording file to write"))->required();
  command.add_option("--folder", a.folder, "Folder of the files that the scene names (default: where they were)");
  command
      .add_option("--include", a.included,
                  "Also pack the scene's files from this file or folder, repeatable; required for files outside the "
                  "recording's folder and --folder")
      ->type_name("PATH")
      ->allow_extra_args(false);
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
