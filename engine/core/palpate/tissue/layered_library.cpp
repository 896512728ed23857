// The solved stacks as numbers: a node after the other, thickness by thickness and share by share.
#include "palpate/tissue/layered_library.h"

#include <algorithm>
#include <array>

#include "palpate/base/error.h"

namespace palpate::tissue {

namespace {

#include "palpate/tissue/layered_fingers_numbers.inc"
#include "palpate/tissue/layered_library_numbers.inc"

constexpr std::size_t kShares = std::size(kFatShares);
constexpr double kSkinMm = 2.0;
constexpr double kMinMuscleMm = 3.0;

class NodeReader {
 public:
  explicit NodeReader(std::span<const double> numbers) : numbers_(numbers) {}

  LayeredNode next(double thickness_mm) {
    LayeredNode node;
    node.thickness_mm = thickness_mm;
    const auto depths = static_cast<std::size_t>(number());
    const double radius = number();
    node.drag.along_mm = number();
    node.drag.across_mm = number();
    node.drag.tenth_q = number();
    node.tangential_over_normal = number();
    node.drag.share = curve();
    for (std::size_t i = 0; i < depths; ++i) {
      node.depths_mm.push_back(number());
      node.secants.push_back(number());
      const LayeredCurve down = curve();
      node.presses.push_back({radius, down, curve()});
    }
    return node;
  }

 private:
  double number() {
    const double value = numbers_.front();
    numbers_ = numbers_.subspan(1);
    return value;
  }
  LayeredCurve curve() {
    LayeredCurve curve;
    for (double& term : curve.terms) term = number();
    return curve;
  }

  std::span<const double> numbers_;
};

/// The forces of the other fingers, stack after stack: of each radius how many depths were reached, then their forces
/// at the first of kFingerDepthsMm.
class FingerReader {
 public:
  explicit FingerReader(std::span<const double> numbers) : numbers_(numbers) {}

  std::vector<FingerForces> next() {
    std::vector<FingerForces> fingers;
    for (const double radius : kFingerRadiiMm) {
      FingerForces& finger = fingers.emplace_back(FingerForces{radius, {}, {}});
      const auto count = static_cast<std::size_t>(numbers_.front());
      finger.depths_mm.assign(std::begin(kFingerDepthsMm), std::begin(kFingerDepthsMm) + count);
      finger.force_n.assign(numbers_.begin() + 1, numbers_.begin() + 1 + static_cast<std::ptrdiff_t>(count));
      numbers_ = numbers_.subspan(count + 1);
    }
    return fingers;
  }

 private:
  std::span<const double> numbers_;
};

/// By thickness, by share.
std::vector<std::array<LayeredNode, kShares>> allNodes() {
  std::vector<std::array<LayeredNode, kShares>> nodes;
  NodeReader reader(kNodes);
  FingerReader fingers(kFingerForces);
  for (const double thickness : kThicknessesMm) {
    nodes.emplace_back();
    for (LayeredNode& node : nodes.back()) {
      node = reader.next(thickness);
      node.fingers = fingersOf(fingers.next(), kFingertipMm, node);
    }
  }
  return nodes;
}

LayeredNode withFat(const std::array<LayeredNode, kShares>& nodes, double share) {
  const auto* const begin = std::begin(kFatShares);
  if (share <= kFatShares[0]) return nodes.front();
  if (share >= kFatShares[kShares - 1]) return nodes.back();
  const auto above = static_cast<std::size_t>(std::upper_bound(begin, std::end(kFatShares), share) - begin);
  const double from = kFatShares[above - 1];
  return blended(nodes[above - 1], nodes[above], (share - from) / (kFatShares[above] - from));
}

}  // namespace

LayerStack libraryStack(double thickness_mm, double fat_share) {
  const double under_skin = thickness_mm - kSkinMm;
  return {{{"skin", kSkinMm, 150.0},
           {"fat", fat_share * under_skin, 10.0},
           {"muscle", (1.0 - fat_share) * under_skin, 27.0}}};
}

double libraryFatShare(double thickness_mm, double fat_mm) {
  const double under_skin = thickness_mm - kSkinMm;
  return std::clamp(std::min(fat_mm, under_skin - kMinMuscleMm) / under_skin, kFatShares[0], kFatShares[kShares - 1]);
}

std::span<const double> libraryThicknesses() { return kThicknessesMm; }
std::span<const double> libraryFatShares() { return kFatShares; }

std::vector<LayeredNode> libraryNodes(double fat_mm) {
  std::vector<LayeredNode> result;
  for (const auto& nodes : allNodes()) {
    result.push_back(withFat(nodes, libraryFatShare(nodes.front().thickness_mm, fat_mm)));
  }
  return result;
}

std::vector<double> libraryNumbers(const LayeredNode& node) {
  std::vector<double> numbers = {static_cast<double>(node.depths_mm.size()),
                                 node.presses.front().radius_mm,
                                 node.drag.along_mm,
                                 node.drag.across_mm,
                                 node.drag.tenth_q,
                                 node.tangential_over_normal};
  const auto add = [&](const LayeredCurve& curve) {
    numbers.insert(numbers.end(), curve.terms.begin(), curve.terms.end());
  };
  add(node.drag.share);
  for (std::size_t i = 0; i < node.depths_mm.size(); ++i) {
    numbers.push_back(node.depths_mm[i]);
    numbers.push_back(node.secants[i]);
    add(node.presses[i].down);
    add(node.presses[i].outward);
  }
  return numbers;
}

std::vector<FingerSecants> fingersLikeLibrary(const LayerStack& stack, double indenter_radius_mm,
                                              const LayeredNode& node) {
  const double thickness = totalThickness(stack);
  const auto under_skin = std::span(stack.layers).subspan(1);
  const auto fat = std::ranges::min_element(under_skin, {}, &Layer::young_kpa);
  const LayeredTissue library(libraryNodes(fat == under_skin.end() ? 0.0 : fat->thickness_mm));
  std::vector<FingerSecants> fingers;
  for (const double radius : LayeredForce::kRadiiMm) {
    FingerSecants& finger = fingers.emplace_back(FingerSecants{radius, {}});
    for (std::size_t i = 0; i < node.depths_mm.size(); ++i) {
      const double depth = node.depths_mm[i];
      const double ratio =
          library.secantAt(thickness, depth, radius) / library.secantAt(thickness, depth, indenter_radius_mm);
      finger.secants.push_back(node.secants[i] * ratio);
    }
  }
  return fingers;
}

}  // namespace palpate::tissue
