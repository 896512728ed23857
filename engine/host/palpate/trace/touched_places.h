// Where fingers were on a body, how long and how hard: places of a recording, and the body's surface that they reach.
//
//   samples ─► PlaceCollector ─ a few thousand TouchedPlaces ─┐
//                                    skin of the built world ─┴─► touchedSurface ─► maps, area that was touched
//
// A place is a cell of space, so an hour needs no more memory than the skin has room for.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"
#include "palpate/trace/sample.h"

namespace palpate::trace {

/// Edge of a cell: a quarter of a fingertip's radius.
inline constexpr double kPlaceCellMm = 2.0;

/// All ticks in which a finger's proxy lay in one cell and on one triangle.
struct TouchedPlace {
  std::uint32_t world = 0;
  std::uint32_t finger = 0;
  Index triangle = kNoIndex;  ///< of the world's skin
  Vec3 place = Vec3::Zero();  ///< their mean, mm
  std::uint64_t ticks = 0;
  double peak_force_n = 0.0;
};

class PlaceCollector {
 public:
  static constexpr std::size_t kMaxPlaces = std::size_t{1} << 19;

  /// Ticks without contact are left out.
  void add(const Sample& sample);
  /// By world, finger, triangle, cell.
  std::vector<TouchedPlace> places() const;
  /// Ticks whose place found no room or is not a plausible number.
  std::uint64_t leftOut() const { return left_out_; }

 private:
  using Key = std::array<std::int64_t, 6>;  ///< world, finger, triangle, cell
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  struct Cell {
    Vec3 sum = Vec3::Zero();
    std::uint64_t ticks = 0;
    double peak_force_n = 0.0;
  };
  std::unordered_map<Key, Cell, KeyHash> cells_;
  std::uint64_t left_out_ = 0;
};

/// A point finger reaches as far as this: one cell.
inline constexpr double kMinReachMm = kPlaceCellMm;
/// Skin whose normal leans less than 60 degrees from straight out of the back is the back: flanks that face sideways
/// and the tops of the shoulders are not.
inline constexpr double kDorsalNormalZ = 0.5;

/// The skin with what was felt on it, a triangle each. Triangles near touched places are cut so small that the edge of
/// what was touched is a round one on a coarse mesh too.
struct TouchedSurface {
  mesh::TriangleMesh mesh;
  std::vector<double> ticks;  ///< fingers together; 0: not touched
  std::vector<double> peak_force_n;
  double touched_mm2 = 0.0;
  double dorsal_mm2 = 0.0;          ///< of the back (kDorsalNormalZ)
  double touched_dorsal_mm2 = 0.0;  ///< of the back, touched
  std::uint64_t astray_ticks = 0;   ///< of places that lie on no triangle of this skin
};

/// A place touches what lies within the reach of its finger and faces the same way. `reach_mm`: the radius of each
/// finger; at least kMinReachMm is taken. The skin must have a triangle.
TouchedSurface touchedSurface(const mesh::TriangleMesh& skin, std::span<const TouchedPlace> places,
                              std::span<const double> reach_mm);

}  // namespace palpate::trace
