// `palpate recording list`: the recording files in a folder, and their contents.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/readable_text.h"
#include "cli/own/commands.h"
#include "cli/recording/recording_text.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "view/viewer/files/recording_keeper.h"

namespace palpate::app {

namespace {

struct RecordingsArguments {
  std::filesystem::path folder = ".";
  bool window = false;
  bool json = false;
};

std::vector<std::filesystem::path> recordingFiles(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
    if (trace::isRecording(entry.path()) && entry.is_regular_file(error)) files.push_back(entry.path());
  }
  if (error) throw Error::inFile(folder.string(), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

void runRecordings(const RecordingsArguments& arguments) {
  Json json = Json::array();
  std::string text;
  const std::filesystem::path folder = arguments.window ? viewer::recordingsFolder() : arguments.folder;
  if (arguments.window && !std::filesystem::is_directory(folder)) {
    throw Error(fmt::format("{}: the window has not recorded anything yet", folder.string()));
  }
  for (const std::filesystem::path& file : recordingFiles(folder)) {
    try {
      const trace::RecordingReader reader(file);
      Json entry = {{"file", file.string()}};
      entry.update(factsJson(reader.facts()));
      json.push_back(entry);
      text += fmt::format("{}  {}\n", file.string(), recordingLine(reader.facts()));
    } catch (const Error& error) {
      json.push_back({{"file", file.string()}, {"error", error.what()}});
      text += fmt::format("{}\n", error.what());
    }
  }
  if (text.empty()) text = fmt::format("no recording (*.session) under {}\n", folder.string());
  printReadable(arguments.json ? jsonText(json) : text);
}

}  // namespace

void addRecordingsCommand(Command& recording) {
  const auto [command, arguments] =
      addCommand(recording, "list", "List the recordings in a folder and their contents", runRecordings);
  command.add_option("FOLDER", arguments.folder, "Folder to search, including its subfolders")->capture_default_str();
  command.add_flag("--window", arguments.window, "List the window's automatic recordings, wherever they are");
  command.add_flag("--json", arguments.json, "Print a list of objects");
}

}  // namespace palpate::app
