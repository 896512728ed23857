// Any SQL on a sound recording, or on an empty file that says it is one: what a stranger could have made of it is read
// or refused with an Error, within the steps that a file of its size may take. The first byte says which.
#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "../support/sound_recording.h"
#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_schema.h"

namespace {

using namespace palpate::trace;

constexpr int kStepsOfSql = 100'000;  // of what makes the file; its reader has limits of its own

const std::filesystem::path& soundSession() {
  static const palpate::TemporaryFolder folder("palpate-fuzz");
  static const std::filesystem::path file = [] {
    const std::filesystem::path made = folder.path() / "sound.session";
    palpate::support::writeSoundRecording(made);
    return made;
  }();
  return file;
}

/// As somebody else's program would: with all that SQLite can, but for so many steps alone.
void run(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* database = nullptr;
  if (::sqlite3_open(file.c_str(), &database) == SQLITE_OK) {
    ::sqlite3_limit(database, SQLITE_LIMIT_ATTACHED, 0);  // it stays in its file
    ::sqlite3_limit(database, SQLITE_LIMIT_LENGTH, 1'000'000);
    ::sqlite3_progress_handler(
        database, kStepsOfSql, [](void*) { return 1; }, nullptr);
    ::sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
  }
  ::sqlite3_close(database);
}

void readAll(const std::filesystem::path& file) {
  RecordingReader reader(file);
  for (std::uint64_t world = 0; world < reader.facts().worlds && world < 8; ++world) reader.world(world);
  reader.events();
  reader.forEachAttachment({}, [](const RecordingAttachment&) {});
  reader.damagedBlocks();
  std::uint64_t ticks = 0;
  reader.forEachTick({}, [&](std::span<const Sample>) { return ++ticks < 10000; });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 20'000) return 0;
  const std::filesystem::path file = soundSession().parent_path() / "a.session";
  std::error_code ignored;
  for (const char* end : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(file.string() + end, ignored);
  if ((data[0] & 1) != 0) std::filesystem::copy_file(soundSession(), file);
  std::string sql(reinterpret_cast<const char*>(data) + 1, size - 1);
  for (char& c : sql) c = c == '\0' ? ' ' : c;
  run(file, "PRAGMA application_id = " + std::to_string(kRecordingApplication) +
                "; PRAGMA user_version = 4; PRAGMA writable_schema = ON; " + sql);
  try {
    readAll(file);
  } catch (const palpate::Error&) {
  }
  return 0;
}
