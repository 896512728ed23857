// Springs of the grid and their relaxation.
#include "dissertation/rivals/mass_spring.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

namespace palpate::study {

namespace {

// Shares of E V / L^2 that one cell gives a spring along its edge and across its face: with all cells alike the
// stiffness is 0.4 E L of an edge, and the same across a face, which makes a grid of cubes isotropic (C1111 = 3 C1122).
constexpr double kEdgeShare = 0.1;
constexpr double kFaceShare = 0.4;

// Share of the sum of a node's stiffnesses: a step of 1 is stable from 0.5 on.
constexpr double kMassShare = 0.6;

}  // namespace

MassSpring::MassSpring(const TissueBlock& block) : block_(block), masses_(block.nodes(), 0.0) {
  std::map<std::pair<Index, Index>, double> stiffness_of;
  for (int k = 0; k < block.rows(); ++k) {
    const double energy = block.rowModulus(k) * block.spacing() * block.spacing() * block.rowHeight(k);
    for (int j = 0; j < block.cells(); ++j) {
      for (int i = 0; i < block.cells(); ++i) {
        const auto corner = [&](int c) { return static_cast<Index>(block.node(i + c % 2, j + c / 2 % 2, k + c / 4)); };
        for (int a = 0; a < 8; ++a) {
          for (int b = a + 1; b < 8; ++b) {
            const int apart = std::popcount(static_cast<unsigned>(a ^ b));
            if (apart == 3) continue;
            const double length2 = (block.place(corner(a)) - block.place(corner(b))).squaredNorm();
            stiffness_of[{corner(a), corner(b)}] += (apart == 1 ? kEdgeShare : kFaceShare) * energy / length2;
          }
        }
      }
    }
  }
  for (const auto& [ends, stiffness] : stiffness_of) {
    const Vec3 along = (block.place(ends.second) - block.place(ends.first)).normalized();
    springs_.push_back({ends.first, ends.second, std::sqrt(stiffness) * along});
    masses_[ends.first] += kMassShare * stiffness;
    masses_[ends.second] += kMassShare * stiffness;
  }
}

void MassSpring::addForces() {
  std::fill(forces_.begin(), forces_.end(), Vec3::Zero());
  for (const Spring& spring : springs_) {
    const Vec3 pull = spring.along.dot(displacements_[spring.to] - displacements_[spring.from]) * spring.along;
    forces_[spring.from] += pull;
    forces_[spring.to] -= pull;
  }
}

// The kinetic energy after the step. From standstill the first half of a step is not walked: leap-frog, which grows
// otherwise.
double MassSpring::moveAll(bool from_standstill) {
  const double time = from_standstill ? 0.5 : 1.0;
  double energy = 0.0;
  for (std::size_t n = 0; n < displacements_.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      if (block_.isFixed(n, axis)) continue;
      velocities_[n][axis] += time * forces_[n][axis] / masses_[n];
      displacements_[n][axis] += velocities_[n][axis];
    }
    energy += masses_[n] * velocities_[n].squaredNorm();
  }
  return energy;
}

// Nodes of the skin that came into the ball go straight down onto it, without friction; the force that it takes.
double MassSpring::holdOutOfBall(double central_depth_mm) {
  const std::size_t top = block_.firstTopNode();
  double force = 0.0;
  for (std::size_t v = 0; v < touched_.size(); ++v) {
    const double depth = ballDepth(block_.place(top + v).head<2>().norm(), central_depth_mm);
    double& height = displacements_[top + v].z();
    touched_[v] = depth > 0.0 && height >= -depth;
    if (!touched_[v]) continue;
    height = -depth;
    velocities_[top + v].z() = 0.0;
    force += forces_[top + v].z();
  }
  return force;
}

double MassSpring::restlessForce() const {
  double most = 0.0;
  for (std::size_t n = 0; n < forces_.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool held = n >= block_.firstTopNode() && axis == 2 && touched_[n - block_.firstTopNode()];
      if (!held && !block_.isFixed(n, axis)) most = std::max(most, std::abs(forces_[n][axis]));
    }
  }
  return most;
}

PressedSurface MassSpring::press(double central_depth_mm) {
  displacements_.assign(block_.nodes(), Vec3::Zero());
  velocities_.assign(block_.nodes(), Vec3::Zero());
  forces_.assign(block_.nodes(), Vec3::Zero());
  touched_.assign(block_.nodesOfALevel(), false);
  constexpr int kMaxSteps = 5000;
  constexpr double kAtRest = 1e-3;
  double force = holdOutOfBall(central_depth_mm);
  double energy = 0.0;
  bool stopped = true;
  for (steps_ = 1; steps_ < kMaxSteps; ++steps_) {
    addForces();
    const double moving = moveAll(stopped);
    force = holdOutOfBall(central_depth_mm);
    stopped = moving < energy;
    if (stopped) std::fill(velocities_.begin(), velocities_.end(), Vec3::Zero());
    energy = stopped ? 0.0 : moving;
    if (restlessForce() < kAtRest * force) break;
  }
  const auto top = static_cast<std::ptrdiff_t>(block_.firstTopNode());
  return {.displacements = {displacements_.begin() + top, displacements_.end()}, .force_n = force};
}

std::size_t MassSpring::bytes() const {
  return springs_.size() * sizeof(Spring) + block_.nodes() * (3 * sizeof(Vec3) + sizeof(double));
}

}  // namespace palpate::study
