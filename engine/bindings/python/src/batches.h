// What batches of fingers and of tools have in common: the worlds that they are shared among, and masks over them.
#pragma once

#include <cstddef>
#include <vector>

#include "world_handle.h"

namespace palpate::python {

struct MaybeMaskName {
  static constexpr auto name = py::detail::const_name("Optional[numpy.typing.ArrayLike]");
};
using MaybeMask = Named<MaybeMaskName>;
using MaybeNumbers = Named<MaybeMaskName>;
struct WorldsName {
  static constexpr auto name = py::detail::const_name("Union[palpate._core.World, Sequence[palpate._core.World]]");
};
using Worlds = Named<WorldsName>;

struct TouchListName {
  static constexpr auto name = py::detail::const_name("list[palpate._core.Touch]");
};
using TouchList = Named<TouchListName>;

/// One world, or several. Throws TypeError, ValueError for none.
std::vector<WorldPointer> worldsOf(const Worlds& given);

/// Which of a batch a call is about.
struct Masked {
  py::object kept;              ///< what owns the flags
  const bool* flags = nullptr;  ///< null: all
  bool has(std::size_t i) const { return flags == nullptr || flags[i]; }
};
/// A mask (size,) of bool; None: all. Throws ValueError.
Masked readMask(const py::object& mask, std::size_t size);
/// Also throws for a mask without `out`, which keeps the rows of the others.
Masked readMask(const py::object& mask, const py::object& out, std::size_t size);

/// The number of a world for each (size,), below `worlds`; empty for None. Throws ValueError.
std::vector<std::size_t> worldNumbers(const py::object& given, std::size_t size, std::size_t worlds);

/// Calls `change` with the numbers of those whose flag is set, with all for None.
template <class Change>
void forMasked(const py::object& mask, std::size_t size, const Change& change) {
  const Masked masked = readMask(mask, size);
  for (std::size_t i = 0; i < size; ++i) {
    if (masked.has(i)) change(i);
  }
}

/// What ends a batch, and how many it has. `many`: as its documentation calls them.
template <class Batch>
void bindClosing(py::class_<Batch>& batch, const char* many) {
  batch.def("close", &Batch::close, "Ends its threads. Later calls raise ValueError; closing again has no effect.");
  batch.def(
      "__enter__", [](const py::object& self) { return self; }, "Returns itself.");
  batch.def(
      "__exit__", [](Batch& self, const py::args&) { self.close(); }, "Calls close().");
  batch.def("__len__", &Batch::size, many);
}

}  // namespace palpate::python
