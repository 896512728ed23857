// Built-in bodies as files in the user's cache: a body takes one to two seconds of a core to make and ten milliseconds
// to read, and most runs ask for the same one.
//
//   $XDG_CACHE_HOME/palpate/bodies/NAME.body     head (version, makers, recipe), hash of the bytes, bytes
//   (ready_body.h)
//
// A file is used only if its head is the expected one, letter by letter, and its hash is right. Everything else is as
// good as missing: the body is made and the file replaced. A folder that cannot be read or written costs that time
// again, but the world is built.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/output_file.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/user_stores.h"

namespace palpate::scene {

/// The version of the code that makes built-in bodies, in one line that the build writes from the sources
/// (cmake/body_makers.cmake): another version makes other bodies.
std::string_view bodyMakers();

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStoreHead = "palpate body store, version 1";
/// Some fifty default trunks.
constexpr double kUsualStoreMb = 128.0;
constexpr double kBytesInAMb = 1e6;
/// A body of two million triangles; larger ones are not kept.
constexpr std::uint64_t kMaxBodyBytes = 96'000'000;

/// Size limit of the folder, by PALPATE_BODY_CACHE_MB; 0: bodies are not kept.
std::uint64_t storeBytes() {
  const std::string text = system::variable("PALPATE_BODY_CACHE_MB");
  if (text.empty()) return static_cast<std::uint64_t>(kUsualStoreMb * kBytesInAMb);
  constexpr double kMaxStoreMb = 1e6;
  const double megabytes = parseNumber(text).value_or(0.0);
  return megabytes > 0.0 ? static_cast<std::uint64_t>(std::min(megabytes, kMaxStoreMb) * kBytesInAMb) : 0;
}

/// Empty without a home.
fs::path storeFolder() {
  const fs::path cache = system::cacheFolder();
  return cache.empty() ? cache : cache / "palpate" / "bodies";
}

std::uint64_t hashOf(std::string_view bytes) {
  Hash hash;
  for (const char byte : bytes) hash.addByte(static_cast<unsigned char>(byte));
  return hash.value();
}

/// First lines of this recipe's file.
std::string makeFileHead(std::string_view recipe) {
  return fmt::format("{}\n{}\n{}\n", kStoreHead, bodyMakers(), recipe);
}

fs::path fileNameFor(std::string_view head) { return fmt::format("{:016x}.body", hashOf(head)); }

std::string hashLine(std::string_view bytes) { return fmt::format("{:016x}\n", hashOf(bytes)); }

/// The bytes of a body, where the file is whole and has this head.
std::optional<std::string> bytesIn(const fs::path& file, std::string_view head) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  std::string content = readFile(file, kMaxBodyBytes);
  const std::size_t begin = head.size() + hashLine("").size();
  if (content.size() < begin || !content.starts_with(head)) return std::nullopt;
  const std::string_view bytes = std::string_view(content).substr(begin);
  if (content.substr(head.size(), begin - head.size()) != hashLine(bytes)) return std::nullopt;
  content.erase(0, begin);
  return content;
}

std::optional<std::string> readUserBody(std::string_view head) {
  const fs::path folder = storeFolder();
  std::error_code error;
  if (folder.empty() || !fs::is_directory(folder, error)) return std::nullopt;
  requirePrivateFolder(folder);
  std::optional<std::string> bytes = bytesIn(folder / fileNameFor(head), head);
  // So that the folder's oldest file is the one that was not used for longest.
  if (bytes) fs::last_write_time(folder / fileNameFor(head), fs::file_time_type::clock::now(), error);
  return bytes;
}

std::optional<std::string> readBundledBody(std::string_view head) {
  const fs::path programs = system::ownProgram().parent_path();
  for (const char* share : {"share", "../share"}) {  // in a build folder, in an installed program
    if (auto bytes = bytesIn(programs / share / "palpate" / "bodies" / fileNameFor(head), head)) return bytes;
  }
  return std::nullopt;
}

std::optional<std::string> findBody(std::string_view recipe) {
  if (storeBytes() == 0) return std::nullopt;
  const std::string head = makeFileHead(recipe);
  for (const auto& find : {readUserBody, readBundledBody}) {
    try {
      if (auto bytes = find(head)) return bytes;
    } catch (const Error&) {
      continue;
    }
  }
  return std::nullopt;
}

/// Removes the least recently used files, until the rest is within the bound.
void evictOldest(const fs::path& folder, std::uint64_t bound) {
  struct Kept {
    fs::file_time_type used;
    std::uint64_t bytes;
    fs::path file;
  };
  std::vector<Kept> all;
  std::uint64_t total = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    // Another process may remove a file meanwhile.
    std::error_code gone;
    const Kept kept{entry->last_write_time(gone), entry->file_size(gone), entry->path()};
    if (gone || !entry->is_regular_file(gone)) continue;
    total += kept.bytes;
    all.push_back(kept);
  }
  std::ranges::sort(all, {}, &Kept::used);
  for (const Kept& kept : all) {
    if (total <= bound) return;
    if (fs::remove(kept.file, error)) total -= kept.bytes;
  }
}

void saveBodyFile(std::string_view recipe, std::string_view bytes) {
  const std::uint64_t bound = storeBytes();
  const fs::path folder = storeFolder();
  const std::string head = makeFileHead(recipe);
  const std::string content = head + hashLine(bytes) + std::string(bytes);
  if (folder.empty() || content.size() > std::min(bound, kMaxBodyBytes)) return;
  try {
    makePrivateFolder(folder);
    requirePrivateFolder(folder);
    writePrivateFile(folder / fileNameFor(head), content);
    evictOldest(folder, bound);
  } catch (const Error&) {
    return;
  }
}

}  // namespace

BodyStore userBodyStore() { return {findBody, saveBodyFile}; }

}  // namespace palpate::scene
