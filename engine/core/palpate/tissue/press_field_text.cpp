// The field of a press as JSON: every digit, so that a table read and written again is the same.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/mesh/files/detail/json.h"
#include "palpate/tissue/press_field.h"

namespace palpate::tissue {

namespace {

template <class Number>
std::string rowsOfText(std::string_view name, const std::vector<Number>& numbers, std::size_t per_line) {
  std::string text = fmt::format("    \"{}\": [", name);
  for (std::size_t from = 0; from < numbers.size(); from += per_line) {
    const auto line = std::span(numbers).subspan(from, std::min(per_line, numbers.size() - from));
    text += fmt::format("{}{}", from == 0 ? "" : ",\n      ", fmt::join(line, ", "));
  }
  return text + "]";
}

/// Numbers of a kind that a value must have, whatever they are.
template <class Number>
std::vector<Number> listIn(const mesh::JsonValue& of, std::string_view name) {
  const mesh::JsonValue list = of[name];
  if (!list) of.fail(fmt::format("has no \"{}\"", name));
  std::vector<Number> numbers;
  try {
    for (const mesh::JsonValue& item : list.items()) numbers.push_back(static_cast<Number>(item.number()));
  } catch (const Error&) {
    list.fail(fmt::format("\"{}\" must be a list of numbers", name));
  }
  return numbers;
}

std::vector<int> layersIn(const mesh::JsonValue& of) {
  constexpr double kMax = 1000.0;
  std::vector<int> layers;
  for (const double layer : listIn<double>(of, "row_layers")) {
    if (!(layer >= 0.0 && layer < kMax && layer == static_cast<int>(layer))) {
      of["row_layers"].fail("\"row_layers\" must be whole numbers from 0");
    }
    layers.push_back(static_cast<int>(layer));
  }
  return layers;
}

}  // namespace

std::string fieldText(const PressField& field) {
  constexpr std::size_t kPerLine = 12;
  std::vector<double> radii;
  std::vector<double> exponents;
  for (const PressurePattern& pattern : field.patterns) {
    radii.push_back(pattern.contact_radius_mm);
    exponents.push_back(pattern.exponent);
  }
  std::string text = "{\n";
  text += rowsOfText("radii_mm", field.radii_mm, kPerLine) + ",\n";
  text += rowsOfText("rows_mm", field.rows_mm, kPerLine) + ",\n";
  text += rowsOfText("row_layers", field.row_layers, 2 * kPerLine) + ",\n";
  text += rowsOfText("depths_mm", field.depths_mm, kPerLine) + ",\n";
  text += rowsOfText("contact_radius_mm", radii, kPerLine) + ",\n";
  text += rowsOfText("pressure_exponent", exponents, kPerLine) + ",\n";
  text += rowsOfText("shear", field.shear, kPerLine) + ",\n";
  return text + rowsOfText("volume", field.volume, kPerLine) + "}";
}

PressField fieldFrom(const mesh::JsonValue& value) {
  PressField field{.radii_mm = listIn<double>(value, "radii_mm"),
                   .rows_mm = listIn<double>(value, "rows_mm"),
                   .row_layers = layersIn(value),
                   .depths_mm = listIn<double>(value, "depths_mm"),
                   .patterns = {},
                   .shear = listIn<float>(value, "shear"),
                   .volume = listIn<float>(value, "volume")};
  const auto radii = listIn<double>(value, "contact_radius_mm");
  const auto exponents = listIn<double>(value, "pressure_exponent");
  if (radii.size() != exponents.size()) value.fail("\"contact_radius_mm\" and \"pressure_exponent\" must be as long");
  for (std::size_t i = 0; i < radii.size(); ++i) field.patterns.push_back({radii[i], exponents[i]});
  return field;
}

}  // namespace palpate::tissue
