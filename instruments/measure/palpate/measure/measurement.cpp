#include "palpate/measure/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"
#include "palpate/base/stopwatch.h"
#include "palpate/measure/dot_matching.h"
#include "palpate/measure/field_report.h"
#include "palpate/measure/skin_chart.h"

namespace palpate::measure {

namespace {

constexpr int kMatchesAgain = 2;
constexpr std::size_t kMinForFit = 12;
constexpr int kEllipsePlaces = 72;          // points of the ellipse that are checked for nearby dots
constexpr double kNewlyVisibleReach = 0.2;  // in spacings
constexpr double kNeighbourReach = 1.5;     // in spacings: with diagonals

void check(const MeasureSettings& settings) {
  if (!(settings.spacing_mm >= 5.0 && settings.spacing_mm <= 100.0)) throw Error("spacing: must be 5 to 100 mm");
  if (!(settings.drift_mm >= 0.01 && settings.drift_mm <= 20.0)) throw Error("drift: must be 0.01 to 20 mm");
  if (settings.contact_px && !settings.contact_px->allFinite()) throw Error("contact: must be a finite place");
}

/// The pictures' millimetres: those of the middle of the dots.
struct PictureScale {
  Vec2 centre_px = Vec2::Zero();
  double px_per_mm = 1.0;
};

PictureScale computePictureScale(const DotGrid& grid, double spacing_mm) {
  PictureScale scale;
  for (const GridDot& dot : grid.dots) scale.centre_px += dot.dot.place_px / static_cast<double>(grid.dots.size());
  scale.px_per_mm = grid.spacing_px / spacing_mm;
  return scale;
}

/// A place of the first picture as the fit sees it, nothing moved yet.
FieldDatum datumAt(const SkinChart& chart, const PictureScale& scale, const Vec2& place_px) {
  return {.skin_mm = chart.skinAt(place_px),
          .picture_mm = (place_px - scale.centre_px) / scale.px_per_mm,
          .to_skin = chart.jacobianAt(place_px) * scale.px_per_mm};
}

/// The pipeline from marks to findings, over one Measurement.
class DotPairReading {
 public:
  DotPairReading(Measurement& measurement, std::span<const Dot> after)
      : m_(measurement),
        after_(after),
        scale_(computePictureScale(m_.grid, m_.settings.spacing_mm)),
        prior_(makeDriftPrior(m_.settings.drift_mm)) {
    for (const GridDot& dot : m_.grid.dots) data_.push_back(datumAt(*m_.chart, scale_, dot.dot.place_px));
  }

  void measure(const Progress& progress) {
    report(progress, "matching dots", 0.0);
    adoptMatch(matchDots(m_.grid, after_));
    for (int i = 0; i < kMatchesAgain && m_.matched >= kMinForFit; ++i) {
      fit();
      adoptMatch(matchAt(m_.grid, predicted(), after_));
    }
    if (m_.matched < kMinForFit) return;
    report(progress, "fitting the field", 0.5);
    fitAllForms();
    describe();
    report(progress, "reading the contour", 0.9);
    m_.contour = readContour(m_.dots, *m_.chart, *m_.fit, m_.settings.spacing_mm);
  }

  /// Marks of the second picture on sites within the grid that the first does not show.
  std::size_t newlyVisible() const {
    if (!m_.fit) return 0;
    std::set<std::pair<int, int>> known;
    for (const GridDot& dot : m_.grid.dots) known.emplace(dot.site.column, dot.site.row);
    const auto neighbours = [&](int column, int row) {
      int count = 0;
      for (int dc = -1; dc <= 1; ++dc) {
        for (int dr = -1; dr <= 1; ++dr) count += static_cast<int>(known.contains({column + dc, row + dr}));
      }
      return count;
    };
    std::set<std::size_t> used;
    for (const auto& mark : match_.of) {
      if (mark) used.insert(*mark);
    }
    std::size_t visible = 0;
    for (const auto& [column, row] : freeSitesBeside(known)) {
      if (neighbours(column, row) < 3) continue;
      const Vec2 place = predictPixel(skinOfSite(column, row));
      const bool is_seen = [&] {
        for (std::size_t i = 0; i < after_.size(); ++i) {
          if (!used.contains(i) && (after_[i].place_px - place).norm() < kNewlyVisibleReach * m_.grid.spacing_px)
            return true;
        }
        return false;
      }();
      visible += static_cast<std::size_t>(is_seen);
    }
    return visible;
  }

 private:
  void adoptMatch(DotMatch match) {
    match_ = std::move(match);
    m_.matched = match_.count;
    m_.dots.assign(m_.grid.dots.size(), {});
    for (std::size_t i = 0; i < m_.dots.size(); ++i) {
      MeasuredDot& dot = m_.dots[i];
      dot.site = m_.grid.dots[i].site;
      dot.before_px = m_.grid.dots[i].dot.place_px;
      dot.skin_mm = data_[i].skin_mm;
      if (!match_.of[i]) continue;
      dot.after_px = after_[*match_.of[i]].place_px;
      dot.moved_mm = data_[i].moved_mm = m_.chart->skinAt(*dot.after_px) - dot.skin_mm;
    }
  }

  void gatherMatched() {
    matched_data_.clear();
    for (std::size_t i = 0; i < data_.size(); ++i) {
      if (match_.of[i]) matched_data_.push_back(data_[i]);
    }
  }

  void fit() {
    gatherMatched();
    fitted_ = fitField(matched_data_, prior_);
  }

  void fitAllForms() {
    gatherMatched();
    forms_ = fitForms(matched_data_, prior_);
    fitted_ = forms_.front().fitted;
  }

  Vec2 predictPixel(const FieldDatum& datum) const {
    return m_.chart->pictureAt(datum.skin_mm +
                               displacementAt(toSkinField(fitted_.numbers, fitted_.form), datum.skin_mm) +
                               driftAt(fitted_.numbers, datum));
  }

  std::vector<Vec2> predicted() const {
    std::vector<Vec2> places;
    for (const FieldDatum& datum : data_) places.push_back(predictPixel(datum));
    return places;
  }

  static std::set<std::pair<int, int>> freeSitesBeside(const std::set<std::pair<int, int>>& known) {
    std::set<std::pair<int, int>> free;
    for (const auto& [column, row] : known) {
      for (int dc = -1; dc <= 1; ++dc) {
        for (int dr = -1; dr <= 1; ++dr) {
          if (!known.contains({column + dc, row + dr})) free.emplace(column + dc, row + dr);
        }
      }
    }
    return free;
  }

  /// A site without a dot, as its neighbours have it.
  FieldDatum skinOfSite(int column, int row) const {
    double weights = 0.0;
    Vec2 place_px = Vec2::Zero();
    // The picture place of a site: the neighbour's, a step on along the chart.
    for (const auto& [site, dot] : m_.grid.dots) {
      if (std::abs(site.column - column) > 1 || std::abs(site.row - row) > 1) continue;
      const Mat2 to_px = m_.chart->jacobianAt(dot.place_px).inverse();
      place_px += dot.place_px + to_px * skinStep(column - site.column, row - site.row);
      weights += 1.0;
    }
    return datumAt(*m_.chart, scale_, place_px / weights);
  }

  /// This number of columns and rows, on the skin.
  Vec2 skinStep(int columns, int rows) const {
    return m_.settings.spacing_mm * headUp(Vec2(columns, rows), m_.settings.head);
  }

  void describe() {
    m_.fit = reportField(forms_, m_.chart->jacobianAt(scale_.centre_px) * scale_.px_per_mm, prior_);
    FieldFit& fit = *m_.fit;
    double sum = 0.0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < m_.dots.size(); ++i) {
      m_.dots[i].drift_mm = driftAt(fitted_.numbers, data_[i]);
      if (!match_.of[i]) continue;
      m_.dots[i].residual_mm = fitted_.residuals_mm[at++];
      sum += m_.dots[i].residual_mm * m_.dots[i].residual_mm;
    }
    fit.residual_rms_mm = std::sqrt(sum / static_cast<double>(m_.matched));
    fit.residual_pattern = residualPattern();
    widenByDots(matched_data_, fitted_.numbers, fit);
    const maps::Ellipse ellipse = ellipseOf(fit.at_2_mm);
    const Vec2 major = ellipse.half_major_mm * Vec2(std::cos(ellipse.direction_rad), std::sin(ellipse.direction_rad));
    const Vec2 minor = ellipse.aspect * Vec2(-major.y(), major.x());
    int inside = 0;
    for (int i = 0; i < kEllipsePlaces; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kEllipsePlaces;
      inside +=
          static_cast<int>(m_.chart->covers(fit.field.contact_mm + std::cos(angle) * major + std::sin(angle) * minor));
    }
    fit.inside_share = static_cast<double>(inside) / kEllipsePlaces;
  }

  /// Correlation of neighbouring residuals of the likeliest form.
  double residualPattern() const {
    const SkinField field = toSkinField(fitted_.numbers, fitted_.form);
    std::vector<Vec2> left;
    double squares = 0.0;
    for (const FieldDatum& datum : matched_data_) {
      left.push_back(datum.moved_mm - displacementAt(field, datum.skin_mm) - driftAt(fitted_.numbers, datum));
      squares += left.back().squaredNorm() / static_cast<double>(matched_data_.size());
    }
    double common = 0.0;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double distance = (matched_data_[i].skin_mm - matched_data_[j].skin_mm).norm();
        if (distance > kNeighbourReach * m_.settings.spacing_mm) continue;
        common += left[i].dot(left[j]);
        ++pairs;
      }
    }
    return pairs > 0 && squares > 0.0 ? common / (squares * static_cast<double>(pairs)) : 0.0;
  }

  Measurement& m_;
  std::span<const Dot> after_;
  PictureScale scale_;
  DriftPrior prior_;
  std::vector<FieldDatum> data_;          // one a dot of the grid
  std::vector<FieldDatum> matched_data_;  // data of the last fit
  DotMatch match_;
  FittedField fitted_;  // the likeliest
  std::vector<WeighedField> forms_;
};

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  findings.insert(findings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// A chart where the grid allows one.
void chartGrid(Measurement& m) {
  if (m.grid.dots.size() < kMinDotsInOrder) return;
  try {
    m.chart = std::make_shared<const SkinChart>(m.grid, m.settings.spacing_mm, m.settings.head);
  } catch (const Error&) {
    m.findings.push_back({Severity::refusal, "few_dots", "The dots in the grid are in one line."});
  }
}

bool hasTooMany(const DotPair& dots, Measurement& m) {
  const std::size_t most = std::max(dots.before.size(), dots.after.size());
  if (most <= kMaxMarks) return false;
  m.findings.push_back(
      {Severity::refusal, "many_marks",
       fmt::format(
           "{} marks of one colour in a picture: at most {} can be dots. Keep patterned cloth out of the frame.", most,
           kMaxMarks)});
  return true;
}

void measureMarks(const DotPair& dots, Measurement& m, const Progress& progress) {
  m.after_dots = dots.after;
  if (hasTooMany(dots, m)) return;
  report(progress, "ordering dots", 0.0);
  m.grid = growGrid(dots.before);
  m.findings = judgeGrid(m.grid, m.settings);
  chartGrid(m);
  if (!m.chart) return;
  DotPairReading reading(m, m.after_dots);
  reading.measure(progress);
  append(m.findings, judgeFit(m, reading.newlyVisible()));
}

void requireSameSize(const Photograph& before, const Photograph& after) {
  if (before.width_px == after.width_px && before.height_px == after.height_px) return;
  throw Error::inFile(after.name,
                      fmt::format("is {} x {} pixels, {} is {} x {}; both must come from one camera, uncropped",
                                  after.width_px, after.height_px, before.name, before.width_px, before.height_px));
}

}  // namespace

Measurement measureDots(const DotPair& dots, const MeasureSettings& settings, const Progress& progress) {
  check(settings);
  const auto start = Clock::now();
  Measurement m;
  m.settings = settings;
  measureMarks(dots, m, progress);
  m.seconds = secondsSince(start);
  return m;
}

Measurement measurePair(const Photograph& before, const Photograph& after, const MeasureSettings& settings,
                        const Progress& progress) {
  check(settings);
  requireSameSize(before, after);
  const auto start = Clock::now();
  Measurement m;
  m.settings = settings;
  m.width_px = before.width_px;
  m.height_px = before.height_px;
  report(progress, "finding dots", 0.0);
  FoundDots first = findDots(before);
  m.ink = first.ink;
  report(progress, "finding dots", 0.5);
  FoundDots second = findDots(after, first.ink);
  measureMarks({std::move(first.dots), std::move(second.dots)}, m, progress);
  if (before.taken_at_s && after.taken_at_s && *after.taken_at_s < *before.taken_at_s)
    m.findings.push_back({Severity::refusal, "swapped",
                          fmt::format("{} was taken {:.0f} s before {}: give the pictures in the order before, after.",
                                      after.name, *before.taken_at_s - *after.taken_at_s, before.name)});
  m.seconds = secondsSince(start);
  return m;
}

std::optional<double> nullDrift(const Photograph& first, const Photograph& second, const MeasureSettings& settings) {
  check(settings);
  requireSameSize(first, second);
  FoundDots before = findDots(first);
  const FoundDots after = findDots(second, before.ink);
  if (std::max(before.dots.size(), after.dots.size()) > kMaxMarks) return {};
  Measurement m;
  m.settings = settings;
  m.grid = growGrid(before.dots);
  chartGrid(m);
  if (!m.chart) return {};
  const PictureScale scale = computePictureScale(m.grid, settings.spacing_mm);
  const DotMatch match = matchDots(m.grid, after.dots);
  if (match.count < kMinForFit) return {};
  std::vector<FieldDatum> data;
  for (std::size_t i = 0; i < m.grid.dots.size(); ++i) {
    if (!match.of[i]) continue;
    FieldDatum datum = datumAt(*m.chart, scale, m.grid.dots[i].dot.place_px);
    datum.moved_mm = m.chart->skinAt(after.dots[*match.of[i]].place_px) - datum.skin_mm;
    data.push_back(datum);
  }
  constexpr double kAnyDriftMm = 20.0;  // nothing else moves here: the dots alone decide
  return fitDrift(data, makeDriftPrior(kAnyDriftMm)).head<2>().norm();
}

}  // namespace palpate::measure
