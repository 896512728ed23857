// Solved lumps as small files in the user's folder, so that a scene with `lumps = "solved"` is solved once, and
// programs without a solver have what another one solved.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/user_stores.h"

namespace palpate::scene {

namespace {

constexpr std::string_view kLumpFileHead = "solved lump, version 1: depth_mm extra_n";
constexpr std::uint64_t kMaxLumpFileBytes = 1u << 16u;

/// Empty without a home.
std::filesystem::path lumpFile(std::uint64_t name) {
  const std::filesystem::path state = system::stateFolder();
  return state.empty() ? state : state / "palpate" / "lumps" / fmt::format("{:016x}.txt", name);
}

/// Nothing for a file that is not whole: the lump is solved again then.
std::optional<std::vector<SolvedPush>> pushesFrom(std::string_view text) {
  const std::vector<std::string_view> lines = split(trimmed(text), '\n');
  if (lines.size() < 2 || lines.front() != kLumpFileHead) return std::nullopt;
  std::vector<SolvedPush> pushes;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> words = split(lines[i], ' ');
    if (words.size() != 2) return std::nullopt;
    const auto depth = parseNumber(words[0]), extra = parseNumber(words[1]);
    if (!depth || !extra || !std::isfinite(*depth) || !std::isfinite(*extra)) return std::nullopt;
    if (!(*depth > (pushes.empty() ? 0.0 : pushes.back().depth_mm))) return std::nullopt;
    pushes.push_back({*depth, *extra});
  }
  return pushes;
}

std::optional<std::vector<SolvedPush>> findLump(std::uint64_t name) {
  const std::filesystem::path file = lumpFile(name);
  std::error_code error;
  if (file.empty() || !std::filesystem::is_regular_file(file, error)) return std::nullopt;
  try {
    return pushesFrom(readFile(file, kMaxLumpFileBytes));
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// A folder that cannot be written costs the time of solving again, but the world is built.
void saveLump(std::uint64_t name, std::span<const SolvedPush> pushes) {
  const std::filesystem::path file = lumpFile(name);
  if (file.empty()) return;
  std::string text(kLumpFileHead);
  for (const SolvedPush& push : pushes) text += fmt::format("\n{} {}", push.depth_mm, push.extra_n);
  try {
    makePrivateFolder(file.parent_path());
    writeFile(file, text + "\n");
  } catch (const Error&) {
    return;
  }
}

}  // namespace

LumpStore userLumpStore() { return {findLump, saveLump}; }

}  // namespace palpate::scene
