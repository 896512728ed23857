// Lumps for tests that ask for physics and not for numbers: a field of presses in closed form, smooth and falling with
// depth and distance as a solved one does, and lumps made of it.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "palpate/contact/lump_force.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/tissue/layered_table.h"
#include "palpate/tissue/press_field.h"

namespace palpate::test {

/// Skin, fat and muscle of a back.
inline tissue::LayerStack backStack() {
  return {.layers = {{"skin", 2.0, 150.0}, {"fat", 8.0, 10.0}, {"muscle", 30.0, 27.0}}, .poisson = 0.48};
}

inline tissue::PressField inventedField(const tissue::LayerStack& stack) {
  tissue::PressField field;
  for (int i = 0; i < 24; ++i) field.radii_mm.push_back(40.0 * i * i / (23.0 * 23.0));
  double top = 0.0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    for (int i = 0; i <= 6; ++i) {
      field.rows_mm.push_back(i == 6 ? top + stack.layers[layer].thickness_mm
                                     : top + stack.layers[layer].thickness_mm * i / 6.0);
      field.row_layers.push_back(static_cast<int>(layer));
    }
    top += stack.layers[layer].thickness_mm;
  }
  for (int i = 1; i <= 9; ++i) {
    field.depths_mm.push_back(i);
    field.patterns.push_back({2.1 * std::sqrt(1.0 * i), 0.02 * i});
  }
  for (const double z : field.rows_mm) {
    for (const double r : field.radii_mm) {
      for (const double d : field.depths_mm) {
        const double fading = std::exp(-r * r / (50.0 + z * z)) / ((1.0 + z / 8.0) * (1.0 + z / 8.0));
        const double density = 0.3 * (d / 8.0) * (d / 8.0) * fading;
        field.shear.push_back(static_cast<float>(std::pow(density, 0.25)));
        field.volume.push_back(static_cast<float>(std::pow(0.05 * density, 0.25)));
      }
    }
  }
  return field;
}

/// A table of those layers with that field, as the solver writes it; its skin and forces are invented too.
inline tissue::LayeredTable inventedTable() {
  tissue::LayeredTable table;
  table.stack = backStack();
  table.field = inventedField(table.stack);
  table.radii_mm = {0.0, 5.0, 40.0};
  table.shapes = {{2.0, 1.99, 0.31, 3.0, {1.0, 0.4, 0.3}, {0.0, -0.05, 0.01}},
                  {10.0, 9.97, 4.16, 7.5, {1.0, 0.9, 0.0}, {0.0, 0.1, -0.02}}};
  table.drag = tissue::DragShape{};
  return table;
}

/// The energy of a lump in the back's layers.
inline tissue::LumpEnergy inventedEnergy(const tissue::LumpShape& shape) {
  static const tissue::LayerStack stack = backStack();
  static const tissue::PressField field = inventedField(stack);
  const std::vector<tissue::WeightedField> fields = {{&stack, &field, 1.0}};
  return {shape, stack, fields};
}

/// A lump of 10 mm, its top 5 mm under the skin at `foot`.
inline contact::Lump inventedLump(const Vec3& foot, const Vec3& axis = Vec3::UnitZ()) {
  const tissue::LumpShape shape{.half_axes_mm = {5.0, 5.0, 5.0}, .depth_mm = 5.0, .stiffness_ratio = 10.0};
  contact::Lump lump{.foot = foot, .axis = axis, .energy = inventedEnergy(shape), .shape = shape, .skin_mm = 2.0};
  contact::setPlane(lump);
  return lump;
}

inline contact::PressureGround inventedGround() {
  static const tissue::LayerStack stack = backStack();
  static const tissue::PressField field = inventedField(stack);
  const std::vector<tissue::WeightedField> fields = {{&stack, &field, 1.0}};
  return contact::PressureGround({{.thickness_mm = 40.0, .form = tissue::PressureForm(fields)}});
}

}  // namespace palpate::test
