// Between numpy and the engine: arrays by name for signatures, views that keep their owner, points that a caller gives
// as an array, a list, a tuple or a name.
//
// Nothing here touches numpy before the first array: `import palpate` is cheap because of it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::python {

namespace py = pybind11;

/// Whatever numpy.asarray takes. A type of its own so that signatures say so.
class ArrayLike : public py::object {
 public:
  ArrayLike() = default;
  ArrayLike(py::handle given, borrowed_t) : py::object(given, borrowed_t{}) {}
  ArrayLike(py::handle given, stolen_t) : py::object(given, stolen_t{}) {}
  static bool check_(py::handle given) { return given.ptr() != nullptr; }
};
/// What a call answers: an array of one kind. Made of a py::array that is so.
template <class Number>
class ArrayOf : public py::array {
 public:
  ArrayOf(py::array given) : py::array(std::move(given)) {}  // NOLINT(google-explicit-constructor): it is one
};
using FloatArray = ArrayOf<double>;
using Float32Array = ArrayOf<float>;
using Int32Array = ArrayOf<std::int32_t>;
/// A place: words ("T6 right 30 mm") or three numbers, mm.
class PlaceLike : public py::object {
 public:
  PlaceLike() = default;
  PlaceLike(py::handle given, borrowed_t) : py::object(given, borrowed_t{}) {}
  PlaceLike(py::handle given, stolen_t) : py::object(given, stolen_t{}) {}
  static bool check_(py::handle given) { return given.ptr() != nullptr; }
};

/// A read-only array over memory of `owner`, which lives as long as the array, its slices and views. Strides in bytes;
/// none: C order.
template <class Number>
py::array viewOf(const Number* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                 py::handle owner) {
  py::array array(py::dtype::of<Number>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
template <class Number>
py::array viewOf(const Number* data, std::vector<py::ssize_t> shape, py::handle owner) {
  return viewOf(data, std::move(shape), {}, owner);
}
/// (V, 3).
inline py::array viewOf(std::span<const Vec3> points, py::handle owner) {
  return viewOf(points.empty() ? nullptr : points.front().data(), {static_cast<py::ssize_t>(points.size()), 3}, owner);
}
/// (N,) of indices as int32, so that differences of them are no surprises; kNoIndex is -1.
inline py::array viewOf(std::span<const Index> indices, py::handle owner) {
  return viewOf(reinterpret_cast<const std::int32_t*>(indices.data()), {static_cast<py::ssize_t>(indices.size())},
                owner);
}

/// A fresh array (3,).
FloatArray toArray(const Vec3& point);

/// What is given as an array of float64 in C order, (..., `last`) where that is not 0; converted once, by numpy, when
/// it is anything else. Throws TypeError for what is no number (`what` names it), ValueError for another shape.
py::array_t<double, py::array::c_style> floatsOf(py::handle given, const char* what, py::ssize_t last = 0);

/// Three numbers, given as array, list or tuple. Throws TypeError or ValueError naming `what`.
Vec3 pointOf(py::handle given, const char* what);

}  // namespace palpate::python

namespace pybind11::detail {

template <>
struct handle_type_name<palpate::python::ArrayLike> {
  static constexpr auto name = const_name("numpy.typing.ArrayLike");
};
template <>
struct handle_type_name<palpate::python::PlaceLike> {
  static constexpr auto name = const_name("Union[str, numpy.typing.ArrayLike]");
};
template <class Number>
struct handle_type_name<palpate::python::ArrayOf<Number>> {
  static constexpr auto name =
      const_name("numpy.typing.NDArray[") + npy_format_descriptor<Number>::name + const_name("]");
};

}  // namespace pybind11::detail
