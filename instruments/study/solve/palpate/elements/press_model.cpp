#include "palpate/elements/press_model.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::elements {

PressModel::PressModel(const tissue::LayerStack& stack, const MeshFineness& fineness, double indenter_radius_mm,
                       double contact_kpa_per_mm)
    : mesh_(quadMesh(stack, fineness)),
      sphere_{.radius_mm = indenter_radius_mm, .stiffness_kpa_per_mm = contact_kpa_per_mm},
      matrix_(mesh_),
      residual_(Eigen::VectorXd::Zero(mesh_.freedom_count)) {
  for (const tissue::Layer& layer : stack.layers) {
    laws_.push_back(neoHookean(layer.young_kpa, stack.poisson));
    layer_names_.push_back(layer.name);
  }
  for (std::size_t element = 0; element < mesh_.nodes.size(); ++element) {
    points_.push_back(quadPoints(mesh_, element));
  }
  if (fineness.lump && fineness.lump->young_kpa) hardenLump(stack, *fineness.lump);
}

void PressModel::hardenLump(const tissue::LayerStack& stack, const Inclusion& lump) {
  lump_law_of_.assign(mesh_.nodes.size(), -1);
  for (std::size_t element = 0; element < mesh_.nodes.size(); ++element) {
    const double layer_kpa = stack.layers[static_cast<std::size_t>(mesh_.layers[element])].young_kpa;
    const auto places = quadPlaces(mesh_, element);
    QuadLaws laws;
    bool inside = false;
    for (std::size_t q = 0; q < kQuadPoints; ++q) {
      const double young = youngModulusAt(lump, places[q][0], mesh_.height() - places[q][1], layer_kpa);
      laws[q] = neoHookean(young, stack.poisson);
      inside = inside || young != layer_kpa;
    }
    if (!inside) continue;
    lump_law_of_[element] = static_cast<int>(lump_laws_.size());
    lump_laws_.push_back(laws);
  }
}

QuadVector PressModel::ofElement(const Eigen::VectorXd& displacement, std::size_t element) const {
  QuadVector local;
  for (std::size_t i = 0; i < kQuadFreedoms; ++i) {
    local[i] = displacement[2 * mesh_.nodes[element][i / 2] + static_cast<int>(i % 2)];
  }
  return local;
}

std::array<PressModel::VolumePoint, kVolumePoints> PressModel::volumePoints(const Eigen::VectorXd& displacement,
                                                                            std::size_t element) const {
  const QuadVector local = ofElement(displacement, element);
  const auto places = quadPlaces(mesh_, element);
  std::array<VolumePoint, kVolumePoints> points;
  for (std::size_t q = 0; q < kVolumePoints; ++q) {
    const std::size_t at = kShearPoints + q;
    points[q] = {places[at][0], places[at][1], gradientAt(points_[element][at], local)};
  }
  return points;
}

Balance PressModel::evaluate(const Eigen::VectorXd& displacement, double depth_mm, Tangent tangent) {
  Balance balance;
  matrix_.clear();
  residual_.setZero();
  QuadAnswer answer;
  for (std::size_t element = 0; element < mesh_.nodes.size(); ++element) {
    const std::array<int, 8>& nodes = mesh_.nodes[element];
    const QuadVector local = ofElement(displacement, element);
    const int lump = lump_law_of_.empty() ? -1 : lump_law_of_[element];
    if (lump < 0) {
      answerOfQuad(points_[element], laws_[static_cast<std::size_t>(mesh_.layers[element])], local, tangent, answer);
    } else {
      answerOfQuad(points_[element], lump_laws_[static_cast<std::size_t>(lump)], local, tangent, answer);
    }
    if (!(answer.least_j > 0.0)) {
      balance.inverted = static_cast<int>(element);
      return balance;
    }
    balance.strain_energy += answer.energy;
    for (std::size_t i = 0; i < kQuadFreedoms; ++i) {
      const int freedom = mesh_.freedoms[static_cast<std::size_t>(nodes[i / 2])][i % 2];
      if (freedom != kHeld) residual_[freedom] += answer.forces[i];
    }
    matrix_.add(element, answer.stiffness);
  }
  sphere_.depth_mm = depth_mm;
  const ContactSum contact =
      addContact(mesh_, sphere_, displacement, tangent, [&](const std::array<int, 3>& edge, const EdgeAnswer& touch) {
        for (std::size_t i = 0; i < 6; ++i) {
          const int freedom = mesh_.freedoms[static_cast<std::size_t>(edge[i / 2])][i % 2];
          if (freedom != kHeld) residual_[freedom] += touch.forces[i];
        }
        matrix_.add(edge, touch);
      });
  balance.contact_energy = contact.energy;
  balance.force_mn = contact.force_mn;
  balance.contact_radius_mm = contact.radius_mm;
  return balance;
}

Eigen::VectorXd PressModel::moved(const Eigen::VectorXd& displacement, const Eigen::VectorXd& step,
                                  double share) const {
  Eigen::VectorXd result = displacement;
  for (std::size_t n = 0; n < mesh_.freedoms.size(); ++n) {
    for (std::size_t i = 0; i < 2; ++i) {
      const int freedom = mesh_.freedoms[n][i];
      if (freedom != kHeld) result[static_cast<Eigen::Index>(2 * n + i)] += share * step[freedom];
    }
  }
  return result;
}

std::string PressModel::placeOfFreedom(Eigen::Index freedom) const {
  for (std::size_t element = 0; element < mesh_.nodes.size(); ++element) {
    for (const int node : mesh_.nodes[element]) {
      const auto n = static_cast<std::size_t>(node);
      if (std::ranges::count(mesh_.freedoms[n], static_cast<int>(freedom)) == 0) continue;
      return describePlace(mesh_.r[n], mesh_.z[n], mesh_.layers[element]);
    }
  }
  return {};
}

std::string PressModel::placeOfElement(int element) const {
  const auto e = static_cast<std::size_t>(element);
  const auto& nodes = mesh_.nodes[e];
  return describePlace(mesh_.r[static_cast<std::size_t>(nodes[4])], mesh_.z[static_cast<std::size_t>(nodes[5])],
                       mesh_.layers[e]);
}

std::string PressModel::describePlace(double r, double z, int layer) const {
  const std::string& name = layer_names_[static_cast<std::size_t>(layer)];
  const std::string shown = name.empty() ? fmt::format("layer {}", layer + 1) : "the " + name;
  return fmt::format("{:.1f} mm from the axis and {:.1f} mm deep at rest, in {}", r, mesh_.height() - z, shown);
}

}  // namespace palpate::elements
