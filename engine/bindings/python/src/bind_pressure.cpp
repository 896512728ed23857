// World.pressure: patterns of pressure under fingertips, of what they felt.
//
//   dict of arrays (rollout, Fingers.step), Touch, several ─► FingerOutput, tick by tick ─► FeltPressure ─► (..., n, n)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings.h"
#include "interrupts.h"
#include "palpate/engine/felt_pressure.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

struct FeltLikeName {
  static constexpr auto name = py::detail::const_name(
      "Union[dict[str, numpy.typing.NDArray[Any]], palpate._core.Touch, Sequence[palpate._core.Touch]]");
};
using FeltLike = Named<FeltLikeName>;
struct MaybeTicksName {
  static constexpr auto name = py::detail::const_name("Optional[numpy.typing.ArrayLike]");
};
using MaybeTicks = Named<MaybeTicksName>;
using FeltColumn = py::array_t<double, py::array::c_style>;

/// Patterns between two looks at the clock: 0.1 ms.
constexpr std::size_t kBetweenLooks = 64;

/// Finger outputs, row by row, and the shape before the axes of a pattern.
struct FeltTable {
  std::vector<contact::FingerOutput> rows = {};
  std::vector<py::ssize_t> leading = {};
};

/// One array of a dict, of the leading shape and, unless 1, an axis of `axes` more.
FeltColumn readFeltColumn(const py::dict& felt, const char* name, py::ssize_t axes,
                          const std::vector<py::ssize_t>& leading) {
  if (!felt.contains(name)) {
    throw py::value_error(
        fmt::format("felt: has no '{}'; ask for fields=(\"force\", \"depth\", \"normal\", \"state\", \"tip\", "
                    "\"tissue\", \"radius\", \"lump_force\", \"lump\", \"lump_moved\")",
                    name));
  }
  FeltColumn column = asFloats(felt[name], name, axes == 1 ? 0 : axes);
  std::vector<py::ssize_t> shape(column.shape(), column.shape() + column.ndim());
  if (axes != 1) shape.pop_back();
  if (shape != leading) throw py::value_error(fmt::format("felt: '{}' must have the shape of 'depth'", name));
  return column;
}

/// Accepts any whole number that a caller may have put into an array of doubles.
Index toLumpIndex(double number) {
  return number >= 0.0 && number < static_cast<double>(kNoIndex) ? static_cast<Index>(number) : kNoIndex;
}

Vec3 vectorAt(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

FeltTable readFeltTable(const py::dict& felt, bool lumps) {
  FeltTable table;
  if (!felt.contains("depth")) throw py::value_error("felt: expected a dict of arrays as returned by World.rollout");
  const FeltColumn depth = asFloats(felt["depth"], "depth");
  table.leading.assign(depth.shape(), depth.shape() + depth.ndim());
  const auto column = [&](const char* name, py::ssize_t axes) {
    return readFeltColumn(felt, name, axes, table.leading);
  };
  const FeltColumn force = column("force", 3), normal = column("normal", 3), state = column("state", 1),
                   tissue = column("tissue", 1), radius = column("radius", 1);
  table.rows.resize(static_cast<std::size_t>(depth.size()));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    contact::FingerOutput& row = table.rows[i];
    row.depth_mm = depth.data()[i];
    row.force = vectorAt(force.data() + 3 * i);
    row.normal = vectorAt(normal.data() + 3 * i);
    row.touch = state.data()[i] == 0.0 ? contact::Touch::free : contact::Touch::stick;
    row.tissue_mm = tissue.data()[i];
    row.finger_mm = radius.data()[i];
  }
  if (!lumps) return table;
  const FeltColumn tip = column("tip", 3), lump_force = column("lump_force", 3), lump = column("lump", 1),
                   moved = column("lump_moved", 2);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    contact::FingerOutput& row = table.rows[i];
    row.tip = vectorAt(tip.data() + 3 * i);
    row.lump_force = vectorAt(lump_force.data() + 3 * i);
    row.lump = toLumpIndex(lump.data()[i]);
    row.lump_moved_mm = {moved.data()[2 * i], moved.data()[2 * i + 1]};
  }
  return table;
}

FeltTable readFeltTable(const FeltLike& felt, const scene::World& world) {
  if (py::isinstance<py::dict>(felt)) return readFeltTable(felt.cast<py::dict>(), world.surface.lumps != nullptr);
  FeltTable table{asTouches(felt), {}};
  if (!py::isinstance<contact::FingerOutput>(felt)) table.leading = {static_cast<py::ssize_t>(table.rows.size())};
  return table;
}

/// The tick of each row, where it counts.
std::vector<std::uint64_t> readFeltTicks(const MaybeTicks& given, const FeltTable& table, const scene::World& world) {
  std::vector<std::uint64_t> ticks(table.rows.size(), 0);
  if (!world.breath) return ticks;
  if (given.is_none()) {
    if (table.leading.size() < 2) throw py::value_error("tick: required, because this body breathes");
    const auto last = static_cast<std::size_t>(table.leading.back());
    for (std::size_t i = 0; i < ticks.size(); ++i) ticks[i] = i % last;
    return ticks;
  }
  const py::object to = py::module_::import("numpy").attr("broadcast_to")(given, py::cast(table.leading));
  const FeltColumn numbers = asFloats(to, "tick");
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (!(numbers.data()[i] >= 0.0 && numbers.data()[i] < 9e15)) throw py::value_error("tick: must be 0 or more");
    ticks[i] = static_cast<std::uint64_t>(numbers.data()[i]);
  }
  return ticks;
}

const engine::FeltPressure& pressureHeldBy(const WorldHandle& self) {
  if (!self.pressure) self.pressure = std::make_shared<const engine::FeltPressure>(self.world);
  return *self.pressure;
}

/// Numbers that are not finite have no pattern.
bool isFiniteTouch(const contact::FingerOutput& felt) {
  return felt.force.allFinite() && felt.normal.allFinite() && felt.tip.allFinite() && felt.lump_force.allFinite() &&
         felt.lump_moved_mm.allFinite() && std::isfinite(felt.depth_mm) && std::isfinite(felt.tissue_mm) &&
         std::isfinite(felt.finger_mm);
}

FloatArray pressure(const WorldHandle& self, const FeltLike& given, std::size_t n, double pad_mm, bool shear,
                    const MaybeTicks& given_ticks) {
  const contact::PressurePad pad{n, pad_mm};
  engine::checkPad(pad);
  const FeltTable table = readFeltTable(given, *self.world);
  const std::vector<std::uint64_t> ticks = readFeltTicks(given_ticks, table, *self.world);
  const engine::FeltPressure& made = pressureHeldBy(self);
  std::vector<py::ssize_t> shape = table.leading;
  shape.insert(shape.end(), {static_cast<py::ssize_t>(n), static_cast<py::ssize_t>(n)});
  if (shear) shape.push_back(3);
  py::array_t<double> result(shape);
  double* out = result.mutable_data();
  unlocked([&](Interrupts& interrupts) {
    std::vector<double> kpa(n * n);
    std::vector<Vec2> sideways(shear ? n * n : 0);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      if (i % kBetweenLooks == 0) interrupts.check();
      made.at(isFiniteTouch(table.rows[i]) ? table.rows[i] : contact::FingerOutput(), ticks[i], pad, kpa, sideways);
      for (std::size_t taxel = 0; taxel < kpa.size(); ++taxel) {
        *out++ = kpa[taxel];
        if (shear) out = std::copy_n(sideways[taxel].data(), 2, out);
      }
    }
    return 0;
  });
  return FloatArray(result);
}

}  // namespace

void bindPressure(py::module_& module) {
  auto world = py::reinterpret_borrow<py::class_<WorldHandle, WorldPointer>>(module.attr("World"));
  world.def(
      "pressure", &pressure,
      "Pressure on the fingertip, kPa, of what was felt in this world: n x n taxels of a square pad with sides of "
      "pad_mm, in the plane of the contact. The first row is nearest to the head, the first taxel of a row lowest "
      "along u = v x normal, with v towards the head.\n\n"
      "felt: what rollout or Fingers.step answered (F, T) or (F,), with all fields that a world with lumps or pads "
      "answers by itself; or a Touch, or several\n"
      "n: 2 to 16; pad_mm: 1 to 100\n"
      "shear: a last axis of three: pressure, and shear on the finger along u and along v, kPa\n"
      "tick: of a body that breathes, when it was felt; None counts the last axis of (F, T) from 0, as rollout does\n\n"
      "Gives (F, T, n, n), (F, n, n) or, of a Touch, (n, n): zeros where nothing is touched. The pressures add up to "
      "the normal force, and a point counts as a fingertip of 8 mm. The interpreter's lock is released, Ctrl-C "
      "interrupts. Raises palpate.Error where the tissue is not layered or the pad is out of range, ValueError for "
      "fields that are missing.",
      py::arg("felt"), py::arg("n") = 4, py::arg("pad_mm") = 16.0, py::arg("shear") = false, py::kw_only(),
      py::arg("tick") = py::none());
}

}  // namespace palpate::python
