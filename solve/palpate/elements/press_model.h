// Tissue under the sphere at one depth: energy, residual forces and tangent of any displacement of its nodes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "palpate/elements/quad_element.h"
#include "palpate/elements/quad_mesh.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

// A rigid sphere without friction on the surface's edges: a stiff spring at every point of the skin that lies inside
// it.
//
// Energy 1/2 k gap^2 over the skin's area at rest, with its exact first and second derivatives.

struct Sphere {
  double radius_mm = 8.0;
  double depth_mm = 0.0;  ///< of its lowest point under the surface at rest
  double stiffness_kpa_per_mm = 1500.0;
};

/// On the freedoms of one edge: u_r and u_z of its three nodes in turn.
struct EdgeAnswer {
  std::array<double, 6> forces{};                    ///< mN
  std::array<std::array<double, 6>, 6> stiffness{};  ///< below and on the diagonal
};

/// Of the whole contact.
struct ContactSum {
  double energy = 0.0;    ///< uJ
  double force_mn = 0.0;  ///< along the axis
  /// Of the skin that touches, at rest; 0: nothing touches.
  double radius_mm = 0.0;
};

/// What a narrow ring of the skin carries, seen along the axis.
struct ContactRing {
  double radius_mm = 0.0;  ///< of the pressed skin
  double force_mn = 0.0;   ///< along the axis
};
/// From the middle outwards, about 0.05 mm wide each; those that touch.
std::vector<ContactRing> contactRings(const QuadMesh& mesh, const Sphere& sphere, const Eigen::VectorXd& displacement);

/// Goes over the edges that touch. `displacement`: u_r, u_z of every node.
ContactSum addContact(const QuadMesh& mesh, const Sphere& sphere, const Eigen::VectorXd& displacement, Tangent tangent,
                      const std::function<void(const std::array<int, 3>& nodes, const EdgeAnswer&)>& add);

// The sparse symmetric matrix of a mesh: where the entries of every element lie is found once, and so is the order of
// elimination; each Newton step only fills in and factorises.
//
// Based on: Eigen, SimplicialLDLT with approximate minimum degree; measured beside CHOLMOD in
// docs/explanation/tissue-solver.md.

class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const QuadMesh& mesh);

  void clear();
  void add(std::size_t element, const std::array<double, kQuadEntries>& entries);
  void add(const std::array<int, 3>& edge, const EdgeAnswer& answer);

  /// Returns the number of negative pivots: 0 where the energy is convex, so that every step goes downhill; -1 where
  /// the matrix is singular.
  int factorise();
  /// With the last factors.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return factors_.solve(right); }

  const Eigen::SparseMatrix<double>& lower() const { return lower_; }

 private:
  int placeOf(int row, int column) const;

  const QuadMesh& mesh_;
  Eigen::SparseMatrix<double> lower_;
  std::vector<std::array<int, kQuadEntries>> places_;  ///< in the values of `lower_`; kHeld: nowhere
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors_;
};

/// A displacement that turns an element inside out has no energy: `inverted` says which, and nothing else is filled in.
struct Balance {
  double strain_energy = 0.0;   ///< uJ
  double contact_energy = 0.0;  ///< uJ, of the springs that stand for a rigid sphere
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
  /// Of the energy with the free displacements, mN; 0 in equilibrium.
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
  std::string placeWords(double r, double z, int layer) const;

  QuadMesh mesh_;
  std::vector<NeoHookean> laws_;  ///< a layer each
  std::vector<std::string> layer_names_;
  Sphere sphere_;
  std::vector<QuadPoints> points_;   ///< an element each
  std::vector<QuadLaws> lump_laws_;  ///< of the elements that a lump is in
  std::vector<int> lump_law_of_;     ///< an element each: place in `lump_laws_`, or -1; empty without lump
  StiffnessMatrix matrix_;
  Eigen::VectorXd residual_;
};

// Newton's method on the energy of a press at one depth: every step goes downhill, or there is none.
//
// An equilibrium is a least of the energy. Where the tangent has a negative pivot the step is taken with its convex
// neighbour instead; where that has to be done again and again, the tissue has no equilibrium nearby: it gives way.

struct EquilibriumSettings {
  double tolerance = 1e-5;  ///< residual over the force of the contact
  int most_steps = 30;
};

struct Equilibrium {
  Eigen::VectorXd displacement;
  Balance balance;
  int systems = 0;      ///< that were factorised
  std::string trouble;  ///< why none was found, with the place; empty: found
  bool found() const { return trouble.empty(); }
};

Equilibrium settle(PressModel& model, const Eigen::VectorXd& start, double depth_mm,
                   const EquilibriumSettings& settings);

}  // namespace palpate::elements
