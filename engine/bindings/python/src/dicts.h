// Types that signatures name: facts by name, arrays by column, pictures.
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
struct PixelsName {
  static constexpr auto name = py::detail::const_name("numpy.typing.NDArray[numpy.uint8]");
};
struct PictureName {
  static constexpr auto name =
      py::detail::const_name("Union[str, os.PathLike[str], numpy.typing.NDArray[numpy.uint8]]");
};
struct MaybePictureName {
  static constexpr auto name =
      py::detail::const_name("Optional[Union[str, os.PathLike[str], numpy.typing.NDArray[numpy.uint8]]]");
};

/// Facts by name.
using Facts = Named<FactsName, py::dict>;
using FactsList = Named<FactsListName, py::list>;
/// Arrays by column.
using Arrays = Named<ArraysName, py::dict>;
/// (H, W, 3) of uint8.
using PixelArray = Named<PixelsName>;
/// A picture's file or its pixels.
using PictureLike = Named<PictureName>;
using MaybePicture = Named<MaybePictureName>;

}  // namespace palpate::python
