// Reads the cases key by key, so that an error names its place.
#include "solve/realism/fem_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"

namespace palpate::lab {

namespace {

constexpr std::size_t kMaxCaseBytes = 64u << 20u;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error::inFile(file.string(), what);
}

double numberIn(const Json& object, const char* key, const std::string& where, const std::filesystem::path& file) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) fail(file, fmt::format("{}: \"{}\" must be a number", where, key));
  return found->get<double>();
}

std::vector<double> numbersIn(const Json& object, const char* key, const std::string& where,
                              const std::filesystem::path& file) {
  const auto found = object.find(key);
  const auto is_number = [](const Json& value) { return value.is_number(); };
  if (found == object.end() || !found->is_array() || !std::ranges::all_of(*found, is_number))
    fail(file, fmt::format("{}: \"{}\" must be a list of numbers", where, key));
  return found->get<std::vector<double>>();
}

tissue::LayerStack parseStack(const Json& json, const std::string& where, const std::filesystem::path& file) {
  const auto found = json.find("layers_mm_kPa");
  if (found == json.end() || !found->is_array())
    fail(file, fmt::format("{}: \"layers_mm_kPa\" must be a list of [mm, kPa]", where));
  tissue::LayerStack stack;
  for (const Json& layer : *found) {
    if (!layer.is_array() || layer.size() != 2 || !layer[0].is_number() || !layer[1].is_number())
      fail(file, fmt::format("{}: a layer must be [mm, kPa]", where));
    stack.layers.push_back({"", layer[0].get<double>(), layer[1].get<double>()});
  }
  try {
    tissue::check(stack);
  } catch (const Error& error) {
    fail(file, fmt::format("{}: {}", where, error.what()));
  }
  return stack;
}

FemCase parseCase(const Json& json, const std::string& where, std::size_t radii, const std::filesystem::path& file) {
  FemCase one;
  one.name = json.contains("name") && json["name"].is_string() ? json["name"].get<std::string>() : where;
  one.stack = parseStack(json, where, file);
  one.truth.depth_mm = numberIn(json, "depth", where, file);
  one.truth.surface_mm = numberIn(json, "u0", where, file);
  one.truth.force_n = numberIn(json, "force_N", where, file);
  one.truth.down = numbersIn(json, "uz", where, file);
  one.truth.outward = numbersIn(json, "ur", where, file);
  if (!(one.truth.depth_mm > 0.0 && one.truth.surface_mm > 0.0))
    fail(file, fmt::format("{}: depth and u0 must be above 0", where));
  if (one.truth.down.size() != radii || one.truth.outward.size() != radii)
    fail(file, fmt::format("{}: uz and ur must have {} numbers, as \"r\"", where, radii));
  return one;
}

}  // namespace

bool isLayered(const tissue::LayerStack& stack) {
  return std::ranges::any_of(
      stack.layers, [&](const tissue::Layer& layer) { return layer.young_kpa != stack.layers.front().young_kpa; });
}

FemCases readFemCases(const std::filesystem::path& file) { return parseFemCases(readFile(file, kMaxCaseBytes), file); }

FemCases parseFemCases(std::string_view text, const std::filesystem::path& file) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const JsonError& error) {
    fail(file, fmt::format("not JSON: {}", error.what()));
  }
  if (!json.is_object()) fail(file, "must be an object with \"r\" and \"cases\"");
  FemCases cases;
  cases.radii_mm = numbersIn(json, "r", "the file", file);
  if (cases.radii_mm.size() < 2 || !std::ranges::is_sorted(cases.radii_mm)) fail(file, "\"r\" must increase");
  const auto list = json.find("cases");
  if (list == json.end() || !list->is_array()) fail(file, "\"cases\" must be a list");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Json& one = (*list)[i];
    const std::string where = fmt::format("case {}", i + 1);
    if (!one.is_object()) fail(file, where + " must be an object");
    const std::string friction = one.value("friction", "none");
    if (friction != "none") {
      cases.left_out.push_back(fmt::format("{} at {} mm: friction {}", one.value("name", where),
                                           numberIn(one, "depth", where, file), friction));
      continue;
    }
    cases.cases.push_back(parseCase(one, where, cases.radii_mm.size(), file));
  }
  return cases;
}

FemCases toFemCases(const tissue::LayeredTable& table, const std::string& name) {
  FemCases cases{table.radii_mm, {}, {}};
  for (const tissue::PressedShape& shape : table.shapes) cases.cases.push_back({name, table.stack, shape});
  return cases;
}

}  // namespace palpate::lab
