// A small SQLite file of its own: safe against power cuts, several programs at once, and deleted data is overwritten
// (secure_delete). Its journal is emptied with every change; no program can reach a file system's copies of freed
// blocks, or a solid-state disk's of overwritten ones.
#include "palpate/training/records/key_vault.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/trace/known_schema.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::training {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKeyTable =
    "CREATE TABLE IF NOT EXISTS trainee_key (ref TEXT NOT NULL PRIMARY KEY, secret BLOB NOT NULL) STRICT";

void requireVault(trace::Database& vault) {
  static const trace::KnownSchema known = trace::schemaMadeBy(kKeyTable);
  trace::requireKnownSchema(vault, known, "a vault of keys");
}

trace::Database openedVault(const fs::path& file) {
  using Mode = trace::Database::Mode;
  std::error_code error;
  const bool there = fs::exists(file, error);
  trace::Database vault(file, there ? Mode::write : Mode::create);
  requireVault(vault);
  vault.run("PRAGMA journal_mode = TRUNCATE; PRAGMA synchronous = EXTRA; PRAGMA secure_delete = ON");
  vault.run(kKeyTable);
  return vault;
}

}  // namespace

KeyVault::KeyVault(const fs::path& records) : file_(fs::path(records).replace_extension(".keys")) {}

std::string KeyVault::make() {
  const TraineeKey key = newTraineeKey();
  const std::string ref = fmt::format("k{:016x}", systemRandom()[0]);
  trace::Database vault = openedVault(file_);
  trace::Statement insert(vault, "INSERT INTO trainee_key (ref, secret) VALUES (?1, ?2)");
  insert.with(std::string_view(ref)).withBlob({reinterpret_cast<const char*>(key.data()), key.size()}).run();
  return ref;
}

std::optional<TraineeKey> KeyVault::find(const std::string& key_ref) const {
  std::error_code error;
  if (!fs::exists(file_, error)) return std::nullopt;
  trace::Database vault(file_, trace::Database::Mode::read);
  requireVault(vault);
  trace::Statement select(vault, "SELECT secret FROM trainee_key WHERE ref = ?1");
  if (!select.with(std::string_view(key_ref)).next()) return std::nullopt;
  const std::string_view secret = select.blob(0);
  TraineeKey key{};
  if (secret.size() != key.size())
    throw Error::inFile(file_.string(), "has a damaged key for this trainee; restore the file from a backup");
  std::copy_n(reinterpret_cast<const std::uint8_t*>(secret.data()), key.size(), key.begin());
  return key;
}

bool KeyVault::destroy(const std::string& key_ref) {
  std::error_code error;
  if (!fs::exists(file_, error)) return false;
  trace::Database vault = openedVault(file_);
  trace::Statement wipe(vault, "UPDATE trainee_key SET secret = zeroblob(32) WHERE ref = ?1");
  wipe.with(std::string_view(key_ref)).run();
  const bool there = vault.changes() > 0;
  trace::Statement remove(vault, "DELETE FROM trainee_key WHERE ref = ?1");
  remove.with(std::string_view(key_ref)).run();
  return there;
}

}  // namespace palpate::training
