// Fields of the shipped stacks as text: fourth roots in steps of 1/4095 of the greatest of their row, two characters
// each, so that a density is within half a percent down to a thousandth of the greatest.
#include "palpate/tissue/library_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/neighbours.h"

namespace palpate::tissue {

namespace {

/// A row of one stack at its place.
struct ShippedRow {
  double depth_mm;
  int layer;
  double shear_scale;
  double volume_scale;
  const char* shear;
  const char* volume;
};

struct ShippedField {
  std::size_t rows;
  std::size_t presses;
};

#include "palpate/tissue/library_fields_numbers.inc"

constexpr double kSteps = 4095.0;

double decodeStep(char high, char low) {
  const auto digit = [](char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : 63;
  };
  return 64.0 * digit(high) + digit(low);
}

void appendRow(std::string_view text, double scale, std::vector<float>& roots) {
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    roots.push_back(static_cast<float>(scale * decodeStep(text[i], text[i + 1]) / kSteps));
  }
}

struct LibraryStack {
  LayerStack stack;
  PressField field;
};

std::vector<LibraryStack> decodedStacks() {
  std::vector<LibraryStack> stacks;
  const ShippedRow* row = std::begin(kFieldRows);
  const PressurePattern* pattern = std::begin(kFieldPatterns);
  const auto shares = libraryFatShares();
  for (const ShippedField& shipped : kFields) {
    const std::size_t i = stacks.size();
    LibraryStack& one = stacks.emplace_back();
    one.stack = libraryStack(libraryThicknesses()[i / shares.size()], shares[i % shares.size()]);
    PressField& field = one.field;
    field.radii_mm.assign(std::begin(kFieldRadiiMm), std::end(kFieldRadiiMm));
    field.depths_mm.assign(std::begin(kFieldDepthsMm), std::begin(kFieldDepthsMm) + shipped.presses);
    field.patterns.assign(pattern, pattern + shipped.presses);
    pattern += shipped.presses;
    for (std::size_t r = 0; r < shipped.rows; ++r, ++row) {
      field.rows_mm.push_back(row->depth_mm);
      field.row_layers.push_back(row->layer);
      appendRow(row->shear, row->shear_scale, field.shear);
      appendRow(row->volume, row->volume_scale, field.volume);
    }
  }
  return stacks;
}

}  // namespace

LayerStack placeStack(double thickness_mm, double fat_mm) {
  return libraryStack(thickness_mm, libraryFatShare(thickness_mm, fat_mm));
}

std::vector<WeightedField> libraryFieldsAt(double thickness_mm, double fat_mm) {
  static const std::vector<LibraryStack> stacks = decodedStacks();
  const auto shares = libraryFatShares();
  const Neighbours thick = findNeighbours(libraryThicknesses(), thickness_mm, true);
  std::vector<WeightedField> fields;
  const auto add = [&](std::size_t thickness, double weight) {
    const double fat = libraryFatShare(libraryThicknesses()[thickness], fat_mm);
    const Neighbours fatty = findNeighbours(shares, fat);
    for (const auto& [i, share] : {std::pair{fatty.below, 1.0 - fatty.share}, std::pair{fatty.above, fatty.share}}) {
      const LibraryStack& one = stacks[thickness * shares.size() + i];
      if (weight * share > 0.0) fields.push_back({&one.stack, &one.field, weight * share});
    }
  };
  add(thick.below, 1.0 - thick.share);
  add(thick.above, thick.share);
  return fields;
}

LumpPlace libraryPlaceAt(double thickness_mm, double fat_mm) {
  return {placeStack(thickness_mm, fat_mm), libraryFieldsAt(thickness_mm, fat_mm)};
}

LumpPlace tablePlace(const LayeredTable& table, std::string_view name) {
  if (!table.field)
    throw Error(fmt::format(
        "{} has no press field, which lumps require; make the table with palpate tissue solve --field", name));
  return {table.stack, {{&table.stack, &*table.field, 1.0}}};
}

}  // namespace palpate::tissue
