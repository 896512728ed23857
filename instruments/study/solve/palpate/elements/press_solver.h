// A rigid sphere pressed into layers over bone, deeper and deeper: the table of the skin's shape and force.
//
// Axisymmetric, finite strain, without friction. Depth grows by steps that adapt to how hard the last one was; each
// starts from the motion extrapolated from the two before. Units outside: mm, N, kPa, mJ.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/elements/inclusion.h"
#include "palpate/elements/quad_mesh.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

struct PressSettings {
  double indenter_radius_mm = 8.0;
  std::vector<double> depths_mm = {2.0, 4.0, 6.0, 8.0, 10.0};  ///< increasing, > 0
  double radius_mm = 150.0;                                    ///< radius of the disc; its rim is held
  double fineness = 1.0;                                       ///< 2: elements half as large
  double contact_kpa_per_mm = 1500.0;                          ///< stiffness of the springs that model a rigid sphere
  double first_step_mm = 0.25;
  double longest_step_mm = 1.0;
  /// 0: the base is a plane. Otherwise the layers lie over the round top of a post of bone this wide, and the deepest
  /// continues around it, 30 mm farther down.
  double bone_radius_mm = 0.0;
  bool bone_flat_top = false;  ///< the post's top is flat
  /// Presses whose field the table gets (tissue::PressField), increasing; none: no field. Needs a plane base.
  std::vector<double> field_depths_mm = {};
  /// A lump under the axis. Its table has no field.
  std::optional<Inclusion> lump = {};
};

/// Depths of a field up to the deepest press that is requested: half a millimetre apart for light presses, one for
/// deeper ones; 8 to 16 of them where the deepest is 4 mm or more. The first always.
std::vector<double> fieldDepths(double deepest_mm);

/// The mesh for a sphere: fine as far as the skin can touch.
MeshFineness finenessFor(const PressSettings& settings);

/// Throws Error for what makes no sense: depths that do not increase or reach the base, sizes out of range.
void check(const tissue::LayerStack& stack, const PressSettings& settings);

/// One equilibrium on the way.
struct PressStep {
  double depth_mm = 0.0;
  double force_n = 0.0;
  double energy_mj = 0.0;  ///< stored, in tissue and contact
  int systems = 0;         ///< systems of equations solved
};

struct PressSolution {
  tissue::LayeredTable table;    ///< holds the depths that were reached, and the deepest where some were not
  double converged_to_mm = 0.0;  ///< deepest equilibrium
  std::string stopped_by;        ///< obstacle to a deeper press; empty: all depths were reached
  std::vector<PressStep> path;
  /// One per shape of the table: kPa, means over rings of 1 mm from the middle, seen along the axis.
  std::vector<std::vector<double>> ring_pressures_kpa;
  double work_mj = 0.0;  ///< work of the sphere, from force and depth; as much as is stored, but for the path's steps
  double seconds = 0.0;
};

/// `stop` ends it with the depths so far; may be empty.
PressSolution solvePress(const tissue::LayerStack& stack, const PressSettings& settings, const Progress& progress = {},
                         const std::function<bool()>& stop = {});

/// 121 radii, dense near the axis, to 120 mm or four fifths of the disc.
std::vector<double> tableRadii(double disc_radius_mm);

}  // namespace palpate::elements
