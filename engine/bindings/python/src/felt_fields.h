// Outputs of many ticks as arrays: the requested fields of force, depth, proxy ...
//
//   names or arrays of the caller ─ FeltArrays ─► rows ─ write (no lock, no Python) ─► arrays ─► dict
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "palpate/contact/finger_state.h"
#include "palpate/scene/world.h"

namespace palpate::python {

/// Destinations of tick `row`'s numbers; null for unwanted ones. Plain pointers: written by any thread, each its own
/// rows.
struct FeltRows {
  double* force = nullptr;
  double* depth = nullptr;
  double* proxy = nullptr;
  double* anchor = nullptr;
  double* normal = nullptr;
  std::int32_t* triangle = nullptr;
  std::uint8_t* state = nullptr;
  std::uint32_t* status = nullptr;
  double* tip = nullptr;
  double* hold = nullptr;
  double* tissue = nullptr;
  double* rest = nullptr;
  std::int32_t* anchor_triangle = nullptr;
  double* radius = nullptr;
  double* lump_force = nullptr;
  double* lump_share = nullptr;
  std::int32_t* lump = nullptr;
  double* lump_moved = nullptr;

  void write(std::size_t row, const contact::FingerOutput& felt) const noexcept {
    if (force != nullptr) write3(force, row, felt.force);
    if (depth != nullptr) depth[row] = felt.depth_mm;
    if (proxy != nullptr) write3(proxy, row, felt.proxy);
    if (anchor != nullptr) write3(anchor, row, felt.anchor);
    if (normal != nullptr) write3(normal, row, felt.normal);
    if (triangle != nullptr) triangle[row] = static_cast<std::int32_t>(felt.triangle);
    if (state != nullptr) state[row] = static_cast<std::uint8_t>(felt.touch);
    if (status != nullptr) status[row] = felt.status;
    if (tip != nullptr) write3(tip, row, felt.tip);
    if (hold != nullptr) write3(hold, row, felt.hold);
    if (tissue != nullptr) tissue[row] = felt.tissue_mm;
    if (rest != nullptr) rest[row] = felt.rest_mm;
    if (anchor_triangle != nullptr) anchor_triangle[row] = static_cast<std::int32_t>(felt.anchor_triangle);
    if (radius != nullptr) radius[row] = felt.finger_mm;
    if (lump_force != nullptr) write3(lump_force, row, felt.lump_force);
    if (lump_share != nullptr) lump_share[row] = felt.lump_share;
    if (lump != nullptr) lump[row] = static_cast<std::int32_t>(felt.lump);
    if (lump_moved != nullptr) {
      for (int axis = 0; axis < 2; ++axis)
        lump_moved[2 * row + static_cast<std::size_t>(axis)] = felt.lump_moved_mm[axis];
    }
  }

 private:
  static void write3(double* to, std::size_t row, const Vec3& value) noexcept {
    for (int axis = 0; axis < 3; ++axis) to[3 * row + static_cast<std::size_t>(axis)] = value[axis];
  }
};

/// A fresh array for None, or the caller's, which is written and never converted: results in a copy would be lost.
/// Throws ValueError naming it.
template <class Number>
py::array_t<Number> wholeArray(const py::object& given, const std::string& name,
                               const std::vector<py::ssize_t>& shape) {
  if (given.is_none()) return py::array_t<Number>(shape);
  const bool is_array = py::isinstance<py::array_t<Number, py::array::c_style>>(given);
  const auto array = is_array ? py::reinterpret_borrow<py::array_t<Number>>(given) : py::array_t<Number>();
  const bool fits = is_array && array.writeable() && static_cast<std::size_t>(array.ndim()) == shape.size() &&
                    std::equal(shape.begin(), shape.end(), array.shape());
  if (fits) return array;
  std::string wanted;
  for (const py::ssize_t length : shape) wanted += fmt::format("{}{}", wanted.empty() ? "" : ", ", length);
  throw py::value_error(fmt::format("out: '{}' must be a writable array in C order, {} of shape ({}{})", name,
                                    py::str(py::dtype::of<Number>()).cast<std::string>(), wanted,
                                    shape.size() == 1 ? "," : ""));
}

/// The arrays of one call.
class FeltArrays {
 public:
  /// `leading` is the shape before the axis of a vector: (fingers, ticks) or (fingers). `fields`: a sequence of names,
  /// or None for the first ones of docs/reference/python.md, and in a `world` with lumps or pads also those of a
  /// pressure pattern. `out`: None for fresh arrays, or a dict of C-ordered writable arrays of the right shape and
  /// kind, which are written and returned; it chooses the fields where `fields` does not. Throws ValueError, TypeError
  /// or KeyError naming the field.
  FeltArrays(const scene::World& world, std::vector<py::ssize_t> leading, const py::object& fields,
             const py::object& out);

  const FeltRows& rows() const { return rows_; }
  py::dict dict() const { return dict_; }

 private:
  void add(const std::string& name, const py::object& given, const std::vector<py::ssize_t>& leading);

  FeltRows rows_;
  py::dict dict_;
};

}  // namespace palpate::python
