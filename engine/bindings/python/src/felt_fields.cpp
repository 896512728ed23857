// A table of the fields, by name; an array of the caller is used directly or refused, never converted, because results
// in a copy would be lost.
#include "felt_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace palpate::python {

namespace {

using Place = std::variant<double * FeltRows::*, std::int32_t * FeltRows::*, std::uint8_t * FeltRows::*,
                           std::uint32_t * FeltRows::*>;

struct FieldForm {
  const char* name;
  py::ssize_t axes;  ///< 2, 3: a vector
  Place place;
};

/// The first kUsual are the default: 113 bytes a tick. With those of pressure 233.
constexpr std::size_t kUsual = 8;
constexpr std::size_t kWithPressure = 15;
const std::array kForms = {
    FieldForm{"force", 3, &FeltRows::force},
    FieldForm{"depth", 1, &FeltRows::depth},
    FieldForm{"proxy", 3, &FeltRows::proxy},
    FieldForm{"anchor", 3, &FeltRows::anchor},
    FieldForm{"normal", 3, &FeltRows::normal},
    FieldForm{"triangle", 1, &FeltRows::triangle},
    FieldForm{"state", 1, &FeltRows::state},
    FieldForm{"status", 1, &FeltRows::status},
    FieldForm{"tip", 3, &FeltRows::tip},
    FieldForm{"tissue", 1, &FeltRows::tissue},
    FieldForm{"radius", 1, &FeltRows::radius},
    FieldForm{"lump_force", 3, &FeltRows::lump_force},
    FieldForm{"lump_share", 1, &FeltRows::lump_share},
    FieldForm{"lump", 1, &FeltRows::lump},
    FieldForm{"lump_moved", 2, &FeltRows::lump_moved},
    FieldForm{"hold", 3, &FeltRows::hold},
    FieldForm{"rest", 1, &FeltRows::rest},
    FieldForm{"anchor_triangle", 1, &FeltRows::anchor_triangle},
};

const FieldForm& findFieldForm(const std::string& name) {
  const auto* found =
      std::find_if(kForms.begin(), kForms.end(), [&](const FieldForm& form) { return form.name == name; });
  if (found != kForms.end()) return *found;
  std::string known;
  for (const FieldForm& form : kForms) known += fmt::format("{}{}", known.empty() ? "" : ", ", form.name);
  throw py::value_error(fmt::format("fields: '{}' is unknown; expected any of {}", name, known));
}

/// The requested names; by default those of `out`, and the usual ones without that.
std::vector<std::string> requestedNames(const scene::World& world, const py::object& fields, const py::object& out) {
  std::vector<std::string> names;
  if (!fields.is_none()) {
    if (py::isinstance<py::str>(fields))
      throw py::type_error("fields: expected a sequence of names, e.g. (\"force\",)");
    for (const py::handle name : fields) {
      if (!py::isinstance<py::str>(name))
        throw py::type_error("fields: expected a sequence of names, e.g. (\"force\",)");
      names.push_back(name.cast<std::string>());
    }
  } else if (!out.is_none()) {
    for (const auto& [name, array] : out.cast<py::dict>()) names.push_back(py::str(name));
  } else {
    const std::size_t usual = world.surface.lumps || world.pressure ? kWithPressure : kUsual;
    for (std::size_t i = 0; i < usual; ++i) names.emplace_back(kForms[i].name);
  }
  return names;
}

}  // namespace

FeltArrays::FeltArrays(const scene::World& world, std::vector<py::ssize_t> leading, const py::object& fields,
                       const py::object& out) {
  if (!out.is_none() && !py::isinstance<py::dict>(out)) throw py::type_error("out: expected a dict of arrays");
  for (const std::string& name : requestedNames(world, fields, out)) {
    py::object given = py::none();
    if (!out.is_none()) {
      if (!out.contains(name)) throw py::value_error(fmt::format("out: array '{}' is missing", name));
      given = out[name.c_str()];
    }
    add(name, given, leading);
  }
  if (!out.is_none()) dict_ = out.cast<py::dict>();
}

void FeltArrays::add(const std::string& name, const py::object& given, const std::vector<py::ssize_t>& leading) {
  const FieldForm& form = findFieldForm(name);
  std::vector<py::ssize_t> shape = leading;
  if (form.axes != 1) shape.push_back(form.axes);
  std::visit(
      [&](auto place) {
        using Number = std::remove_pointer_t<std::remove_reference_t<decltype(rows_.*place)>>;
        py::array_t<Number> array = wholeArray<Number>(given, name, shape);
        rows_.*place = array.mutable_data();
        dict_[name.c_str()] = array;
      },
      form.place);
}

}  // namespace palpate::python
