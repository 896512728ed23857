// Tissue under the sphere at one depth: energy, residual forces and tangent of any displacement of its nodes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "palpate/elements/quad_element.h"
#include "palpate/elements/quad_mesh.h"
#include "palpate/elements/sphere_contact.h"
#include "palpate/elements/stiffness_matrix.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

/// A displacement that turns an element inside out has no energy: `inverted` names it, and nothing else is filled in.
struct Balance {
  double strain_energy = 0.0;   ///< uJ
  double contact_energy = 0.0;  ///< uJ, in the springs that model a rigid sphere
  double force_mn = 0.0;
  double contact_radius_mm = 0.0;
  int inverted = -1;

  bool possible() const { return inverted < 0; }
  double energy() const { return strain_energy + contact_energy; }
};

class PressModel {
 public:
  PressModel(const tissue::LayerStack& stack, const MeshFineness& fineness, double indenter_radius_mm,
             double contact_kpa_per_mm);
  PressModel(const PressModel&) = delete;
  PressModel& operator=(const PressModel&) = delete;

  const QuadMesh& mesh() const { return mesh_; }
  /// The sphere that presses so deep.
  Sphere sphereAt(double depth_mm) const {
    Sphere sphere = sphere_;
    sphere.depth_mm = depth_mm;
    return sphere;
  }
  /// r, z at rest and the gradient there of the four points that an element's volume is added up over.
  struct VolumePoint {
    double r = 0.0;
    double z = 0.0;
    Gradient gradient{};
  };
  std::array<VolumePoint, kVolumePoints> volumePoints(const Eigen::VectorXd& displacement, std::size_t element) const;

  /// u_r, u_z of every node, nothing moved.
  Eigen::VectorXd atRest() const { return Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(mesh_.r.size())); }

  /// Also fills in the residual and the tangent.
  Balance evaluate(const Eigen::VectorXd& displacement, double depth_mm, Tangent tangent);
  /// Gradient of the energy in the free displacements, mN; 0 in equilibrium.
  const Eigen::VectorXd& residual() const { return residual_; }
  StiffnessMatrix& tangent() { return matrix_; }

  /// `step` on the freedoms, added to a displacement of the nodes.
  Eigen::VectorXd moved(const Eigen::VectorXd& displacement, const Eigen::VectorXd& step, double share) const;

  /// "r 4.2 mm, 1.3 mm deep, in the fat": where a freedom or an element is at rest, for messages.
  std::string placeOfFreedom(Eigen::Index freedom) const;
  std::string placeOfElement(int element) const;

 private:
  QuadVector ofElement(const Eigen::VectorXd& displacement, std::size_t element) const;
  void hardenLump(const tissue::LayerStack& stack, const Inclusion& lump);
  std::string describePlace(double r, double z, int layer) const;

  QuadMesh mesh_;
  std::vector<NeoHookean> laws_;  ///< one per layer
  std::vector<std::string> layer_names_;
  Sphere sphere_;
  std::vector<QuadPoints> points_;   ///< an element each
  std::vector<QuadLaws> lump_laws_;  ///< for the elements that a lump is in
  std::vector<int> lump_law_of_;     ///< an element each: place in `lump_laws_`, or -1; empty without lump
  StiffnessMatrix matrix_;
  Eigen::VectorXd residual_;
};

}  // namespace palpate::elements
