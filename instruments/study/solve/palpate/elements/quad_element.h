// An 8-node element of revolution: energy, forces on its nodes and their exact derivatives under any displacement.
//
// The shear part of the law is added up over 3 x 3 points and the volume part over 2 x 2: with 2 x 2 points for both,
// zigzags between a soft and a stiff layer cost nothing, and a deep press falls into them (soft fat under thin skin at
// 9 to 10 mm); with 3 x 3 for both, nearly incompressible tissue locks.
#pragma once

#include <array>
#include <cstddef>

#include "palpate/elements/neo_hookean.h"
#include "palpate/elements/quad_mesh.h"

namespace palpate::elements {

inline constexpr std::size_t kQuadNodes = 8;
inline constexpr std::size_t kQuadFreedoms = 2 * kQuadNodes;
/// Entries on and below the diagonal, row by row.
inline constexpr std::size_t kQuadEntries = kQuadFreedoms * (kQuadFreedoms + 1) / 2;

/// Point of an element at which the law is evaluated.
struct QuadPoint {
  // Contribution of each node's displacement to the gradient:
  std::array<double, kQuadNodes> along_r{};
  std::array<double, kQuadNodes> along_z{};
  std::array<double, kQuadNodes> hoop{};
  double volume = 0.0;  ///< volume around it, mm^3, all the way round
};

inline constexpr std::size_t kShearPoints = 9;
inline constexpr std::size_t kVolumePoints = 4;
inline constexpr std::size_t kQuadPoints = kShearPoints + kVolumePoints;

/// Points of one element, those of shear first.
using QuadPoints = std::array<QuadPoint, kQuadPoints>;
QuadPoints quadPoints(const QuadMesh& mesh, std::size_t element);

/// u_r and u_z of its nodes in turn, mm.
using QuadVector = std::array<double, kQuadFreedoms>;

struct QuadAnswer {
  double energy = 0.0;   ///< uJ
  double least_j = 0.0;  ///< smallest det F at its points; <= 0: turned inside out, and the rest is not filled in
  QuadVector forces{};   ///< mN
  std::array<double, kQuadEntries> stiffness{};
};

/// Exact, or `convex`: the nearest tangent without negative eigenvalues at any point, with which a Newton step goes
/// downhill wherever it starts.
enum class Tangent { exact, convex };

void answerOfQuad(const QuadPoints& points, const NeoHookean& law, const QuadVector& displacement, Tangent tangent,
                  QuadAnswer& answer);
/// The same with a law of its own at each point.
using QuadLaws = std::array<NeoHookean, kQuadPoints>;
void answerOfQuad(const QuadPoints& points, const QuadLaws& laws, const QuadVector& displacement, Tangent tangent,
                  QuadAnswer& answer);

Gradient gradientAt(const QuadPoint& point, const QuadVector& displacement);
/// Where each point is at rest: r, z.
std::array<std::array<double, 2>, kQuadPoints> quadPlaces(const QuadMesh& mesh, std::size_t element);

/// Shape functions at a point between the ends of an edge of the surface, s from -1 to 1.
std::array<double, 3> edgeShape(double s);

}  // namespace palpate::elements
