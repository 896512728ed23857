// The layers of the three panels, one small function each. Places of the skin go into the picture by the chart; what
// has no chart or no fit is left out.
//
// Colours are of the palette of Okabe and Ito, which people with any common colour vision can distinguish: the fit is
// blue, the contour's result is vermilion, 2 mm solid and 4 mm dashed.
#include "palpate/measure/overlay.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/measure/skin_chart.h"

namespace palpate::measure {

namespace {

constexpr OverlayColour kBlue{0.00f, 0.36f, 0.62f};
constexpr OverlayColour kVermilion{0.84f, 0.37f, 0.00f};
constexpr OverlayColour kSky{0.34f, 0.71f, 0.91f};
constexpr OverlayColour kYellow{0.94f, 0.89f, 0.26f};
constexpr OverlayColour kGreen{0.00f, 0.62f, 0.45f};
constexpr OverlayColour kInk{0.10f, 0.10f, 0.10f};

constexpr int kRays = 72;
constexpr double kBandSds = 2.0;
constexpr double kScaleBarMm = 50.0;
constexpr double kRadPerDegree = std::numbers::pi / 180.0;
/// No ellipse of a back is longer; an extrapolated one would fill the picture.
constexpr double kLongestMm = 1000.0;

Vec2 unitVector(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// The motion of a dot in the picture, `times` as long. With a fit the body's own motion is taken off.
Vec2 arrowTip(const Measurement& m, const MeasuredDot& dot, double times) {
  if (!m.chart || !m.fit) return dot.before_px + times * (*dot.after_px - dot.before_px);
  const Mat2 to_picture = m.chart->jacobianAt(dot.before_px).inverse();
  const Vec2 moved = to_picture * (dot.moved_mm - dot.drift_mm);
  return moved.allFinite() ? Vec2(dot.before_px + times * moved) : dot.before_px;
}

/// Where a hidden dot would be seen.
Vec2 expectedPlace(const Measurement& m, const MeasuredDot& dot) {
  if (!m.chart || !m.fit) return dot.before_px;
  const Vec2 expected = m.chart->pictureAt(dot.skin_mm + displacementAt(m.fit->field, dot.skin_mm) + dot.drift_mm);
  return expected.allFinite() ? expected : dot.before_px;
}

class Layers {
 public:
  Layers(const Measurement& measurement, double arrow_scale) : m_(measurement), arrow_scale_(arrow_scale) {}

  OverlayPanel before() {
    begin(tr("before: dots ordered into the grid"), PanelPicture::before);
    addGrid();
    addMarks(placesOf(m_.grid.strays), MarkForm::cross, kYellow, tr("stray mark, not used"));
    addContacts();
    return std::move(panel_);
  }

  OverlayPanel after() {
    begin(tr("after: matched dots"), PanelPicture::after);
    std::vector<Vec2> matched;
    std::vector<Vec2> hidden;
    for (const MeasuredDot& dot : m_.dots) {
      dot.after_px ? matched.push_back(*dot.after_px) : hidden.push_back(expectedPlace(m_, dot));
    }
    addMarks(matched, MarkForm::ring, kGreen, tr("matched"));
    addMarks(hidden, MarkForm::square, kYellow, tr("hidden: reported, not guessed"));
    addMarks(unusedAfter(matched), MarkForm::cross, kVermilion, tr("mark without a matching dot"));
    return std::move(panel_);
  }

  OverlayPanel result() {
    begin(trf("displacement (arrows x{:g}) and key ellipse", arrow_scale_), PanelPicture::before_faded);
    panel_.scale_bar_px = scaleBar();
    if (drawsEllipse()) addBand(m_.fit->at_2_mm);
    addArrows();
    if (drawsEllipse()) addEllipses();
    addContour();  // thin: it would vanish under the ellipse
    addContacts();
    return std::move(panel_);
  }

 private:
  void begin(std::string title, PanelPicture picture) {
    panel_ = {};
    panel_.title = std::move(title);
    panel_.picture = picture;
  }

  static std::vector<Vec2> placesOf(const std::vector<Dot>& dots) {
    std::vector<Vec2> places;
    for (const Dot& dot : dots) places.push_back(dot.place_px);
    return places;
  }

  void addMarks(const std::vector<Vec2>& places, MarkForm form, const OverlayColour& colour, const char* words) {
    for (const Vec2& place : places) panel_.marks.push_back({.place_px = place, .form = form, .colour = colour});
    if (!places.empty()) panel_.legend.push_back({.words = words, .colour = colour, .form = form});
  }

  void addLine(OverlayLine line, const std::string& words) {
    if (line.places_px.size() < 2) return;
    if (!words.empty()) {
      panel_.legend.push_back({.words = words, .colour = line.colour, .is_line = true, .dashed = line.dashed});
    }
    panel_.lines.push_back(std::move(line));
  }

  void addGrid() {
    std::map<std::pair<int, int>, Vec2> sites;
    for (const GridDot& dot : m_.grid.dots) sites[{dot.site.column, dot.site.row}] = dot.dot.place_px;
    for (const auto& [site, place] : sites) {
      for (const auto& [columns, rows] : {std::pair{1, 0}, std::pair{0, 1}}) {
        const auto neighbour = sites.find({site.first + columns, site.second + rows});
        if (neighbour == sites.end()) continue;
        panel_.lines.push_back({.places_px = {place, neighbour->second}, .colour = kSky, .width = 1.2f});
      }
    }
    if (!sites.empty()) {
      panel_.legend.push_back({.words = trnf("grid of {} dot", "grid of {} dots", sites.size(), sites.size()),
                               .colour = kSky,
                               .is_line = true});
    }
  }

  /// Places of marks that became no dot's.
  std::vector<Vec2> unusedAfter(std::vector<Vec2> matched) const {
    const auto before = [](const Vec2& a, const Vec2& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); };
    std::sort(matched.begin(), matched.end(), before);
    std::vector<Vec2> unused;
    for (const Dot& dot : m_.after_dots) {
      if (!std::binary_search(matched.begin(), matched.end(), dot.place_px, before)) unused.push_back(dot.place_px);
    }
    return unused;
  }

  void addArrows() {
    std::vector<Vec2> seen;
    for (const MeasuredDot& dot : m_.dots) {
      if (!dot.after_px) continue;
      seen.push_back(dot.before_px);
      panel_.arrows.push_back({.from_px = dot.before_px, .to_px = arrowTip(m_, dot, arrow_scale_), .colour = kInk});
    }
    for (const Vec2& place : seen) {
      panel_.marks.push_back({.place_px = place, .form = MarkForm::dot, .colour = kInk, .radius = 1.4f});
    }
    const char* words = m_.fit ? tr("motion of the skin relative to the body") : tr("motion of the dots");
    if (!seen.empty()) panel_.legend.push_back({.words = words, .colour = kInk, .is_line = true});
  }

  bool drawsEllipse() const {
    return m_.chart && m_.fit && m_.fit->at_2_mm.half_major_mm.value > 0.0 &&
           m_.fit->at_2_mm.half_major_mm.value < kLongestMm;
  }

  Vec2 toPicture(const Vec2& skin_mm) const { return m_.chart->pictureAt(skin_mm); }

  /// The ellipse, its radius longer or shorter by `sds` sd of its three numbers.
  std::vector<Vec2> ellipsePlaces(const KeyEllipse& key, double sds) const {
    const double a = key.half_major_mm.value;
    const double b = key.half_minor_mm.value;
    const double turn = key.direction_deg.value * kRadPerDegree;
    std::vector<Vec2> places;
    for (int i = 0; i <= kRays; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRays;  // against the major axis
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      const double r = 1.0 / std::sqrt(c * c / (a * a) + s * s / (b * b));
      // dr of each number by its sd, from 1/r^2.
      const double r3 = r * r * r;
      const double sd =
          std::hypot(r3 * c * c / (a * a * a) * key.half_major_mm.sd, r3 * s * s / (b * b * b) * key.half_minor_mm.sd,
                     r3 * c * s * (1.0 / (b * b) - 1.0 / (a * a)) * key.direction_deg.sd * kRadPerDegree);
      const double radius = std::max(0.0, r + sds * (std::isfinite(sd) ? std::min(sd, r) : r));
      places.push_back(toPicture(m_.fit->field.contact_mm + radius * unitVector(angle + turn)));
    }
    return places;
  }

  void addBand(const KeyEllipse& key) {
    std::vector<Vec2> band = ellipsePlaces(key, kBandSds);
    const std::vector<Vec2> inner = ellipsePlaces(key, -kBandSds);
    band.insert(band.end(), inner.rbegin(), inner.rend());
    OverlayColour colour = kBlue;
    colour.opacity = 0.9f;
    panel_.lines.push_back(
        {.places_px = std::move(band), .colour = colour, .width = 0.0f, .closed = true, .filled = true});
  }

  void addContour() {
    if (!m_.contour || !m_.chart) return;
    for (const auto& [contour, level, dashed] :
         {std::tuple{&m_.contour->contour_2_mm, 2, false}, std::tuple{&m_.contour->contour_4_mm, 4, true}}) {
      OverlayLine line{.places_px = {}, .colour = kVermilion, .width = 1.0f, .dashed = dashed};
      for (const Vec2& place : *contour) line.places_px.push_back(toPicture(place));
      addLine(std::move(line), trf("{} mm contour, interpolated", level));
    }
  }

  void addEllipses() {
    const FieldFit& fit = *m_.fit;
    addLine({.places_px = ellipsePlaces(fit.at_2_mm, 0.0), .colour = kBlue, .width = 3.2f, .closed = true},
            tr("2 mm ellipse, fitted, with 2 sd"));
    if (fit.at_4_mm.half_major_mm.value > 0.0) {
      addLine({.places_px = ellipsePlaces(fit.at_4_mm, 0.0),
               .colour = kBlue,
               .width = 2.4f,
               .dashed = true,
               .closed = true},
              tr("4 mm ellipse, fitted"));
    }
    const Vec2 half = fit.at_2_mm.half_major_mm.value * unitVector(fit.at_2_mm.direction_deg.value * kRadPerDegree);
    const Vec2& centre = fit.field.contact_mm;
    addLine({.places_px = {toPicture(centre - half), toPicture(centre), toPicture(centre + half)},
             .colour = kBlue,
             .width = 1.0f},
            {});
  }

  void addContacts() {
    if (drawsEllipse()) {
      panel_.marks.push_back(
          {.place_px = toPicture(m_.fit->field.contact_mm), .form = MarkForm::star, .colour = kInk, .radius = 6.0f});
      panel_.legend.push_back({.words = tr("contact, fitted"), .colour = kInk, .form = MarkForm::star});
    }
    if (m_.settings.contact_px) {
      panel_.marks.push_back(
          {.place_px = *m_.settings.contact_px, .form = MarkForm::ring, .colour = kVermilion, .radius = 5.0f});
      panel_.legend.push_back({.words = tr("contact, marked"), .colour = kVermilion, .form = MarkForm::ring});
    }
  }

  double scaleBar() const {
    if (!m_.chart || m_.grid.dots.empty()) return 0.0;
    Vec2 middle = Vec2::Zero();
    for (const GridDot& dot : m_.grid.dots) middle += dot.dot.place_px / static_cast<double>(m_.grid.dots.size());
    const double mm_per_px = m_.chart->jacobianAt(middle).col(0).norm();
    return mm_per_px > 0.0 ? kScaleBarMm / mm_per_px : 0.0;
  }

  const Measurement& m_;
  double arrow_scale_;
  OverlayPanel panel_;
};

std::string describeVerdict(const Measurement& m) {
  if (!m.accepted()) {
    const auto refusal = std::find_if(m.findings.begin(), m.findings.end(),
                                      [](const Finding& finding) { return finding.severity == Severity::refusal; });
    return refusal == m.findings.end() ? tr("refused: nothing was measured") : trf("refused: {}", refusal->text);
  }
  const KeyEllipse& key = m.fit->at_2_mm;
  const std::string peak = m.fit->peak_mm ? trf("peak {:.1f} ± {:.1f} mm", m.fit->peak_mm->value, m.fit->peak_mm->sd)
                                          : std::string(tr("peak not seen"));
  return trf(
      "accepted: half axes at 2 mm {:.1f} ± {:.1f} and {:.1f} ± {:.1f} mm, ratio {:.2f} ± {:.2f}, direction "
      "{:.1f} ± {:.1f} degrees; {}",
      key.half_major_mm.value, key.half_major_mm.sd, key.half_minor_mm.value, key.half_minor_mm.sd,
      key.major_over_minor.value, key.major_over_minor.sd, key.direction_deg.value, key.direction_deg.sd, peak);
}

}  // namespace

Overlay buildOverlay(const Measurement& measurement, double arrow_scale) {
  Overlay overlay;
  Layers layers(measurement, arrow_scale);
  overlay.panels = {layers.before(), layers.after(), layers.result()};
  overlay.accepted = measurement.accepted() && measurement.fit.has_value();
  overlay.verdict = describeVerdict(measurement);
  for (const Finding& finding : measurement.findings) {
    overlay.findings.push_back(finding.severity == Severity::refusal ? trf("refused: {}", finding.text)
                                                                     : trf("warning: {}", finding.text));
  }
  return overlay;
}

}  // namespace palpate::measure
