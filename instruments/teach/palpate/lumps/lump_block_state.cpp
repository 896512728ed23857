// Blocks and bodies as text: JSON, read strictly, since records come over networks too.
#include <fmt/format.h>

#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/lumps/lump_block.h"

namespace palpate::lumps {

namespace {

/// Changes with the way in which bodies follow from settings, seed and answers.
constexpr int kDrawingVersion = 1;
/// Longer than any session: an upper bound for counts in a damaged file.
constexpr std::size_t kMaxOfAny = 1000;

[[noreturn]] void wrongText(std::string_view what) {
  throw Error::inFile("lump session", fmt::format("its record has no {}", what));
}

double numberIn(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number() || !std::isfinite(found->get<double>())) wrongText(key);
  return found->get<double>();
}

int gradeIn(const Json& json, const char* key, int least) {
  const double value = numberIn(json, key);
  if (value != std::floor(value) || value < least || value >= kGrades) wrongText(key);
  return static_cast<int>(value);
}

bool truthIn(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_boolean()) wrongText(key);
  return found->get<bool>();
}

const Json& listIn(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array() || found->size() > kMaxOfAny) wrongText(key);
  return *found;
}

Vec2 placeIn(const Json& json) {
  const double x = numberIn(json, "x_mm");
  const double y = numberIn(json, "y_mm");
  return {x, y};
}

Json hiddenJson(const HiddenLump& lump) {
  return {{"x_mm", lump.place_mm.x()}, {"y_mm", lump.place_mm.y()}, {"size", lump.size}, {"depth", lump.depth},
          {"hardness", lump.hardness}, {"mobile", lump.mobile},     {"cue", lump.cue}};
}

HiddenLump parseHiddenLump(const Json& json) {
  if (!json.is_object()) wrongText("hidden");
  HiddenLump lump{.place_mm = placeIn(json), .size = gradeIn(json, "size", 0)};
  lump.depth = gradeIn(json, "depth", 0);
  lump.hardness = gradeIn(json, "hardness", 0);
  lump.mobile = truthIn(json, "mobile");
  lump.cue = numberIn(json, "cue");
  return lump;
}

Json findingJson(const LumpFinding& finding) {
  Json json = Json::object();
  if (finding.place_mm) json = {{"x_mm", finding.place_mm->x()}, {"y_mm", finding.place_mm->y()}};
  json["size"] = finding.size;
  json["depth"] = finding.depth;
  json["hardness"] = finding.hardness;
  json["mobile"] = finding.mobile;
  return json;
}

LumpFinding parseFinding(const Json& json) {
  if (!json.is_object()) wrongText("findings");
  LumpFinding finding;
  if (json.contains("x_mm")) finding.place_mm = placeIn(json);
  finding.size = gradeIn(json, "size", LumpFinding::kUnsaid);
  finding.depth = gradeIn(json, "depth", LumpFinding::kUnsaid);
  finding.hardness = gradeIn(json, "hardness", LumpFinding::kUnsaid);
  finding.mobile = gradeIn(json, "mobile", LumpFinding::kUnsaid);
  return finding;
}

Json trialJson(const LumpTrial& trial) {
  Json json = {{"hidden", Json::array()}, {"findings", Json::array()}};
  for (const HiddenLump& lump : trial.hidden) json["hidden"].push_back(hiddenJson(lump));
  for (const LumpFinding& finding : trial.findings) json["findings"].push_back(findingJson(finding));
  json["over"] = trial.over;
  json["timed_out"] = trial.timed_out;
  return json;
}

LumpTrial parseTrial(const Json& json) {
  if (!json.is_object()) wrongText("body");
  LumpTrial trial;
  for (const Json& one : listIn(json, "hidden")) trial.hidden.push_back(parseHiddenLump(one));
  for (const Json& one : listIn(json, "findings")) trial.findings.push_back(parseFinding(one));
  trial.over = truthIn(json, "over");
  trial.timed_out = truthIn(json, "timed_out");
  return trial;
}

}  // namespace

LumpTrial parseLumpTrial(std::string_view text) { return parseTrial(Json::tryParse(text)); }

std::string lumpTrialText(const LumpTrial& trial) { return jsonDump(trialJson(trial)); }

LumpState parseLumpState(std::string_view text) {
  const Json json = Json::tryParse(text);
  if (!json.is_object()) wrongText("state");
  if (numberIn(json, "lump_version") != kDrawingVersion) wrongText("version that this program knows");
  const auto seed = json.find("seed");
  if (seed == json.end() || !seed->is_number_unsigned()) wrongText("seed");
  LumpState state{.seed = seed->get<std::uint64_t>(), .exam = truthIn(json, "exam"), .trials = {}};
  for (const Json& one : listIn(json, "bodies")) state.trials.push_back(parseTrial(one));
  return state;
}

std::string lumpStateText(const LumpState& state) {
  Json json = {
      {"lump_version", kDrawingVersion}, {"seed", state.seed}, {"exam", state.exam}, {"bodies", Json::array()}};
  for (const LumpTrial& trial : state.trials) json["bodies"].push_back(trialJson(trial));
  return jsonDump(json);
}

}  // namespace palpate::lumps
