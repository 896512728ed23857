// Between numpy and the engine: arrays by name for signatures, views that keep their owner, points from the caller as
// an array, a list, a tuple or a name.
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

/// An object that signatures call by Tag::name, which is what a type checker reads.
template <class Tag, class Base = py::object>
class Named : public Base {
 public:
  Named() = default;
  Named(Base given) : Base(std::move(given)) {}  // NOLINT(google-explicit-constructor): it is one
  Named(py::handle given, py::object::stolen_t) : Base(py::reinterpret_steal<Base>(given)) {}
  Named(py::handle given, py::object::borrowed_t) : Base(py::reinterpret_borrow<Base>(given)) {}
  static bool check_(py::handle given) { return given.ptr() != nullptr; }
};

struct ArrayLikeName {
  static constexpr auto name = py::detail::const_name("numpy.typing.ArrayLike");
};
struct PlaceLikeName {
  static constexpr auto name = py::detail::const_name("Union[str, numpy.typing.ArrayLike]");
};
struct FeltArraysName {
  static constexpr auto name = py::detail::const_name("dict[str, numpy.typing.NDArray[Any]]");
};
struct MaybeOutName {
  static constexpr auto name = py::detail::const_name("Optional[dict[str, numpy.typing.NDArray[Any]]]");
};
struct MaybeFieldsName {
  static constexpr auto name = py::detail::const_name("Optional[Sequence[str]]");
};
template <class Number>
struct ArrayName {
  static constexpr auto name = py::detail::const_name("numpy.typing.NDArray[") +
                               py::detail::npy_format_descriptor<Number>::name + py::detail::const_name("]");
};

struct FloatingArrayName {
  static constexpr auto name = py::detail::const_name("numpy.typing.NDArray[Any]");
};

/// Anything that numpy.asarray accepts.
using ArrayLike = Named<ArrayLikeName>;
/// A place: a name ("T6 right 30 mm") or three numbers, mm.
using PlaceLike = Named<PlaceLikeName>;
using MaybeOut = Named<MaybeOutName>;
using MaybeFields = Named<MaybeFieldsName>;
using FeltDict = Named<FeltArraysName>;
using FloatArray = Named<ArrayName<double>>;
using Float32Array = Named<ArrayName<float>>;
/// Single or double precision.
using FloatingArray = Named<FloatingArrayName>;
using Int32Array = Named<ArrayName<std::int32_t>>;
using IndexArray = Named<ArrayName<std::int64_t>>;

/// A read-only array over memory of `owner`, which lives as long as the array, its slices and views. Strides in bytes;
/// none: C order.
template <class Number>
py::array arrayView(const Number* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                 py::handle owner) {
  py::array array(py::dtype::of<Number>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
template <class Number>
py::array arrayView(const Number* data, std::vector<py::ssize_t> shape, py::handle owner) {
  return arrayView(data, std::move(shape), {}, owner);
}
/// (V, 3).
inline py::array arrayView(std::span<const Vec3> points, py::handle owner) {
  return arrayView(points.empty() ? nullptr : points.front().data(), {static_cast<py::ssize_t>(points.size()), 3}, owner);
}
/// (N,) of indices as int32, so that differences behave; kNoIndex is -1.
inline py::array arrayView(std::span<const Index> indices, py::handle owner) {
  return arrayView(reinterpret_cast<const std::int32_t*>(indices.data()), {static_cast<py::ssize_t>(indices.size())},
                owner);
}

/// A fresh array (3,).
FloatArray toArray(const Vec3& point);

/// Converts to an array of float64 in C order, (..., `last`) where that is not 0; converted once, by numpy, when it is
/// anything else. Throws TypeError for anything but numbers (`what` names it), ValueError for another shape.
py::array_t<double, py::array::c_style> asFloats(py::handle given, const char* what, py::ssize_t last = 0);

/// Three numbers, as array, list or tuple. Throws TypeError or ValueError naming `what`.
Vec3 asPoint(py::handle given, const char* what);

}  // namespace palpate::python

namespace pybind11::detail {

template <class Tag, class Base>
struct handle_type_name<palpate::python::Named<Tag, Base>> {
  static constexpr auto name = Tag::name;
};

}  // namespace pybind11::detail
