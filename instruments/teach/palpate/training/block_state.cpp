#include "palpate/training/block_state.h"

#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/json.h"

namespace palpate::training {

namespace {

/// Changes with the way in which trials follow from settings, seed and outcomes: an older block would go on wrongly.
constexpr int kPlanningVersion = 1;
/// Longer than any block: an upper bound for counts in a damaged file.
constexpr std::size_t kMaxOutcomes = 100'000;

constexpr std::string_view kWhere = "state of a block";

Error wrongState(const std::string& cause) { return Error::inFile(kWhere, cause); }

TrialOutcome parseOutcome(const Json& row) {
  if (!row.is_array() || row.size() != 4) throw wrongState("an outcome is not four numbers");
  for (const Json& number : row) {
    if (!number.is_number_integer() || number.get<std::int64_t>() < 0 || number.get<std::int64_t>() > 1000)
      throw wrongState("an outcome is not four numbers");
  }
  return {.answer = row[0].get<int>(),
          .correct = row[1].get<int>() != 0,
          .visited = row[2].get<int>(),
          .target_visited = row[3].get<int>() != 0};
}

}  // namespace

std::string settingsDigest(const BlockSettings& settings) {
  Hash hash;
  for (const auto choice : {static_cast<std::uint64_t>(settings.method), static_cast<std::uint64_t>(settings.meaning),
                            static_cast<std::uint64_t>(settings.draw), std::uint64_t{settings.levels.size()}}) {
    hash.add(choice);
  }
  for (const double level : settings.levels) hash.add(level);
  for (const int number :
       {settings.choices, settings.warm_up, settings.easy, settings.stop.least, settings.stop.most}) {
    hash.add(static_cast<std::uint64_t>(number));
  }
  for (const double number :
       {settings.start, settings.easy_share, settings.stop.half_width, settings.stop.mark, settings.stop.sure,
        settings.prior.threshold, settings.prior.sd_ln_t, settings.prior.slope, settings.prior.sd_ln_slope}) {
    hash.add(number);
  }
  return fmt::format("{:016x}", hash.value());
}

std::string blockStateText(const BlockSettings& settings, const BlockState& state) {
  Json text;
  text["version"] = kPlanningVersion;
  text["seed"] = state.seed;
  text["settings"] = settingsDigest(settings);
  text["outcomes"] = Json::array();
  for (const TrialOutcome& outcome : state.outcomes) {
    text["outcomes"].push_back(
        {outcome.answer, outcome.correct ? 1 : 0, outcome.visited, outcome.target_visited ? 1 : 0});
  }
  return jsonDump(text);
}

BlockState parseBlockState(const BlockSettings& settings, std::string_view text) {
  const Json read = Json::tryParse(text);
  if (!read.is_object()) throw wrongState("not JSON, or no object");
  const auto version = read.find("version");
  if (version == read.end() || !version->is_number() || version->get<double>() != kPlanningVersion) {
    throw wrongState(
        fmt::format("not of version {}: it was begun by another version of the program", kPlanningVersion));
  }
  const auto digest = read.find("settings");
  if (digest == read.end() || !digest->is_string() || digest->text() != settingsDigest(settings)) {
    throw wrongState("the protocol has changed since it was begun");
  }
  const auto seed = read.find("seed");
  if (seed == read.end() || !seed->is_number_unsigned()) throw wrongState("no seed");
  const auto outcomes = read.find("outcomes");
  if (outcomes == read.end() || !outcomes->is_array() || outcomes->size() > kMaxOutcomes) {
    throw wrongState("no list of outcomes");
  }
  BlockState state{.seed = seed->get<std::uint64_t>(), .outcomes = {}};
  for (const Json& row : *outcomes) state.outcomes.push_back(parseOutcome(row));
  return state;
}

}  // namespace palpate::training
