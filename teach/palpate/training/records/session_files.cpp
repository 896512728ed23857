#include "palpate/training/records/session_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/trace/session_writer.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/records/sha256.h"

namespace palpate::training {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSessionsFolder = "sessions/";
constexpr std::string_view kSessionExtension = ".session";

/// What its recorder left: finished, or the newest that was not.
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

OpenedSession::~OpenedSession() {
  std::error_code ignored;
  if (!file_.empty()) fs::remove_all(file_.parent_path(), ignored);  // a folder of its own
}

std::string SessionFiles::nameFor(const Uuid& sitting) {
  return fmt::format("{}{}{}", kSessionsFolder, sitting, kSessionExtension);
}

fs::path SessionFiles::pathOf(const std::string& name) const {
  checkField("session", "file", name, field_rule::file());
  return store_.folder() / name;
}

void SessionFiles::makeFolder() const { makePrivateFolder(folder(), ExistingFolder::closed); }

std::string SessionFiles::keyOf(const Uuid& trainee) {
  std::optional<TraineeRow> row = store_.trainee(trainee);
  if (!row) throw Error(fmt::format("trainee {} is not kept yet", trainee));
  if (!row->key_ref.empty() && vault_.find(row->key_ref)) return row->key_ref;
  row->key_ref = vault_.make();
  store_.keep(*row);
  return row->key_ref;
}

bool SessionFiles::lock(const Uuid& sitting) {
  std::optional<SittingRow> row = store_.rows().sitting(sitting);
  if (!row) throw Error(fmt::format("sitting {} is not kept yet", sitting));
  const fs::path finished = pathOf(nameFor(sitting));
  const auto recorded = recordedFile(finished);
  if (!recorded) return false;
  if (*recorded != finished) trace::copySession(*recorded, finished, "cut off");
  const std::string ref = keyOf(row->trainee);
  const auto key = vault_.find(ref);
  if (!key) throw Error::inFile(vault_.file().string(), "does not hold the key that it has just made");
  const fs::path locked = finished.string() + std::string(kLockedExtension);
  lockFile(finished, locked, *key, ref);
  row->file = nameFor(sitting) + std::string(kLockedExtension);
  row->file_sha256 = sha256OfFile(locked);
  const Row kept = *row;
  store_.keep(std::span(&kept, 1));
  for (const fs::path& file : filesOf(sitting)) {
    if (file != locked) fs::remove(file);
  }
  return true;
}

int SessionFiles::lockLeftBehind(double older_than_s) {
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  int locked = 0;
  for (const SittingRow& sitting : store_.sittings()) {
    const auto recorded = recordedFile(pathOf(nameFor(sitting.id)));
    if (!recorded) continue;
    // A writer's newest bytes are in the log beside its file.
    auto written = fs::last_write_time(*recorded, error);
    const auto log = fs::last_write_time(recorded->string() + "-wal", error);
    if (!error) written = std::max(written, log);
    if (std::chrono::duration<double>(now - written).count() < older_than_s) continue;
    locked += lock(sitting.id) ? 1 : 0;
  }
  return locked;
}

OpenedSession SessionFiles::open(const SittingRow& sitting) const {
  if (sitting.file.empty()) {
    throw Error(fmt::format("sitting {} has no session file: none was recorded, or it is no longer kept", sitting.id));
  }
  const fs::path kept = pathOf(sitting.file);
  OpenedSession opened(newTemporaryFolder("palpate-session") / (sitting.id + std::string(kSessionExtension)));
  if (const auto ref = lockedWith(kept)) {
    const auto key = vault_.find(*ref);
    if (!key) throw Error::inFile(kept.string(), "its key is not in " + vault_.file().string());
    unlockFile(kept, opened.file(), *key);
    return opened;
  }
  const auto recorded = recordedFile(kept);
  if (!recorded) throw Error::inFile(kept.string(), "no such file");
  trace::copySession(*recorded, opened.file(), "cut off");
  return opened;
}

std::vector<fs::path> SessionFiles::filesOf(const Uuid& sitting) const {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder(), error)) {
    if (entry.path().filename().string().starts_with(sitting)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace palpate::training
