#include "palpate/deform/strain.h"

#include <algorithm>
#include <cmath>

namespace palpate::deform {

namespace {

/// Skin without strain: light enough that both colours stand out, dark enough to show shading.
constexpr Rgb kNeutral{225, 220, 215};
constexpr Rgb kTension{200, 20, 30};
constexpr Rgb kCompression{30, 60, 200};

}  // namespace

double edgeStrain(const Vec3& rest_edge_mm, const Vec3& stretch_mm) noexcept {
  const double rest = rest_edge_mm.norm();
  if (!(rest > 0.0)) return 0.0;
  // |e + s| - |e| without the cancellation of two nearly equal lengths.
  const double grown2 = (2.0 * rest_edge_mm + stretch_mm).dot(stretch_mm);
  return grown2 / (rest * ((rest_edge_mm + stretch_mm).norm() + rest));
}

float strainOfVertex(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept {
  const PositionStreams places{skin.rest[0], skin.rest[1], skin.rest[2]};
  const Vec3 place = places.at(vertex);
  const Vec3 moved = displacements.at(vertex);
  double sum = 0.0;
  const auto ring = skin.neighbours[vertex];
  for (const Index w : ring) sum += edgeStrain(places.at(w) - place, displacements.at(w) - moved);
  return ring.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(ring.size()));
}

Rgb strainColour(float strain, float range) noexcept {
  if (std::isnan(strain) || !(range > 0.0f)) return kNeutral;
  const float share = std::min(std::abs(strain) / range, 1.0f);
  const Rgb& full = strain > 0.0f ? kTension : kCompression;
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    const float from = kNeutral[i];
    colour[i] = static_cast<std::uint8_t>(std::lround(from + share * (static_cast<float>(full[i]) - from)));
  }
  return colour;
}

void colourByStrain(std::span<const float> strain, float range, std::span<Rgb> colours) noexcept {
  for (std::size_t v = 0; v < strain.size(); ++v) colours[v] = strainColour(strain[v], range);
}

}  // namespace palpate::deform
