// Fits for Python: a force law from force by depth, a shape from pressed skin, and least squares within bounds for any
// function of a script. palpate.fit is made of these.
#include "bindings.h"

#include <fmt/format.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <map>

#include "arrays.h"
#include "interrupts.h"
#include "palpate/tissue/fitting/bounded_fit.h"
#include "palpate/tissue/fitting/force_fit.h"
#include "palpate/tissue/fitting/profile_fit.h"

namespace palpate::python {

namespace {

using tissue::FittedNumber;
using tissue::ForceFit;
using tissue::ProfileFit;

std::vector<double> column(const ArrayLike& given, const char* what) {
  const auto floats = asFloats(given, what);
  if (floats.ndim() != 1) throw py::value_error(fmt::format("{}: expected an array (N,)", what));
  for (py::ssize_t i = 0; i < floats.size(); ++i) {
    if (!std::isfinite(floats.at(i))) throw py::value_error(fmt::format("{}[{}] must be finite", what, i));
  }
  return {floats.data(), floats.data() + floats.size()};
}

void requireRows(std::size_t wanted, std::size_t given, const char* what) {
  if (wanted != given) throw py::value_error(fmt::format("{}: {} rows; expected {}", what, given, wanted));
}

using NumbersByName = std::map<std::string, FittedNumber>;

NumbersByName byName(const std::vector<FittedNumber>& numbers) {
  NumbersByName named;
  for (const FittedNumber& number : numbers) named.emplace(number.name, number);
  return named;
}

void bindNumber(py::module_& module) {
  py::class_<FittedNumber>(module, "FittedNumber", "A fitted number with its standard error. float() gives its value.")
      .def_property_readonly(
          "name", [](const FittedNumber& n) { return std::string(n.name); },
          "Its name; the key of a scene if there is one.")
      .def_readonly("value", &FittedNumber::value, "The value.")
      .def_readonly("standard_error", &FittedNumber::standard_error,
                    "Standard error; NaN for too few rows; 0 at the end of its range, or if not fitted.")
      .def_readonly("at_end", &FittedNumber::at_end,
                    "Whether it is at the end of its range; the best value may be beyond.")
      .def(
          "__float__", [](const FittedNumber& n) { return n.value; }, "The value.")
      .def("__repr__", [](const FittedNumber& n) {
        return fmt::format("FittedNumber({}={:.6g} +- {:.2g})", n.name, n.value, n.standard_error);
      });
}

// --- force ----------------------------------------------------------------------------------------------------------

FloatArray evaluateForces(const ForceFit& fit, const ArrayLike& depth_mm) {
  const auto depths = asFloats(depth_mm, "depth_mm");
  py::array_t<double> forces(std::vector<py::ssize_t>(depths.shape(), depths.shape() + depths.ndim()));
  for (py::ssize_t i = 0; i < depths.size(); ++i) {
    forces.mutable_data()[i] = tissue::forceOf(fit, depths.data()[i]);
  }
  return FloatArray(forces);
}

void bindForceFit(py::module_& module) {
  py::class_<ForceFit>(module, "ForceFit", "A force law fitted to measured forces: F = k h(depth), h(8 mm) = 8 mm.")
      .def_property_readonly(
          "form", [](const ForceFit& f) { return std::string(nameOf(f.form)); },
          "\"linear\", \"power\", \"stiffening\", \"cubic\" or \"measured\".")
      .def_readonly("secant", &ForceFit::secant, "k, N/mm: the value of a stiffness map.")
      .def_property_readonly(
          "numbers", [](const ForceFit& f) { return byName(f.numbers); },
          "Parameters of the form by name: exponent, stiffening_ratio ...")
      .def_readonly("offset", &ForceFit::offset, "Depth at which the skin is met, mm below the table's 0.")
      .def_readonly("law", &ForceFit::law, "The Law with these parameters; a table if the engine has no such form.")
      .def_readonly("rms", &ForceFit::rms, "RMS of (fit - F) / max(F, 0.3 F_max), a fraction.")
      .def_readonly("unseen_rms", &ForceFit::unseen_rms, "RMS for rows left out of the fit, a fifth at a time.")
      .def_readonly("rows", &ForceFit::rows, "Number of fitted rows.")
      .def_readonly("deepest_mm", &ForceFit::deepest_mm,
                    "Largest fitted depth from the contact, mm; beyond it the law is an extrapolation.")
      .def("force", evaluateForces, py::arg("depth_mm"), "Force, N, at depths of the curve; an array of their shape.")
      .def("__repr__", [](const ForceFit& f) {
        return fmt::format("ForceFit({}, {:.4g} N/mm, unseen {:.1f} %)", nameOf(f.form), f.secant.value,
                           100.0 * f.unseen_rms);
      });
}

std::vector<ForceFit> fitForces(const ArrayLike& depth_mm, const ArrayLike& force_n, bool free_offset,
                                double most_offset_mm) {
  const tissue::ForceCurve curve{"curve", column(depth_mm, "depth_mm"), column(force_n, "force_n")};
  requireRows(curve.depth_mm.size(), curve.force_n.size(), "force_n");
  return unlocked([&](Interrupts&) { return tissue::fitForces(curve, {free_offset, most_offset_mm}); });
}

ForceFit fitShared(const std::vector<std::pair<ArrayLike, ArrayLike>>& curves, const std::string& form,
                   bool free_offset) {
  std::vector<tissue::ForceCurve> all;
  for (const auto& [depth_mm, force_n] : curves) {
    all.push_back({fmt::format("curve {}", all.size()), column(depth_mm, "depth_mm"), column(force_n, "force_n")});
    requireRows(all.back().depth_mm.size(), all.back().force_n.size(), "force_n");
  }
  if (all.empty()) throw py::value_error("curves: at least one is required");
  for (const tissue::ForceForm one : tissue::kForceForms) {
    if (nameOf(one) != form) continue;
    return unlocked([&](Interrupts&) { return tissue::fitSharedForce(all, one, {.free_offset = free_offset}); });
  }
  throw py::value_error("form: must be linear, power, stiffening, cubic or measured, not " + form);
}

// --- shape ----------------------------------------------------------------------------------------------------------

FloatArray evaluateShares(const ProfileFit& fit, const ArrayLike& r_mm, double (*share)(const ProfileFit&, double)) {
  const auto radii = asFloats(r_mm, "r_mm");
  py::array_t<double> shares(std::vector<py::ssize_t>(radii.shape(), radii.shape() + radii.ndim()));
  for (py::ssize_t i = 0; i < radii.size(); ++i) shares.mutable_data()[i] = share(fit, radii.data()[i]);
  return FloatArray(shares);
}

void bindProfileFit(py::module_& module) {
  py::class_<ProfileFit>(module, "ProfileFit", "Fitted shape of pressed skin: it moves down by surface_mm * down(r).")
      .def_property_readonly(
          "form", [](const ProfileFit& f) { return std::string(nameOf(f.form)); },
          "\"half_gaussian\", \"power_tail\", \"two_gaussians\" or \"measured\".")
      .def_readonly("depth_mm", &ProfileFit::depth_mm, "Depth of the indenter, mm.")
      .def_readonly("surface_mm", &ProfileFit::surface_mm, "u0: depth of the skin on the axis, mm.")
      .def_property_readonly(
          "numbers", [](const ProfileFit& f) { return byName(f.numbers); },
          "Parameters of the form by name: radius_mm, exponent ...")
      .def_readonly("rms", &ProfileFit::rms, "RMS of the downward motion, as a fraction of surface_mm, within 40 mm.")
      .def_readonly("unseen_rms", &ProfileFit::unseen_rms, "RMS for places left out of the fit.")
      .def(
          "down", [](const ProfileFit& f, const ArrayLike& r_mm) { return evaluateShares(f, r_mm, tissue::downShare); },
          py::arg("r_mm"),
          "Downward motion as a fraction of surface_mm, at distances from the axis at rest, mm; an array of their "
          "shape.")
      .def(
          "outward",
          [](const ProfileFit& f, const ArrayLike& r_mm) { return evaluateShares(f, r_mm, tissue::outwardShare); },
          py::arg("r_mm"), "Motion away from the axis as a fraction of surface_mm; 0 if not measured.")
      .def("__repr__", [](const ProfileFit& f) {
        return fmt::format("ProfileFit({}, {:.3g} mm deep, unseen {:.2f} %)", nameOf(f.form), f.depth_mm,
                           100.0 * f.unseen_rms);
      });
}

std::vector<ProfileFit> fitProfiles(double depth_mm, const ArrayLike& r_mm, const ArrayLike& down_mm,
                                    const std::optional<ArrayLike>& outward_mm) {
  tissue::SkinProfile profile{depth_mm, column(r_mm, "r_mm"), column(down_mm, "down_mm"), {}};
  requireRows(profile.radius_mm.size(), profile.down_mm.size(), "down_mm");
  if (outward_mm) {
    profile.outward_mm = column(*outward_mm, "outward_mm");
    requireRows(profile.radius_mm.size(), profile.outward_mm.size(), "outward_mm");
  }
  return unlocked([&](Interrupts& interrupts) {
    std::vector<ProfileFit> fits;
    for (const tissue::ProfileForm form : tissue::kProfileForms) {
      interrupts.check();
      fits.push_back(tissue::fitProfile(profile, form));
    }
    return fits;
  });
}

// --- any least squares ----------------------------------------------------------------------------------------------

Eigen::VectorXd toEigen(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

FloatArray toFloatArray(const Eigen::VectorXd& values) {
  return FloatArray(py::array_t<double>(values.size(), values.data()));
}

/// Numbers, standard errors, sum of squares, which are at a bound.
using Solved = std::tuple<FloatArray, FloatArray, double, std::vector<bool>>;

Solved leastSquares(const py::function& residuals, const ArrayLike& start, const ArrayLike& low,
                    const ArrayLike& high) {
  const Eigen::VectorXd begin = toEigen(column(start, "start"));
  const std::vector<double> lows = column(low, "low");
  const std::vector<double> highs = column(high, "high");
  requireRows(static_cast<std::size_t>(begin.size()), lows.size(), "low");
  requireRows(lows.size(), highs.size(), "high");
  std::vector<tissue::Bounds> bounds;
  for (std::size_t i = 0; i < lows.size(); ++i) {
    const double at = begin[static_cast<Eigen::Index>(i)];
    if (!(lows[i] < highs[i]) || at < lows[i] || at > highs[i]) {
      throw py::value_error(fmt::format("start[{}] = {:g} is out of range: {:g} to {:g}", i, at, lows[i], highs[i]));
    }
    bounds.push_back({lows[i], highs[i]});
  }
  Eigen::Index rows = -1;
  const auto missed = [&](const Eigen::VectorXd& numbers) {
    const py::object answer = residuals(toFloatArray(numbers));
    const Eigen::VectorXd rest = toEigen(column(py::reinterpret_borrow<ArrayLike>(answer), "residuals"));
    if (rows >= 0 && rest.size() != rows) throw py::value_error("residuals: their number must not change");
    rows = rest.size();
    return rest;
  };
  const tissue::BoundedFit fit = tissue::fitWithin(missed, {begin}, bounds);
  return {toFloatArray(fit.numbers), toFloatArray(tissue::standardErrors(fit)), fit.squares, fit.at_bound};
}

}  // namespace

void bindFits(py::module_& module) {
  bindNumber(module);
  bindForceFit(module);
  bindProfileFit(module);
  module.def("fit_forces", fitForces, py::arg("depth_mm"), py::arg("force_n"), py::kw_only(),
             py::arg("free_offset") = false, py::arg("most_offset_mm") = 0.6,
             "All forms fitted to one curve: arrays (N,) in mm and N, at least four depths below the skin.\n"
             "free_offset: look for the contact between 0 and most_offset_mm. Raises ValueError, Error.");
  module.def(
      "best_force_fit",
      [](const std::vector<ForceFit>& fits) {
        if (fits.empty()) throw py::value_error("fits: at least one is required");
        return tissue::bestOf(fits);
      },
      py::arg("fits"), "The form that predicts unseen rows best; the simplest of those nearly as good.");
  module.def("fit_shared_force", fitShared, py::arg("curves"), py::arg("form"), py::kw_only(),
             py::arg("free_offset") = false,
             "One shape for several places, each with its own stiffness: pairs (depth_mm, force_n).\nRaises "
             "ValueError, Error.");
  module.def("fit_profiles", fitProfiles, py::arg("depth_mm"), py::arg("r_mm"), py::arg("down_mm"),
             py::arg("outward_mm") = py::none(),
             "All forms of pressed skin fitted to places (N,) under one depth of the indenter; at least six radii.\n"
             "Raises ValueError, Error.");
  module.def("least_squares", leastSquares, py::arg("residuals"), py::arg("start"), py::arg("low"), py::arg("high"),
             "Levenberg-Marquardt within bounds: residuals(numbers (K,)) -> (N,). Gives the numbers (K,), their\n"
             "standard errors (K,), the sum of squares and which are at a bound. What residuals raises goes through.");
}

}  // namespace palpate::python
