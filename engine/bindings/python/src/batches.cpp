#include "batches.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>

namespace palpate::python {

std::vector<WorldPointer> worldsOf(const Worlds& given) {
  if (py::isinstance<WorldHandle>(given)) return {given.cast<WorldPointer>()};
  if (!py::isinstance<py::sequence>(given)) throw py::type_error("world: expected a World or a sequence of them");
  std::vector<WorldPointer> worlds;
  for (const py::handle one : given) {
    if (!py::isinstance<WorldHandle>(one)) throw py::type_error("world: expected a World or a sequence of them");
    worlds.push_back(one.cast<WorldPointer>());
  }
  if (worlds.empty()) throw py::value_error("world: at least one is required");
  return worlds;
}

Masked readMask(const py::object& mask, std::size_t size) {
  if (mask.is_none()) return {};
  const auto flags = py::array::ensure(mask, py::array::c_style);
  if (flags && flags.dtype().kind() == 'b' && flags.ndim() == 1 && static_cast<std::size_t>(flags.size()) == size) {
    return {flags, static_cast<const bool*>(flags.data())};
  }
  PyErr_Clear();
  throw py::value_error(fmt::format("mask: must be ({},) of bool", size));
}

Masked readMask(const py::object& mask, const py::object& out, std::size_t size) {
  if (!mask.is_none() && out.is_none()) throw py::value_error("mask: needs out, which keeps the rows of the others");
  return readMask(mask, size);
}

std::vector<std::size_t> worldNumbers(const py::object& given, std::size_t size, std::size_t worlds) {
  if (given.is_none()) return {};
  const auto numbers = py::array::ensure(given);
  if (!numbers || (numbers.dtype().kind() != 'i' && numbers.dtype().kind() != 'u') || numbers.ndim() != 1 ||
      static_cast<std::size_t>(numbers.size()) != size) {
    PyErr_Clear();
    throw py::value_error(fmt::format("worlds: must be ({},) of whole numbers", size));
  }
  const auto whole = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(numbers);
  for (const std::int64_t number : std::span(whole.data(), size)) {
    if (number >= 0 && static_cast<std::size_t>(number) < worlds) continue;
    throw py::value_error(fmt::format("worlds: {} is out of range: 0 to {}", number, worlds - 1));
  }
  return {whole.data(), whole.data() + size};
}

}  // namespace palpate::python
