// Stacks and tables are checked number by number, so that a mistake is told with its place; the JSON is read by the
// reader that bounds a stranger's file and written with every digit.
#include "palpate/tissue/layered_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/json.h"

namespace palpate::tissue {

namespace {

constexpr int kTableVersion = 1;
constexpr std::uint64_t kMaxTableBytes = 64'000'000;
constexpr std::size_t kMaxLayers = 16;
constexpr std::size_t kMaxRadii = 10'000;
constexpr std::size_t kMaxShapes = 1'000;
constexpr std::size_t kMaxFingers = 100;
constexpr std::size_t kLongestLayerName = 40;

constexpr NumberRange kThickness{0.1, 500.0};
constexpr NumberRange kYoung{0.01, 1e6};
constexpr NumberRange kPoisson{0.0, 0.499};
constexpr NumberRange kIndenterRadius{0.1, 1000.0};
constexpr NumberRange kTableRadii{0.0, 10'000.0};
constexpr NumberRange kTableDepths{0.0, 500.0, true};
constexpr NumberRange kTableForces{0.0, 1e6};
constexpr NumberRange kFingerTableForces{0.0, 1e6, true};
constexpr NumberRange kContactRadii{0.0, 1000.0};
/// Relative to the skin on the axis; bulges and dents stay within this.
constexpr NumberRange kShapeShares{-100.0, 100.0};
constexpr NumberRange kDragExponent{0.0, 10.0, true};
constexpr NumberRange kDragWidth{0.0, 1000.0, true};
constexpr NumberRange kStiffnessRatio{0.0, 10.0, true};

/// On the axis the skin moves as itself, and nowhere sideways: up to the rounding of a written number.
constexpr double kOnAxis = 1e-3;

void requireInRange(const NumberRange& range, double value, std::string_view where, std::string_view name,
                    std::string_view unit = {}) {
  if (range.holds(value)) return;
  throw Error(fmt::format("{}: {} = {}", where, name, outOfRange(fmt::format("{}", value), range, unit)));
}

bool isPlain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ' || c == '-' || c == '_' || c == '.';
}

void check(const Layer& layer, std::string_view where) {
  if (layer.name.size() > kLongestLayerName || !std::ranges::all_of(layer.name, isPlain)) {
    throw Error(fmt::format("{}: '{}' is not a valid name; expected up to {} letters, digits, spaces, '-', '_', '.'",
                            where, oneLine(layer.name), kLongestLayerName));
  }
  requireInRange(kThickness, layer.thickness_mm, where, "thickness", "mm");
  requireInRange(kYoung, layer.young_kpa, where, "Young's modulus", "kPa");
}

// --- checks of a table

void checkRadii(const std::vector<double>& radii) {
  if (radii.size() < 2) throw Error("radii_mm: at least two values are required");
  if (radii.size() > kMaxRadii) throw Error(fmt::format("radii_mm: expected at most {} values", kMaxRadii));
  if (radii.front() != 0.0) throw Error(fmt::format("radii_mm: the first must be 0, not {}", radii.front()));
  for (std::size_t i = 1; i < radii.size(); ++i) {
    requireInRange(kTableRadii, radii[i], "radii_mm", fmt::format("radius {}", i + 1), "mm");
    if (radii[i] > radii[i - 1]) continue;
    throw Error(fmt::format("radii_mm: must increase, but {} follows {}", radii[i], radii[i - 1]));
  }
}

void checkShares(const std::vector<double>& shares, std::size_t radii, double on_axis, std::string_view where,
                 std::string_view name) {
  if (shares.size() != radii) {
    throw Error(fmt::format("{}: {} has {} numbers for {} radii", where, name, shares.size(), radii));
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    requireInRange(kShapeShares, shares[i], where, fmt::format("{}, number {},", name, i + 1));
  }
  if (std::abs(shares.front() - on_axis) <= kOnAxis) return;
  throw Error(fmt::format("{}: {} begins at {} instead of {}", where, name, shares.front(), on_axis));
}

void check(const PressedShape& shape, std::size_t radii, const std::string& where) {
  requireInRange(kTableDepths, shape.depth_mm, where, "depth_mm", "mm");
  requireInRange(kTableDepths, shape.surface_mm, where, "surface_mm", "mm");
  requireInRange(kTableForces, shape.force_n, where, "force_n", "N");
  requireInRange(kContactRadii, shape.contact_radius_mm, where, "contact_radius_mm", "mm");
  checkShares(shape.down, radii, 1.0, where, "down");
  checkShares(shape.outward, radii, 0.0, where, "outward");
}

void check(const DragShape& drag, std::size_t radii) {
  requireInRange(kDragExponent, drag.exponent, "drag", "exponent");
  requireInRange(kDragWidth, drag.along_mm, "drag", "along_mm", "mm");
  requireInRange(kDragWidth, drag.across_mm, "drag", "across_mm", "mm");
  requireInRange(kStiffnessRatio, drag.tangential_over_normal, "drag", "tangential_over_normal");
  if (!drag.on_along.empty()) checkShares(drag.on_along, radii, 1.0, "drag", "on_along");
  if (!drag.on_across.empty()) checkShares(drag.on_across, radii, 1.0, "drag", "on_across");
}

void check(const FingerForces& finger, const std::string& where) {
  requireInRange(kIndenterRadius, finger.radius_mm, where, "radius_mm", "mm");
  if (finger.depths_mm.empty()) throw Error(where + ": depths_mm: at least one value is required");
  if (finger.depths_mm.size() > kMaxShapes)
    throw Error(fmt::format("{}: depths_mm: expected at most {} values", where, kMaxShapes));
  if (finger.force_n.size() != finger.depths_mm.size()) {
    throw Error(
        fmt::format("{}: force_n has {} numbers for {} depths", where, finger.force_n.size(), finger.depths_mm.size()));
  }
  for (std::size_t i = 0; i < finger.depths_mm.size(); ++i) {
    requireInRange(kTableDepths, finger.depths_mm[i], where, fmt::format("depths_mm, number {},", i + 1), "mm");
    requireInRange(kFingerTableForces, finger.force_n[i], where, fmt::format("force_n, number {},", i + 1), "N");
    if (i == 0) continue;
    if (!(finger.depths_mm[i] > finger.depths_mm[i - 1])) throw Error(where + ": depths_mm must increase");
    if (finger.force_n[i] < finger.force_n[i - 1]) throw Error(where + ": force_n must not decrease");
  }
}

void checkFingers(const LayeredTable& table) {
  if (table.fingers.size() > kMaxFingers) throw Error(fmt::format("fingers: expected at most {}", kMaxFingers));
  for (std::size_t i = 0; i < table.fingers.size(); ++i) {
    const FingerForces& finger = table.fingers[i];
    check(finger, fmt::format("finger {}", i + 1));
    if (finger.radius_mm == table.indenter_radius_mm) {
      throw Error(fmt::format("finger {}: radius_mm must differ from indenter_radius_mm, {}", i + 1, finger.radius_mm));
    }
    if (i > 0 && !(finger.radius_mm > table.fingers[i - 1].radius_mm)) {
      throw Error(fmt::format("finger {}: radius_mm must increase, but {} follows {}", i + 1, finger.radius_mm,
                              table.fingers[i - 1].radius_mm));
    }
  }
}

void checkOrder(const PressedShape& before, const PressedShape& shape, const std::string& where) {
  if (!(shape.depth_mm > before.depth_mm)) {
    throw Error(fmt::format("{}: depth_mm must increase, but {} follows {}", where, shape.depth_mm, before.depth_mm));
  }
  if (shape.force_n < before.force_n) {
    throw Error(fmt::format("{}: force_n must not decrease, but {} follows {}", where, shape.force_n, before.force_n));
  }
}

// --- writing

std::string listText(const std::vector<double>& numbers, std::string_view indent) {
  constexpr std::size_t kPerLine = 12;
  std::string text = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += i % kPerLine == 0 ? fmt::format(",\n{}", indent) : ", ";
    text += fmt::format("{}", numbers[i]);
  }
  return text + "]";
}

std::string layerText(const Layer& layer) {
  return fmt::format(R"({{"name": "{}", "thickness_mm": {}, "young_kpa": {}}})", layer.name, layer.thickness_mm,
                     layer.young_kpa);
}

std::string dragText(const DragShape& drag) {
  std::string text =
      fmt::format(R"(  "drag": {{"exponent": {}, "along_mm": {}, "across_mm": {}, "tangential_over_normal": {})",
                  drag.exponent, drag.along_mm, drag.across_mm, drag.tangential_over_normal);
  if (!drag.on_along.empty()) text += fmt::format(",\n    \"on_along\": {}", listText(drag.on_along, "      "));
  if (!drag.on_across.empty()) text += fmt::format(",\n    \"on_across\": {}", listText(drag.on_across, "      "));
  return text + "},\n";
}

std::string fingersText(const std::vector<FingerForces>& fingers) {
  std::string text = "  \"fingers\": [\n";
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    text += fmt::format("{}    {{\"radius_mm\": {}, \"depths_mm\": {},\n", i == 0 ? "" : ",\n", fingers[i].radius_mm,
                        listText(fingers[i].depths_mm, "       "));
    text += fmt::format("     \"force_n\": {}}}", listText(fingers[i].force_n, "       "));
  }
  return text + "\n  ],\n";
}

std::string shapeText(const PressedShape& shape) {
  std::string text = fmt::format(R"(    {{"depth_mm": {}, "surface_mm": {}, "force_n": {}, "contact_radius_mm": {},)"
                                 "\n",
                                 shape.depth_mm, shape.surface_mm, shape.force_n, shape.contact_radius_mm);
  text += fmt::format("     \"down\": {},\n", listText(shape.down, "       "));
  return text + fmt::format("     \"outward\": {}}}", listText(shape.outward, "       "));
}

// --- reading

mesh::JsonValue member(const mesh::JsonValue& of, std::string_view name) {
  const mesh::JsonValue value = of[name];
  if (!value) of.fail(fmt::format("has no \"{}\"", name));
  return value;
}

double numberIn(const mesh::JsonValue& of, std::string_view name) {
  const mesh::JsonValue value = member(of, name);
  try {
    return value.number();
  } catch (const Error&) {
    value.fail(fmt::format("\"{}\" must be a number", name));
  }
}

std::vector<double> numbersIn(const mesh::JsonValue& of, std::string_view name) {
  const mesh::JsonValue list = member(of, name);
  std::vector<double> numbers;
  try {
    for (const mesh::JsonValue& item : list.items()) numbers.push_back(item.number());
  } catch (const Error&) {
    list.fail(fmt::format("\"{}\" must be a list of numbers", name));
  }
  return numbers;
}

LayerStack stackFrom(const mesh::JsonValue& value) {
  LayerStack stack;
  stack.poisson = numberIn(value, "poisson");
  for (const mesh::JsonValue& layer : member(value, "layers").items()) {
    stack.layers.push_back(
        {layer["name"] ? layer["name"].text() : "", numberIn(layer, "thickness_mm"), numberIn(layer, "young_kpa")});
  }
  return stack;
}

PressedShape shapeFrom(const mesh::JsonValue& value) {
  return {.depth_mm = numberIn(value, "depth_mm"),
          .surface_mm = numberIn(value, "surface_mm"),
          .force_n = numberIn(value, "force_n"),
          .contact_radius_mm = numberIn(value, "contact_radius_mm"),
          .down = numbersIn(value, "down"),
          .outward = numbersIn(value, "outward")};
}

FingerForces fingerFrom(const mesh::JsonValue& value) {
  return {.radius_mm = numberIn(value, "radius_mm"),
          .depths_mm = numbersIn(value, "depths_mm"),
          .force_n = numbersIn(value, "force_n")};
}

DragShape dragFrom(const mesh::JsonValue& value) {
  return {.exponent = numberIn(value, "exponent"),
          .along_mm = numberIn(value, "along_mm"),
          .across_mm = numberIn(value, "across_mm"),
          .tangential_over_normal = numberIn(value, "tangential_over_normal"),
          .on_along = value["on_along"] ? numbersIn(value, "on_along") : std::vector<double>(),
          .on_across = value["on_across"] ? numbersIn(value, "on_across") : std::vector<double>()};
}

// --- the words of a layer

struct Unit {
  std::string_view word;
  double factor;
};
constexpr std::array kLengths = {Unit{"mm", 1.0}, Unit{"cm", 10.0}};
constexpr std::array kModuli = {Unit{"kpa", 1.0}, Unit{"mpa", 1000.0}};

/// A number with one of these units or none; nothing when it is neither.
std::optional<double> quantityFrom(std::string_view text, std::span<const Unit> units) {
  std::string lower = inSmallLetters(trimmed(text));
  double factor = 1.0;
  for (const Unit& unit : units) {
    if (!lower.ends_with(unit.word)) continue;
    factor = unit.factor;
    lower.resize(lower.size() - unit.word.size());
    break;
  }
  const std::optional<double> number = parseNumber(lower);
  return number ? std::optional(*number * factor) : std::nullopt;
}

}  // namespace

double totalThickness(const LayerStack& stack) {
  double total = 0.0;
  for (const Layer& layer : stack.layers) total += layer.thickness_mm;
  return total;
}

void check(const LayerStack& stack) {
  if (stack.layers.empty()) throw Error("stack: at least one layer is required");
  if (stack.layers.size() > kMaxLayers) throw Error(fmt::format("stack: expected at most {} layers", kMaxLayers));
  for (std::size_t i = 0; i < stack.layers.size(); ++i) check(stack.layers[i], fmt::format("layer {}", i + 1));
  requireInRange(kPoisson, stack.poisson, "stack", "Poisson's ratio");
}

void check(const LayeredTable& table) {
  if (!table.stack.layers.empty()) check(table.stack);  // a table fitted to measured curves may have none
  requireInRange(kPoisson, table.stack.poisson, "stack", "Poisson's ratio");
  requireInRange(kIndenterRadius, table.indenter_radius_mm, "table", "indenter_radius_mm", "mm");
  checkRadii(table.radii_mm);
  if (table.shapes.empty()) throw Error("shapes: at least one is required");
  if (table.shapes.size() > kMaxShapes) throw Error(fmt::format("shapes: expected at most {}", kMaxShapes));
  for (std::size_t i = 0; i < table.shapes.size(); ++i) {
    const std::string where = fmt::format("shape {}", i + 1);
    check(table.shapes[i], table.radii_mm.size(), where);
    if (i > 0) checkOrder(table.shapes[i - 1], table.shapes[i], where);
  }
  if (table.drag) check(*table.drag, table.radii_mm.size());
  checkFingers(table);
  if (table.field) check(*table.field, table.stack);
}

std::string layeredTableText(const LayeredTable& table) {
  std::string text = fmt::format("{{\n  \"palpate_layered_table\": {},\n", kTableVersion);
  text += fmt::format("  \"stack\": {{\"poisson\": {}, \"layers\": [", table.stack.poisson);
  for (std::size_t i = 0; i < table.stack.layers.size(); ++i) {
    text += fmt::format("{}\n    {}", i == 0 ? "" : ",", layerText(table.stack.layers[i]));
  }
  text += fmt::format("]}},\n  \"indenter_radius_mm\": {},\n", table.indenter_radius_mm);
  if (table.drag) text += dragText(*table.drag);
  if (!table.fingers.empty()) text += fingersText(table.fingers);
  if (table.field) text += "  \"field\": " + fieldText(*table.field) + ",\n";
  text += fmt::format("  \"radii_mm\": {},\n  \"shapes\": [\n", listText(table.radii_mm, "    "));
  for (std::size_t i = 0; i < table.shapes.size(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ",\n", shapeText(table.shapes[i]));
  }
  return text + "\n  ]\n}\n";
}

LayeredTable parseLayeredTable(std::string_view json, std::string_view name) {
  const mesh::JsonDocument document(json, {.file = name});
  const mesh::JsonValue root = document.root();
  const mesh::JsonValue version = root["palpate_layered_table"];
  if (!version) root.fail("is not a table of layered tissue: it has no \"palpate_layered_table\"");
  if (version.number() != kTableVersion) version.fail("is a table of another version");
  LayeredTable table;
  table.stack = stackFrom(member(root, "stack"));
  table.indenter_radius_mm = numberIn(root, "indenter_radius_mm");
  table.radii_mm = numbersIn(root, "radii_mm");
  for (const mesh::JsonValue& shape : member(root, "shapes").items()) table.shapes.push_back(shapeFrom(shape));
  if (root["drag"]) table.drag = dragFrom(root["drag"]);
  if (root["fingers"]) {
    for (const mesh::JsonValue& finger : root["fingers"].items()) table.fingers.push_back(fingerFrom(finger));
  }
  if (root["field"]) table.field = fieldFrom(root["field"]);
  try {
    check(table);
  } catch (const Error& error) {
    throw Error::inFile(name, error.what());
  }
  return table;
}

LayeredTable readLayeredTable(const std::filesystem::path& file) {
  return parseLayeredTable(readFile(file, kMaxTableBytes), file.string());
}

void writeLayeredTable(const std::filesystem::path& file, const LayeredTable& table) {
  check(table);
  writeFile(file, layeredTableText(table));
}

std::optional<double> parseMillimetres(std::string_view text) { return quantityFrom(text, kLengths); }
std::optional<double> parseKilopascals(std::string_view text) { return quantityFrom(text, kModuli); }

Layer parseLayer(std::string_view text) {
  const std::string where = fmt::format("layer '{}'", oneLine(text));
  const std::vector<std::string_view> parts = split(text, ':');
  const bool named = parts.size() == 3;
  const bool formed = named || parts.size() == 2;
  const auto thickness = formed ? quantityFrom(parts[parts.size() - 2], kLengths) : std::nullopt;
  const auto young = formed ? quantityFrom(parts.back(), kModuli) : std::nullopt;
  if (!thickness || !young) throw Error(where + ": expected NAME:THICKNESS:MODULUS, e.g. skin:2mm:150kPa");
  Layer layer{
      .name = named ? std::string(parts.front()) : std::string(), .thickness_mm = *thickness, .young_kpa = *young};
  check(layer, where);
  return layer;
}

}  // namespace palpate::tissue
