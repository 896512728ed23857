#include "palpate/training/records/recording_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/trace/recording_writer.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/sha256.h"

namespace palpate::training {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRecordingsFolder = "sessions/";
constexpr std::string_view kRecordingExtension = ".session";

/// The file that its recorder left: finished, or the newest unfinished one.
std::optional<fs::path> recordedFile(const fs::path& finished) {
  std::error_code error;
  if (fs::exists(finished, error)) return finished;
  std::optional<fs::path> newest;
  fs::file_time_type when{};
  const std::string begins = finished.filename().string();
  for (const auto& entry : fs::directory_iterator(finished.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begins) || !name.ends_with(kPartialExtension)) continue;
    const auto written = entry.last_write_time(error);
    if (!newest || written > when) {
      newest = entry.path();
      when = written;
    }
  }
  return newest;
}

}  // namespace

OpenedRecording::~OpenedRecording() {
  std::error_code ignored;
  if (!file_.empty()) fs::remove_all(file_.parent_path(), ignored);  // a folder of its own
}

std::string RecordingFiles::nameFor(const Uuid& session) {
  return fmt::format("{}{}{}", kRecordingsFolder, session, kRecordingExtension);
}

fs::path RecordingFiles::pathOf(const std::string& name) const {
  checkField("session", "file", name, field_rule::file());
  return store_.folder() / name;
}

void RecordingFiles::makeFolder() const { makePrivateFolder(folder(), ExistingFolder::closed); }

std::string RecordingFiles::keyOf(const Uuid& trainee) {
  std::optional<TraineeRow> row = store_.trainee(trainee);
  if (!row) throw Error(fmt::format("trainee {} is not stored yet", trainee));
  if (!row->key_ref.empty() && vault_.find(row->key_ref)) return row->key_ref;
  row->key_ref = vault_.make();
  store_.save(*row);
  return row->key_ref;
}

bool RecordingFiles::lock(const Uuid& session) {
  std::optional<SessionRow> row = store_.rows().session(session);
  if (!row) throw Error(fmt::format("session {} is not stored yet", session));
  const fs::path finished = pathOf(nameFor(session));
  const auto recorded = recordedFile(finished);
  if (!recorded) return false;
  if (*recorded != finished) trace::copyRecording(*recorded, finished, "cut off");
  const std::string ref = keyOf(row->trainee_id);
  const auto key = vault_.find(ref);
  if (!key) throw Error::inFile(vault_.file().string(), "does not contain the key that was just made");
  const fs::path locked = finished.string() + std::string(kLockedExtension);
  lockFile(finished, locked, *key, ref);
  row->file = nameFor(session) + std::string(kLockedExtension);
  row->file_sha256 = sha256OfFile(locked);
  const Row kept = *row;
  store_.save(std::span(&kept, 1));
  for (const fs::path& file : sessionFiles(session)) {
    if (file != locked) fs::remove(file);
  }
  return true;
}

int RecordingFiles::lockLeftBehind(double older_than_s) {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  int locked = 0;
  for (const SessionRow& session : store_.sessions()) {
    const auto recorded = recordedFile(pathOf(nameFor(session.id)));
    if (!recorded) continue;
    // A writer's newest bytes are in the log next to its file.
    auto written = fs::last_write_time(*recorded, error);
    const auto log = fs::last_write_time(recorded->string() + "-wal", error);
    if (!error) written = std::max(written, log);
    if (std::chrono::duration<double>(now - written).count() < older_than_s) continue;
    locked += lock(session.id) ? 1 : 0;
  }
  return locked;
}

OpenedRecording RecordingFiles::open(const SessionRow& session) const {
  if (session.file.empty()) {
    throw Error(fmt::format("session {} has no recording: none was made, or it has been deleted", session.id));
  }
  const fs::path kept = pathOf(session.file);
  OpenedRecording opened(newTemporaryFolder("palpate-session") / (session.id + std::string(kRecordingExtension)));
  if (const auto ref = lockedWith(kept)) {
    const auto key = vault_.find(*ref);
    if (!key) throw Error::inFile(kept.string(), "its key is not in " + vault_.file().string());
    unlockFile(kept, opened.file(), *key);
    return opened;
  }
  const auto recorded = recordedFile(kept);
  if (!recorded) throw Error::inFile(kept.string(), "no such file");
  trace::copyRecording(*recorded, opened.file(), "cut off");
  return opened;
}

std::vector<fs::path> RecordingFiles::sessionFiles(const Uuid& session) const {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder(), error)) {
    if (entry.path().filename().string().starts_with(session)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace palpate::training
