#include "palpate/elements/press_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/elements/equilibrium.h"
#include "palpate/elements/field_sampler.h"
#include "palpate/elements/press_model.h"

namespace palpate::elements {

namespace {

/// Equilibria by depth, each started from those before.
class PressPath {
 public:
  PressPath(PressModel& model, const PressSettings& settings)
      : model_(model), settings_(settings), step_mm_(settings.first_step_mm), last_(model.atRest()), before_(last_) {}

  double depth() const { return depth_mm_; }
  const Balance& balance() const { return balance_; }
  const Eigen::VectorXd& displacement() const { return last_; }
  const std::vector<PressStep>& steps() const { return steps_; }
  const std::string& trouble() const { return trouble_; }

  /// One step towards a depth; false: it went no further, see trouble().
  bool stepTowards(double target_mm) {
    while (true) {
      const double depth = nextDepth(target_mm);
      Equilibrium found = settle(model_, extrapolated(depth), depth, {});
      if (!found.balance.possible()) found = settle(model_, last_, depth, {});
      if (found.found() && found.balance.force_mn < balance_.force_mn) {
        found.trouble = "the force falls: the tissue gives way";
      }
      if (found.found()) {
        acceptStep(depth, std::move(found));
        return true;
      }
      trouble_ = std::move(found.trouble);
      const double tried = depth - depth_mm_;
      if (tried <= kMinStepShare * settings_.indenter_radius_mm) return false;
      step_mm_ = 0.5 * tried;
      steady_ = 0;
    }
  }

 private:
  static constexpr double kMinStepShare = 0.003;  // share of the sphere's radius

  /// Lands on the target instead of just before it.
  double nextDepth(double target_mm) const {
    const double left = target_mm - depth_mm_;
    return left <= 1.25 * step_mm_ ? target_mm : depth_mm_ + std::min(step_mm_, 0.5 * left);
  }

  Eigen::VectorXd extrapolated(double depth) const {
    if (depth_mm_ <= 0.0) return last_;
    return last_ + (last_ - before_) * ((depth - depth_mm_) / (depth_mm_ - before_mm_));
  }

  void acceptStep(double depth, Equilibrium found) {
    constexpr int kEasy = 6;  // systems
    constexpr int kHard = 10;
    const double taken = depth - depth_mm_;
    before_ = std::exchange(last_, std::move(found.displacement));
    before_mm_ = std::exchange(depth_mm_, depth);
    balance_ = found.balance;
    steps_.push_back({depth, 1e-3 * balance_.force_mn, 1e-3 * balance_.energy(), found.systems});
    ++steady_;
    if (found.systems <= kEasy && steady_ >= 2) step_mm_ = std::max(step_mm_, 1.3 * taken);
    if (found.systems >= kHard) step_mm_ *= 0.7;
    step_mm_ = std::min(step_mm_, settings_.longest_step_mm);
  }

  PressModel& model_;
  const PressSettings& settings_;
  double step_mm_;
  int steady_ = 1;  ///< steps since one failed
  Eigen::VectorXd last_;
  Eigen::VectorXd before_;
  double depth_mm_ = 0.0;
  double before_mm_ = 0.0;
  Balance balance_;
  std::vector<PressStep> steps_;
  std::string trouble_;
};

struct Pair {
  double down = 0.0;
  double outward = 0.0;
};

/// Point of the surface, by the shape functions of its edges.
Pair surfaceAt(const QuadMesh& mesh, const Eigen::VectorXd& displacement, double r) {
  const auto after = std::upper_bound(mesh.columns.begin() + 1, mesh.columns.end() - 1, r);
  const auto edge = static_cast<std::size_t>(after - mesh.columns.begin()) - 1;
  const double s = 2.0 * (r - mesh.columns[edge]) / (mesh.columns[edge + 1] - mesh.columns[edge]) - 1.0;
  const std::array<double, 3> shape = edgeShape(s);
  Pair moved;
  for (std::size_t a = 0; a < 3; ++a) {
    const int node = mesh.surface[edge][a];
    moved.outward += shape[a] * displacement[2 * node];
    moved.down -= shape[a] * displacement[2 * node + 1];
  }
  return moved;
}

tissue::PressedShape shapeOf(const PressPath& path, const QuadMesh& mesh, const std::vector<double>& radii) {
  tissue::PressedShape shape;
  shape.depth_mm = path.depth();
  shape.surface_mm = surfaceAt(mesh, path.displacement(), 0.0).down;
  shape.force_n = 1e-3 * path.balance().force_mn;
  shape.contact_radius_mm = path.balance().contact_radius_mm;
  for (const double r : radii) {
    const Pair moved = surfaceAt(mesh, path.displacement(), r);
    shape.down.push_back(moved.down / shape.surface_mm);
    shape.outward.push_back(moved.outward / shape.surface_mm);
  }
  return shape;
}

/// Integral of the force over the depth, which between two steps is close to a power of it.
double computeWork(const std::vector<PressStep>& steps) {
  double work = 0.0;
  double depth = 0.0;
  double force = 0.0;
  for (const PressStep& step : steps) {
    constexpr double kFirstPower = 1.5;
    const bool first = !(depth > 0.0);
    const double power = first ? kFirstPower : std::log(step.force_n / force) / std::log(step.depth_mm / depth);
    work += (step.force_n * step.depth_mm - force * depth) / (power + 1.0);
    depth = step.depth_mm;
    force = step.force_n;
  }
  return work;
}

/// Last of depths that must increase from above 0; 0 for an empty list.
double checkedLastDepth(const std::vector<double>& depths) {
  double before = 0.0;
  for (const double depth : depths) {
    if (!(depth > before))
      throw Error(fmt::format("depths must increase from above 0: {:g} after {:g}", depth, before));
    before = depth;
  }
  return before;
}

}  // namespace

std::vector<double> fieldDepths(double deepest_mm) {
  std::vector<double> depths = {0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 14.0, 16.0};
  std::erase_if(depths, [&](double depth) { return depth > std::max(deepest_mm, depths.front()); });
  return depths;
}

MeshFineness finenessFor(const PressSettings& settings) {
  const double radius = settings.indenter_radius_mm;
  return {.columns = {.first_mm = 0.0875 * radius / settings.fineness,
                      .uniform_to_mm = 1.75 * radius,
                      .growth = 1.0 + 0.12 / settings.fineness,
                      .widest_mm = 8.0 / settings.fineness,
                      .to_mm = settings.radius_mm},
          .rows = {.first_mm = 0.125 * radius / settings.fineness,
                   .fewest = static_cast<int>(std::ceil(2.0 * settings.fineness)),
                   .most = static_cast<int>(std::ceil(14.0 * settings.fineness))}};
}

void check(const tissue::LayerStack& stack, const PressSettings& settings) {
  tissue::check(stack);
  checkSize("the indenter's radius (mm)", settings.indenter_radius_mm, 0.5, 100.0);
  checkSize("the disc's radius (mm)", settings.radius_mm, 4.0 * settings.indenter_radius_mm, 2000.0);
  checkSize("the mesh's fineness", settings.fineness, 0.5, 8.0);
  checkSize("the contact's stiffness in kPa/mm", settings.contact_kpa_per_mm, 1.0, 1e7);
  checkSize("the bone's radius (mm)", settings.bone_radius_mm, 0.0, 100.0);
  checkSize("the first step (mm)", settings.first_step_mm, 1e-3, 5.0);
  checkSize("the longest step (mm)", settings.longest_step_mm, 1e-3, 10.0);
  if (settings.depths_mm.empty()) throw Error("no depths to solve; give at least one");
  const double before = checkedLastDepth(settings.depths_mm);
  const double field = checkedLastDepth(settings.field_depths_mm);
  if (field > 0.0 && settings.bone_radius_mm > 0.0) throw Error("a field needs a plane bone, not a post");
  if (settings.lump) {
    check(*settings.lump, stack);
    if (settings.bone_radius_mm > 0.0) throw Error("a lump needs a plane bone, not a post");
    if (field > 0.0) throw Error("a field cannot be solved with a lump; choose one of the two");
  }
  const double total = tissue::totalThickness(stack);
  const double deepest = std::max(before, field);
  if (deepest < total) return;
  throw Error(
      fmt::format("a depth of {:g} mm reaches the bone; the layers are {:g} mm thick in total", deepest, total));
}

std::vector<double> tableRadii(double disc_radius_mm) {
  constexpr int kEven = 40;
  constexpr int kGrowing = 80;
  constexpr double kStep = 0.5;
  const double to = std::min(120.0, 0.8 * disc_radius_mm);
  const double scale = to / 120.0;
  constexpr double kGrowth = 1.01942;  // 80 steps from 20 to 120 mm, about
  std::vector<double> radii;
  for (int i = 0; i <= kEven; ++i) radii.push_back(scale * kStep * i);
  double step = kStep;
  for (int i = 0; i < kGrowing; ++i) {
    step *= kGrowth;
    radii.push_back(radii.back() + scale * step);
  }
  const double from = scale * kStep * kEven;
  const double fit = (to - from) / (radii.back() - from);
  for (std::size_t i = kEven + 1; i < radii.size(); ++i) {
    radii[i] = 0.001 * std::round(1000.0 * (from + fit * (radii[i] - from)));
  }
  return radii;
}

namespace {

tissue::LayerStack withTissueBesideBone(tissue::LayerStack stack, double bone_radius_mm) {
  constexpr double kBesideMm = 30.0;
  if (!(bone_radius_mm > 0.0)) return stack;
  stack.layers.push_back(stack.layers.back());
  stack.layers.back().thickness_mm = kBesideMm;
  return stack;
}

MeshFineness meshFor(const tissue::LayerStack& stack, const PressSettings& settings) {
  MeshFineness mesh = finenessFor(settings);
  mesh.bone = {.cover_mm = tissue::totalThickness(stack),
               .radius_mm = settings.bone_radius_mm,
               .flat_top = settings.bone_flat_top};
  mesh.lump = settings.lump;
  return mesh;
}

}  // namespace

namespace {

/// Depths of shapes and of fields.
std::vector<double> allDepths(const PressSettings& settings) {
  std::vector<double> depths;
  std::ranges::set_union(settings.depths_mm, settings.field_depths_mm, std::back_inserter(depths));
  return depths;
}

}  // namespace

PressSolution solvePress(const tissue::LayerStack& stack, const PressSettings& settings, const Progress& progress,
                         const std::function<bool()>& stop) {
  check(stack, settings);
  const auto start = Clock::now();
  PressModel model(withTissueBesideBone(stack, settings.bone_radius_mm), meshFor(stack, settings),
                   settings.indenter_radius_mm, settings.contact_kpa_per_mm);
  PressPath path(model, settings);
  PressSolution solution;
  tissue::LayeredTable& table = solution.table;
  table.stack = stack;
  table.indenter_radius_mm = settings.indenter_radius_mm;
  table.radii_mm = tableRadii(settings.radius_mm);
  const auto note = [&] {
    table.shapes.push_back(shapeOf(path, model.mesh(), table.radii_mm));
    constexpr double kRingMm = 1.0;
    solution.ring_pressures_kpa.push_back(
        ringPressures(contactRings(model.mesh(), model.sphereAt(path.depth()), path.displacement()), kRingMm));
  };
  std::optional<FieldSampler> sampler;
  if (!settings.field_depths_mm.empty()) sampler.emplace(model, stack);
  const std::vector<double> depths = allDepths(settings);
  for (const double target : depths) {
    while (path.depth() < target && solution.stopped_by.empty()) {
      report(progress, "pressing", path.depth() / depths.back());
      if (stop && stop()) {
        solution.stopped_by = "asked to stop";
      } else if (!path.stepTowards(target)) {
        solution.stopped_by = path.trouble();
      }
    }
    if (path.depth() < target) break;
    if (std::ranges::binary_search(settings.depths_mm, target)) note();
    if (std::ranges::binary_search(settings.field_depths_mm, target)) sampler->add(target, path.displacement());
  }
  if (sampler && path.depth() >= settings.field_depths_mm.front()) table.field = sampler->field();
  if (!solution.stopped_by.empty() && path.depth() > 0.0) {
    if (table.shapes.empty() || path.depth() > table.shapes.back().depth_mm) note();
  }
  solution.converged_to_mm = path.depth();
  solution.path = path.steps();
  solution.work_mj = computeWork(solution.path);
  solution.seconds = secondsSince(start);
  return solution;
}

}  // namespace palpate::elements
