// Fills in the sentences of rivals_findings.txt and the verdicts that the numbers decide.
#include "dissertation/rivals/rivals_findings.h"

#include <algorithm>

#include "dissertation_findings_texts.h"

namespace palpate::study {

Extent errorExtent(const RivalsMeasurement& found, Rival rival) {
  Extent errors;
  forEachCommon(found, rival, [&](const RivalRow& row) { errors.add(row.error); });
  return errors;
}

double meanError(const RivalsMeasurement& found, Rival rival) {
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

Rival nearestRival(const RivalsMeasurement& found) {
  return *std::min_element(kRivals.begin(), kRivals.end(),
                           [&](Rival a, Rival b) { return meanError(found, a) < meanError(found, b); });
}

const RivalRow& usualPress(const RivalsMeasurement& found, Rival rival) {
  return findRivalRow(found, rival, kFittedTissue, 10.0, found.plan.common_cells);
}

FindingValues accuracyOfRivals(const RivalsMeasurement& found) {
  FindingValues errors = FindingValues::array();
  for (const Rival rival : kRivals) {
    if (rival == Rival::elements_answers) continue;
    errors.push_back(
        {{"name", nameOf(rival)}, {"errors", errorExtent(found, rival)}, {"mean", meanError(found, rival)}});
  }
  const Rival nearest = nearestRival(found);
  return {{"errors", errors},
          {"vertices", usualPress(found, Rival::fsmd).vertices},
          {"elements", nearest == Rival::elements || nearest == Rival::elements_answers},
          {"nearest", nameOf(nearest)}};
}

FindingValues fittedTissue(const RivalsMeasurement& found) {
  Extent fitted;
  Extent others;
  forEachCommon(found, Rival::fsmd,
                [&](const RivalRow& row) { (row.truth.tissue == kFittedTissue ? fitted : others).add(row.error); });
  return {{"tissue", kFittedTissue},
          {"fitted", fitted},
          {"others", others},
          {"printed", errorExtent(found, Rival::fsmd_printed)}};
}

FindingValues timesOfPresses(const RivalsMeasurement& found) {
  const double ours = slowestUs(found, Rival::fsmd);
  FindingValues others = FindingValues::array();
  for (const Rival rival : {Rival::free_form, Rival::mass_spring, Rival::elements, Rival::elements_answers}) {
    const double us = slowestUs(found, rival);
    others.push_back(
        {{"name", nameOf(rival)}, {"time", readableTime(us)}, {"times", us / ours}, {"within", us <= kPictureUs}});
  }
  return {{"ours", readableTime(ours)},
          {"others", others},
          {"once", readableTime(1e3 * usualPress(found, Rival::elements).once_ms)}};
}

FindingValues keptAnswers(const RivalsMeasurement& found) {
  const RivalRow& kept = usualPress(found, Rival::elements_answers);
  const RivalRow& ours = usualPress(found, Rival::fsmd);
  return {{"times", kept.press_us / ours.press_us},
          {"tissue", kFittedTissue},
          {"bytes", readableBytes(kept.bytes)},
          {"once", readableTime(1e3 * kept.once_ms)},
          {"vertices", kept.vertices},
          {"our_bytes", readableBytes(ours.bytes)}};
}

FindingValues latticesOfFreeForm(const RivalsMeasurement& found) {
  Extent best;
  Extent lattices;
  double most = 0.0;
  for (const LayeredPress& press : layeredPresses()) {
    const RivalRow* nearest = nullptr;
    for (const RivalRow& row : found.rows) {
      const bool counts = row.rival == Rival::free_form && row.cells == found.plan.common_cells &&
                          row.truth.tissue == press.tissue && row.truth.depth_mm == press.depth_mm;
      if (!counts) continue;
      most = std::max(most, row.error);
      if (nearest == nullptr || row.error < nearest->error) nearest = &row;
    }
    best.add(nearest->error);
    lattices.add(nearest->lattice_mm);
  }
  return {{"lattices_mm", lattices}, {"best", best}, {"most", most}, {"lattice_mm", found.plan.lattice_mm}};
}

/// Over the truth's.
Extent forceRatioExtent(const RivalsMeasurement& found, Rival rival) {
  Extent shares;
  forEachCommon(found, rival, [&](const RivalRow& row) { shares.add(*row.force_n / row.truth.force_n); });
  return shares;
}

}  // namespace

std::vector<std::string> rivalFindings(const RivalsMeasurement& found) {
  return formatFindings(texts::rivals_findings, {{"accuracy", accuracyOfRivals(found)},
                                                 {"fitted", fittedTissue(found)},
                                                 {"time", timesOfPresses(found)},
                                                 {"kept", keptAnswers(found)},
                                                 {"free_form", latticesOfFreeForm(found)},
                                                 {"force",
                                                  {{"elements", forceRatioExtent(found, Rival::elements)},
                                                   {"springs", forceRatioExtent(found, Rival::mass_spring)}}}});
}

}  // namespace palpate::study
