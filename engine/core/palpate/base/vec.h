// Small vectors and index types used everywhere.
//
// Millimetre, newton, second and N/mm everywhere inside; radian for angles. Body frame: x to the patient's right seen
// from behind, y cranial, z dorsal (out of the back).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <numbers>

namespace palpate {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Box3 = Eigen::AlignedBox3d;  ///< mm; empty: low > high

/// Index of a vertex or a triangle. 32 bit: four billion elements are beyond any mesh this engine is meant for.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xffffffffu;

/// Files and people speak in degrees, the engine in radians.
inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// Three vertex indices, counter-clockwise seen from outside (from the side a finger comes from).
using Triangle = std::array<Index, 3>;

}  // namespace palpate
