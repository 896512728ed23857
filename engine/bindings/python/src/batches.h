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

/// A mask (size,) of bool in C order. Throws ValueError.
py::array flagsOf(const py::object& mask, std::size_t size);

/// The number of a world for each (size,), below `worlds`; empty for None. Throws ValueError.
std::vector<std::size_t> worldNumbers(const py::object& given, std::size_t size, std::size_t worlds);

/// Calls `change` with the numbers of those whose flag is set, with all for None.
template <class Change>
void forMasked(const py::object& mask, std::size_t size, const Change& change) {
  if (mask.is_none()) {
    for (std::size_t i = 0; i < size; ++i) change(i);
    return;
  }
  const py::array flags = flagsOf(mask, size);
  for (std::size_t i = 0; i < size; ++i) {
    if (static_cast<const bool*>(flags.data())[i]) change(i);
  }
}

}  // namespace palpate::python
