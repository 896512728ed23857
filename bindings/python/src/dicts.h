// Dicts and lists whose types signatures can say: facts by name, arrays by column.
#pragma once

#include "arrays.h"

namespace palpate::python {

struct FactsName {
  static constexpr auto name = py::detail::const_name("dict[str, Any]");
};
struct FactsListName {
  static constexpr auto name = py::detail::const_name("list[dict[str, Any]]");
};
struct ArraysName {
  static constexpr auto name = py::detail::const_name("dict[str, numpy.typing.NDArray[Any]]");
};

/// Facts by name.
using Facts = Named<FactsName, py::dict>;
using FactsList = Named<FactsListName, py::list>;
/// Arrays by column.
using Arrays = Named<ArraysName, py::dict>;

}  // namespace palpate::python
