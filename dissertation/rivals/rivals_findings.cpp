// Errors, times and memory of each method at the common size, put into words.
#include "dissertation/rivals/rivals_measurement.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::study {

Extent errorsOf(const RivalsMeasurement& found, Rival rival) {
  Extent errors;
  forEachCommon(found, rival, [&](const RivalRow& row) { errors.add(row.error); });
  return errors;
}

double meanErrorOf(const RivalsMeasurement& found, Rival rival) {
  double sum = 0.0;
  int count = 0;
  forEachCommon(found, rival, [&](const RivalRow& row) {
    sum += row.error;
    ++count;
  });
  return sum / count;
}

double slowestUs(const RivalsMeasurement& found, Rival rival) {
  double most = 0.0;
  forEachCommon(found, rival, [&](const RivalRow& row) { most = std::max(most, row.press_us); });
  return most;
}

namespace {

constexpr double kPictureUs = 1e6 / 60.0;

std::string range(const Extent& extent) { return fmt::format("{} to {}", percent(extent.least), percent(extent.most)); }

Rival nearestOf(const RivalsMeasurement& found) {
  return *std::min_element(kRivals.begin(), kRivals.end(),
                           [&](Rival a, Rival b) { return meanErrorOf(found, a) < meanErrorOf(found, b); });
}

std::string accuracyFinding(const RivalsMeasurement& found) {
  std::string all;
  for (const Rival rival : kRivals) {
    if (rival == Rival::elements_answers) continue;
    all += fmt::format("{}{} {} (mean {})", all.empty() ? "" : ", ", nameOf(rival), range(errorsOf(found, rival)),
                       percent(meanErrorOf(found, rival)));
  }
  const Rival nearest = nearestOf(found);
  const bool elements = nearest == Rival::elements || nearest == Rival::elements_answers;
  return fmt::format(
      "How far the skin is off the truth within 40 mm of the ball, over three tissues and two depths: {}. Table 4.1 "
      "calls finite elements the most accurate; of linear ones with {} vertices in the skin that {}.",
      all, rowOf(found, Rival::fsmd, kFittedTissue, 10.0, found.plan.common_cells).vertices,
      elements ? "is true here" : fmt::format("is not true on the mean: {} is nearer", nameOf(nearest)));
}

std::string fittedFinding(const RivalsMeasurement& found) {
  Extent fitted;
  Extent others;
  forEachCommon(found, Rival::fsmd,
                [&](const RivalRow& row) { (row.truth.tissue == kFittedTissue ? fitted : others).add(row.error); });
  return fmt::format(
      "FSMD knows nothing of the layers: its default circle was fitted to \"{}\" (E21), where it is off by {}. On "
      "tissues that it was not fitted to it is off by {}, while springs and elements are told their layers. With the "
      "one measured ellipse of chapter 5 for press and drag it is off by {}.",
      kFittedTissue, range(fitted), range(others), range(errorsOf(found, Rival::fsmd_printed)));
}

std::string timeFinding(const RivalsMeasurement& found) {
  const double ours = slowestUs(found, Rival::fsmd);
  std::string all;
  for (const Rival rival : {Rival::free_form, Rival::mass_spring, Rival::elements, Rival::elements_answers}) {
    const double us = slowestUs(found, rival);
    all += fmt::format("{}{} {} ({} times as long, {} a picture at 60 Hz)", all.empty() ? "" : ", ", nameOf(rival),
                       readableTime(us), rounded(us / ours), us <= kPictureUs ? "within" : "longer than");
  }
  const RivalRow& elements = rowOf(found, Rival::elements, kFittedTissue, 10.0, found.plan.common_cells);
  return fmt::format(
      "A press takes FSMD {} at most, normals and the check against folds included; {}. Elements factorise their "
      "matrix for {} before the first press, and again whenever tissue is cut or its stiffness is edited.",
      readableTime(ours), all, readableTime(1e3 * elements.once_ms));
}

std::string keptFinding(const RivalsMeasurement& found) {
  const RivalRow& kept = rowOf(found, Rival::elements_answers, kFittedTissue, 10.0, found.plan.common_cells);
  const RivalRow& ours = rowOf(found, Rival::fsmd, kFittedTissue, 10.0, found.plan.common_cells);
  return fmt::format(
      "One that Table 4.1 does not have: elements whose answers are kept. A press is then a sum and takes {} "
      "times as long as FSMD's on \"{}\", for {} of answers that take {} to compute and grow with the square of the "
      "skin: {} vertices here, where FSMD needs {}.",
      rounded(kept.press_us / ours.press_us), kFittedTissue, readableBytes(kept.bytes),
      readableTime(1e3 * kept.once_ms), kept.vertices, readableBytes(ours.bytes));
}

std::string freeFormFinding(const RivalsMeasurement& found) {
  Extent best;
  Extent lattices;
  for (const LayeredPress& press : layeredPresses()) {
    const RivalRow* nearest = nullptr;
    for (const RivalRow& row : found.rows) {
      const bool counts = row.rival == Rival::free_form && row.cells == found.plan.common_cells &&
                          row.truth.tissue == press.tissue && row.truth.depth_mm == press.depth_mm;
      if (counts && (nearest == nullptr || row.error < nearest->error)) nearest = &row;
    }
    best.add(nearest->error);
    lattices.add(nearest->lattice_mm);
  }
  Extent all;
  for (const RivalRow& row : found.rows) {
    if (row.rival == Rival::free_form && row.cells == found.plan.common_cells) all.add(row.error);
  }
  return fmt::format(
      "Free form \"needs manipulation\": with the lattice that fits each press best ({:g} to {:g} mm) it is off by {}, "
      "with others of those tried by up to {}; a lattice of {:g} mm is what the other findings take. It is FSMD with a "
      "B-spline in place of "
      "the half Gaussian and a square in place of the ellipse.",
      lattices.least, lattices.most, range(best), percent(all.most), found.plan.lattice_mm);
}

std::string forceFinding(const RivalsMeasurement& found) {
  const auto shares = [&](Rival rival) {
    Extent share;
    forEachCommon(found, rival, [&](const RivalRow& row) { share.add(*row.force_n / row.truth.force_n); });
    return share;
  };
  return fmt::format(
      "Linear models also give a force, but not the tissue's: elements {} of the truth, springs {} (their Poisson "
      "ratio is 1/4). FSMD gives none; the finger's comes from its force law.",
      range(shares(Rival::elements)), range(shares(Rival::mass_spring)));
}

std::string leftOutFinding() {
  return "Not measured: shape interpolation needs the deformed shapes of every place and depth as input, which is the "
         "truth itself; skeleton driven deformation has no external force.";
}

}  // namespace

std::vector<std::string> rivalFindings(const RivalsMeasurement& found) {
  return {accuracyFinding(found), fittedFinding(found), timeFinding(found), keptFinding(found),
          freeFormFinding(found), forceFinding(found),  leftOutFinding()};
}

}  // namespace palpate::study
