// Densities are taken at the four points where an element's strains are most accurate, as fourth roots; between them
// they run straight outwards and as cubics down a layer, and so on to its borders.
#include "palpate/elements/field_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::elements {

namespace {

/// Fine where the sphere presses; beyond 40 mm nothing is worth an integral.
constexpr std::array kRadiiMm = {0.0, 0.75, 1.5,  2.25, 3.0,  3.75, 4.5,  5.25, 6.0,  6.75, 7.5,  8.25,
                                 9.0, 10.0, 11.0, 12.0, 13.5, 15.0, 17.0, 19.0, 22.0, 26.0, 32.0, 40.0};

/// From a layer's top to its bottom, steps growing with the depth under the skin: about 0.6 mm there, an eighth of the
/// depth farther down.
void addRows(double top, double bottom, int layer, tissue::PressField& knots) {
  constexpr double kFinestMm = 0.6;
  constexpr double kShareOfDepth = 0.12;
  constexpr double kMin = 3.0;  // steps
  const auto measure = [](double depth) { return std::log(depth + kFinestMm / kShareOfDepth) / kShareOfDepth; };
  const double steps = std::max(kMin, std::ceil(measure(bottom) - measure(top)));
  const double from = std::log(top + kFinestMm / kShareOfDepth);
  const double to = std::log(bottom + kFinestMm / kShareOfDepth);
  for (double i = 0.0; i <= steps; i += 1.0) {
    double depth = std::exp(from + (to - from) * i / steps) - kFinestMm / kShareOfDepth;
    if (i == 0.0) depth = top;
    if (i == steps) depth = bottom;
    knots.rows_mm.push_back(depth);
    knots.row_layers.push_back(layer);
  }
}

/// Between knots straight, beyond them straight on.
struct Straight {
  std::size_t below = 0;
  double share = 0.0;
};

Straight straightAt(const std::vector<double>& knots, double at) {
  const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, at);
  const auto below = static_cast<std::size_t>(after - knots.begin()) - 1;
  return {below, (at - knots[below]) / (knots[below + 1] - knots[below])};
}

/// Fourth roots at the points of one layer, columns by rows.
struct Roots {
  std::size_t rows = 0;
  std::vector<double> shear;
  std::vector<double> volume;
};

double fourthRoot(double value) { return std::sqrt(std::sqrt(std::max(0.0, value))); }

/// The cubic through the four nearest heights.
struct Cubic {
  std::size_t first = 0;
  std::array<double, 4> weight{};
};

Cubic cubicAt(const std::vector<double>& knots, double at) {
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(knots, at) - knots.begin());
  Cubic cubic{.first = std::clamp<std::size_t>(after < 2 ? 0 : after - 2, 0, knots.size() - 4)};
  for (std::size_t i = 0; i < 4; ++i) {
    cubic.weight[i] = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      const double other = knots[cubic.first + j];
      if (i != j) cubic.weight[i] *= (at - other) / (knots[cubic.first + i] - other);
    }
  }
  return cubic;
}

float rootAt(const std::vector<double>& roots, std::size_t rows, const Straight& column, const Cubic& row) {
  double root = 0.0;
  for (std::size_t i = 0; i < row.weight.size(); ++i) {
    const double near = roots[column.below * rows + row.first + i];
    const double far = roots[(column.below + 1) * rows + row.first + i];
    root += row.weight[i] * (near + column.share * (far - near));
  }
  return static_cast<float>(std::max(0.0, root));
}

}  // namespace

FieldSampler::FieldSampler(const PressModel& model, const tissue::LayerStack& stack) : model_(model) {
  const QuadMesh& mesh = model.mesh();
  knots_.radii_mm.assign(kRadiiMm.begin(), kRadiiMm.end());
  std::erase_if(knots_.radii_mm, [&](double r) { return r > mesh.columns.back(); });
  double top = 0.0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double bottom = top + stack.layers[layer].thickness_mm;
    addRows(top, bottom, static_cast<int>(layer), knots_);
    top = bottom;
  }
  const std::size_t rows = mesh.rows.size() - 1;
  layers_.resize(stack.layers.size());
  for (std::size_t element = 0; element < mesh.nodes.size(); ++element) {
    LayerPoints& layer = layers_[static_cast<std::size_t>(mesh.layers[element])];
    const auto places = quadPlaces(mesh, element);
    const bool first_of_layer = element % rows == 0 || mesh.layers[element] != mesh.layers[element - 1];
    if (first_of_layer) layer.elements.push_back(element);
    if (element % rows == 0) {
      radii_.push_back(places[kShearPoints][0]);
      radii_.push_back(places[kShearPoints + 2][0]);
    }
    if (element >= rows) continue;
    ++layer.rows;
    layer.depths_mm.push_back(mesh.height() - places[kShearPoints + 1][1]);
    layer.depths_mm.push_back(mesh.height() - places[kShearPoints][1]);
  }
}

void FieldSampler::add(double depth_mm, const Eigen::VectorXd& displacement) {
  std::vector<Roots> roots(layers_.size());
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    const LayerPoints& points = layers_[layer];
    Roots& of = roots[layer];
    of.rows = points.depths_mm.size();
    of.shear.resize(radii_.size() * of.rows);
    of.volume.resize(of.shear.size());
    for (std::size_t column = 0; column < points.elements.size(); ++column) {
      for (std::size_t row = 0; row < points.rows; ++row) {
        const auto gauss = model_.volumePoints(displacement, points.elements[column] + row);
        for (std::size_t q = 0; q < kVolumePoints; ++q) {
          // x outer, y inner; y goes up.
          const std::size_t at = (2 * column + q / 2) * of.rows + 2 * row + (1 - q % 2);
          const Gradient& f = gauss[q].gradient;
          const double log_volume = std::log(volumeRatio(f));
          double squares = -3.0;
          for (const double g : f) squares += g * g;
          of.shear[at] = fourthRoot(0.5 * squares - log_volume);
          of.volume[at] = fourthRoot(0.5 * log_volume * log_volume);
        }
      }
    }
  }
  std::vector<float>& shear = shear_.emplace_back();
  std::vector<float>& volume = volume_.emplace_back();
  for (std::size_t row = 0; row < knots_.rows_mm.size(); ++row) {
    const auto layer = static_cast<std::size_t>(knots_.row_layers[row]);
    const Cubic down = cubicAt(layers_[layer].depths_mm, knots_.rows_mm[row]);
    for (const double radius : knots_.radii_mm) {
      const Straight along = straightAt(radii_, std::max(radius, radii_.front()));
      shear.push_back(rootAt(roots[layer].shear, roots[layer].rows, along, down));
      volume.push_back(rootAt(roots[layer].volume, roots[layer].rows, along, down));
    }
  }
  knots_.depths_mm.push_back(depth_mm);
  knots_.patterns.push_back(fitPressurePattern(contactRings(model_.mesh(), model_.sphereAt(depth_mm), displacement)));
}

tissue::PressField FieldSampler::field() const {
  tissue::PressField field = knots_;
  const std::size_t presses = shear_.size();
  const std::size_t places = knots_.rows_mm.size() * knots_.radii_mm.size();
  field.shear.resize(places * presses);
  field.volume.resize(places * presses);
  for (std::size_t press = 0; press < presses; ++press) {
    for (std::size_t i = 0; i < places; ++i) {
      field.shear[i * presses + press] = shear_[press][i];
      field.volume[i * presses + press] = volume_[press][i];
    }
  }
  return field;
}

std::vector<double> ringPressures(const std::vector<ContactRing>& rings, double width_mm) {
  std::vector<double> pressures;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    // The force of a narrow ring is spread from where the one before ended to where the next begins.
    const double from = i == 0 ? 0.0 : 0.5 * (rings[i - 1].radius_mm + rings[i].radius_mm);
    const double to = i + 1 < rings.size() ? 0.5 * (rings[i].radius_mm + rings[i + 1].radius_mm) : rings[i].radius_mm;
    if (!(to > from)) continue;
    const auto last = static_cast<std::size_t>(to / width_mm);
    pressures.resize(std::max(pressures.size(), last + 1), 0.0);
    for (auto ring = static_cast<std::size_t>(from / width_mm); ring <= last; ++ring) {
      const double inner = std::max(from, width_mm * static_cast<double>(ring));
      const double outer = std::min(to, width_mm * static_cast<double>(ring + 1));
      if (outer > inner)
        pressures[ring] += rings[i].force_mn * (outer * outer - inner * inner) / (to * to - from * from);
    }
  }
  for (std::size_t ring = 0; ring < pressures.size(); ++ring) {
    const double inner = width_mm * static_cast<double>(ring);
    const double outer = inner + width_mm;
    pressures[ring] /= std::numbers::pi * (outer * outer - inner * inner);
  }
  return pressures;
}

std::vector<double> ringPressures(const tissue::PressurePattern& pattern, double width_mm, std::size_t count) {
  constexpr double kMnPerN = 1e3;
  std::vector<double> pressures;
  const auto outside = [&](double r) {
    const double share = r / pattern.contact_radius_mm;
    return share >= 1.0 ? 0.0 : std::pow(1.0 - share * share, pattern.exponent + 1.0);
  };
  for (std::size_t ring = 0; ring < count; ++ring) {
    const double inner = width_mm * static_cast<double>(ring);
    const double outer = inner + width_mm;
    pressures.push_back(kMnPerN * (outside(inner) - outside(outer)) /
                        (std::numbers::pi * (outer * outer - inner * inner)));
  }
  return pressures;
}

tissue::PressurePattern fitPressurePattern(const std::vector<ContactRing>& rings) {
  if (rings.empty()) return {};
  constexpr double kWidthMm = 0.5;
  const std::vector<double> solved = ringPressures(rings, kWidthMm);
  double force_n = 0.0;
  for (const ContactRing& ring : rings) force_n += 1e-3 * ring.force_mn;
  tissue::PressurePattern best{rings.back().radius_mm, 0.0};
  double least = 1e300;
  constexpr double kFlattest = 0.0;  // below, the rim would have no limit
  constexpr double kSteepest = 2.0;
  constexpr double kStep = 0.01;
  for (const double wide : {0.94, 0.95, 0.96, 0.97, 0.98, 0.99, 1.0, 1.01, 1.02, 1.03, 1.04}) {
    for (double exponent = kFlattest; exponent <= kSteepest; exponent += kStep) {
      const tissue::PressurePattern tried{wide * rings.back().radius_mm, exponent};
      const auto form = ringPressures(tried, kWidthMm, solved.size() + 1);
      double squares = 0.0;
      for (std::size_t i = 0; i < form.size(); ++i) {
        const double off = force_n * form[i] - (i < solved.size() ? solved[i] : 0.0);
        squares += (2.0 * static_cast<double>(i) + 1.0) * off * off;
      }
      if (squares >= least) continue;
      least = squares;
      best = tried;
    }
  }
  return best;
}

}  // namespace palpate::elements
