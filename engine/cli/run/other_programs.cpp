#include "cli/run/other_programs.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <string>

#include "cli/kit/families.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

using viewer::ActivityState;

constexpr double kLookAgainS = 0.5;
/// Lines of tools/build-later: which family follows, and the end.
constexpr std::string_view kBegins = "build-later: ";
constexpr std::string_view kFailed = "build-later: failed";

/// Reads a line of ninja: "[37/120] Building ...".
void readSteps(std::string_view line, ActivityState& state) {
  const std::size_t slash = line.find('/');
  if (!line.starts_with('[') || slash == std::string_view::npos) return;
  int done = 0, of = 0;
  const char* const end = line.data() + line.size();
  const auto [after, error] = std::from_chars(line.data() + 1, end, done);
  const auto [closed, second] = std::from_chars(line.data() + slash + 1, end, of);
  if (error != std::errc() || second != std::errc() || after != line.data() + slash || closed == end ||
      *closed != ']') {
    return;
  }
  state.done = done;
  state.of = of;
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

ActivityState stateOfBuild(std::string_view log, std::string_view family) {
  ActivityState state{.kind = ActivityState::Kind::being_built};
  bool is_ours = false;
  for (const std::string_view line : split(log, '\n')) {
    if (line == kFailed) return {};
    if (line.starts_with(kBegins)) {
      is_ours = line.substr(kBegins.size()) == family;
    } else if (is_ours) {
      readSteps(line, state);
    }
  }
  return state;
}

OtherPrograms::OtherPrograms(const Own& own) : own_(own) { build_log_ = pathOf(system::variable("PALPATE_BUILD_LOG")); }

ActivityState OtherPrograms::find(bool own, std::string_view family) const {
  if (own) return {.kind = ActivityState::Kind::here};
  if (!familyProgram(family).empty()) return {.kind = ActivityState::Kind::elsewhere};
  return build_log_.empty() ? ActivityState{} : stateOfBuild(textOf(build_log_), family);
}

const viewer::Activities& OtherPrograms::now() {
  if (looked_ != Clock::time_point{} && secondsSince(looked_) < kLookAgainS) return activities_;
  looked_ = Clock::now();
  activities_ = {find(false, "teach"), find(own_.measuring, "measure"), find(own_.classes, "class")};
  return activities_;
}

}  // namespace palpate::app
