// Load time: some 10 ms a lump and solved stack around its place. What only another lump, or another map, changes is
// taken over from the world before.
#include "palpate/scene/lumps_of_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/scene/solved_lumps.h"
#include "palpate/scene/tissue_of_body.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/library_fields.h"
#include "palpate/tree/closest_on_triangle.h"

namespace palpate::scene {

namespace {

[[noreturn]] void failAt(const LumpSettings& lump, std::size_t line, const std::string& cause) {
  if (line > 0) throw Error::atLine(lump.scene_file, line, cause);
  throw Error(cause);
}

[[noreturn]] void fail(const LumpSettings& lump, const std::string& cause) {
  failAt(lump, lump.line, fmt::format("lump '{}' {}", lump.name, cause));
}

// ---- layers

tissue::LayeredTable tableWithField(const std::filesystem::path& file, std::string_view who) {
  tissue::LayeredTable table = tissue::readLayeredTable(file);
  if (table.field && !table.stack.layers.empty()) return table;
  throw Error(fmt::format("{} has no press field, which {} require; make the table with palpate tissue solve --field",
                          file.string(), who));
}

}  // namespace

struct LumpGround::Solved {
  std::shared_ptr<const tissue::LayeredTissue> layers;
  std::optional<tissue::LayeredTable> table;  ///< none: the library's stacks
  double fat_mm = 0.0;
};

LumpGround::LumpGround(const Scene& scene, const HealthyTissue& healthy, bool layered, std::string_view who) {
  auto solved = std::make_unique<Solved>();
  solved->fat_mm = fatOf(scene);
  if (!scene.tissue.layer_table.empty()) {
    solved->table = tableWithField(scene.tissue.layer_table, who);
    solved->layers =
        std::make_shared<const tissue::LayeredTissue>(std::vector<tissue::LayeredNode>{tissue::nodeOf(*solved->table)});
  } else if (layered && healthy.tissue.layered) {
    solved->layers = healthy.tissue.layered;
  } else {
    throw Error(fmt::format("{} require layered tissue; set [tissue] layer_table", who));
  }
  solved_ = std::move(solved);
}

LumpGround::~LumpGround() = default;

tissue::LayerStack LumpGround::stackAt(double thickness_mm) const {
  return solved_->table ? solved_->table->stack : tissue::placeStack(thickness_mm, solved_->fat_mm);
}

std::vector<tissue::WeightedField> LumpGround::fieldsAt(double thickness_mm) const {
  if (solved_->table) return {{&solved_->table->stack, &*solved_->table->field, 1.0}};
  return tissue::libraryFieldsAt(thickness_mm, solved_->fat_mm);
}

double LumpGround::secantAt(double thickness_mm) const {
  return solved_->layers->secantAt(thickness_mm, tissue::kReferenceDepthMm);
}

double LumpGround::thickest() const {
  return solved_->table ? tissue::totalThickness(solved_->table->stack) : solved_->layers->thickest();
}

std::vector<double> LumpGround::thicknesses() const {
  if (solved_->table) return {tissue::totalThickness(solved_->table->stack)};
  const auto all = tissue::libraryThicknesses();
  return {all.begin(), all.end()};
}

std::vector<double> LumpGround::numbers() const {
  if (!solved_->table) return {solved_->fat_mm};
  std::vector<double> numbers;
  for (const tissue::Layer& layer : solved_->table->stack.layers) {
    numbers.insert(numbers.end(), {layer.thickness_mm, layer.young_kpa});
  }
  for (const float root : solved_->table->field->shear) numbers.push_back(root);
  return numbers;
}

namespace {

// ---- one lump

/// The skin over a lump.
struct Foot {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, smooth over facets
  double stiffness_n_per_mm = 0.0;
  double tissue_mm = 0.0;  ///< 0: not known
};

Foot findFoot(const LumpSettings& lump, const LumpBed& bed) {
  const Box3& box = bed.body.box;
  const contact::SurfaceGeometry& geometry = *bed.body.geometry;
  const tree::Crossing hit = tree::firstFrontCrossing(geometry.tree, {lump.x_mm, lump.y_mm, box.max().z() + 1.0},
                                                      {lump.x_mm, lump.y_mm, box.min().z() - 1.0});
  if (hit.triangle == kNoIndex) {
    fail(lump, fmt::format("has no skin over it at x_mm = {}, y_mm = {}", lump.x_mm, lump.y_mm));
  }
  const tree::TriangleRecord& record = geometry.tree.records[hit.triangle];
  const Vec3 weights = tree::barycentricWeights(record.corners, hit.point);
  Foot foot{.point = hit.point, .normal = Vec3::Zero()};
  for (int i = 0; i < 3; ++i) foot.normal += weights[i] * geometry.vertex_normals[record.vertices[i]];
  foot.normal.normalize();
  const contact::SkinHere here = contact::skinAt(bed.surface, {hit.point, hit.triangle, tree::Feature::face});
  foot.stiffness_n_per_mm = here.stiffness_n_per_mm;
  foot.tissue_mm = thicknessOverBone(bed.healthy, record, hit.point);
  return foot;
}

tissue::LumpShape shapeOf(const LumpSettings& lump) {
  const Vec3 half = lump.halfAxes();
  tissue::LumpShape shape{.half_axes_mm = {half.x(), half.y(), half.z()}, .depth_mm = lump.depth_mm};
  shape.stiffness_ratio = lump.stiffness_ratio;
  if (lump.young_kpa > 0.0) shape.young_kpa = lump.young_kpa;
  shape.edge = lump.edge;
  return shape;
}

/// Refuses a lump that is not in the tissue between skin and bone.
void requireRoom(const LumpSettings& lump, const tissue::LumpShape& shape, const tissue::LayerStack& stack) {
  if (stack.layers.size() < 2) fail(lump, "needs a skin over another layer");
  const tissue::TopRange tops = tissue::topRange(shape, stack);
  const double bone_mm = tissue::totalThickness(stack);
  constexpr double kLeftOverBoneMm = 1.0;
  if (shape.depth_mm < tops.from_mm) {
    const std::string range =
        tops.to_mm >= tops.from_mm
            ? fmt::format("here {:.1f} to {:.1f} mm", tops.from_mm, tops.to_mm)
            : fmt::format("here from {:.1f} mm on, and the bone is {:.1f} mm deep", tops.from_mm, bone_mm);
    failAt(lump, lump.depth_line > 0 ? lump.depth_line : lump.line,
           fmt::format(
               "depth_mm = {} in [[lump]] is out of range: the top must be at least 0.5 mm below the skin layer, {}",
               shape.depth_mm, range));
  }
  if (shape.bottomMm() > bone_mm - kLeftOverBoneMm) {
    fail(lump,
         fmt::format("reaches the bone: its bottom is at {:.1f} mm, the bone at {:.1f} mm", shape.bottomMm(), bone_mm));
  }
}

double layerKpaAt(const tissue::LayerStack& stack, double depth_mm) {
  double bottom = 0.0;
  for (const tissue::Layer& layer : stack.layers) {
    bottom += layer.thickness_mm;
    if (depth_mm <= bottom) return layer.young_kpa;
  }
  return stack.layers.back().young_kpa;
}

/// The solution with this lump in the mesh. Throws Error if it is not stored and cannot be computed here.
std::vector<SolvedPush> solvedOrFail(const LumpSettings& lump, const tissue::LumpShape& shape,
                                     const tissue::LayerStack& stack) {
  std::optional<std::vector<SolvedPush>> pushes;
  try {
    pushes = solvedPushes(shape, stack);
  } catch (const Error& error) {
    fail(lump, error.what());
  }
  if (pushes) return *std::move(pushes);
  fail(lump, "is not solved yet; for [tissue] lumps = \"solved\" run `palpate lump solve` on this scene first");
}

/// Everything that the table of a lump depends on.
std::vector<double> tableNumbers(const tissue::LumpShape& shape, double thickness_mm, LumpForce force,
                                 const LumpGround& ground) {
  std::vector<double> numbers = ground.numbers();
  numbers.insert(numbers.end(), shape.half_axes_mm.begin(), shape.half_axes_mm.end());
  numbers.insert(numbers.end(), {shape.depth_mm, shape.stiffness_ratio, shape.young_kpa.value_or(0.0), shape.edge,
                                 thickness_mm, static_cast<double>(force)});
  return numbers;
}

const PlacedLump* sameTable(const World* before, const std::vector<double>& numbers) {
  if (before == nullptr) return nullptr;
  for (const auto& lump : before->lumps) {
    if (lump->made_of == numbers) return lump.get();
  }
  return nullptr;
}

contact::LumpMobility makeMobility(const LumpSettings& lump) {
  contact::LumpMobility mobility;
  if (!(lump.mobility_mm_per_n > 0.0)) return mobility;
  mobility.spring_n_per_mm = 1.0 / lump.mobility_mm_per_n;
  mobility.limit_mm = lump.mobility_limit_mm;
  return mobility;
}

tissue::LumpEnergy tableOf(const LumpSettings& settings, const tissue::LumpShape& shape,
                           const tissue::LayerStack& stack, double thickness_mm, LumpForce force,
                           const LumpGround& ground) {
  const std::vector<tissue::WeightedField> fields = ground.fieldsAt(thickness_mm);
  const tissue::LumpEnergy table = [&] {
    try {
      return tissue::LumpEnergy(shape, stack, fields);
    } catch (const Error& error) {
      failAt(settings, settings.line, error.what());
    }
  }();
  if (force == LumpForce::table) return table;
  return {shape, stack, fields, correctionOf(solvedOrFail(settings, shape, stack), table)};
}

PlacedLump placed(const LumpSettings& settings, const LumpBed& bed, const LumpGround& ground) {
  const Foot foot = findFoot(settings, bed);
  const double thickness_mm = foot.tissue_mm > 0.0 ? foot.tissue_mm : ground.thickest();
  const tissue::LayerStack stack = ground.stackAt(thickness_mm);
  const tissue::LumpShape shape = shapeOf(settings);
  requireRoom(settings, shape, stack);
  const LumpForce force = bed.scene.tissue.lumps;
  std::vector<double> numbers = tableNumbers(shape, thickness_mm, force, ground);
  const PlacedLump* same = sameTable(bed.before, numbers);
  tissue::LumpEnergy table =
      same != nullptr ? same->unscaled : tableOf(settings, shape, stack, thickness_mm, force, ground);
  const double secant = ground.secantAt(thickness_mm);
  const double factor = secant > 0.0 ? foot.stiffness_n_per_mm / secant : 1.0;
  contact::Lump lump{.foot = foot.point, .axis = foot.normal, .energy = table.scaled(factor), .shape = shape};
  lump.skin_mm = stack.layers.front().thickness_mm;
  lump.mobility = makeMobility(settings);
  contact::setPlane(lump);
  PlacedLump result{.name = settings.name,
                    .settings = settings,
                    .lump = std::move(lump),
                    .thickness_mm = thickness_mm,
                    .note = {},
                    .unscaled = std::move(table),
                    .made_of = std::move(numbers)};
  result.young_kpa = tissue::youngModulus(shape, stack);
  result.layer_kpa = layerKpaAt(stack, shape.centreMm());
  return result;
}

// ---- all of them

std::vector<LumpSettings> named(std::vector<LumpSettings> lumps) {
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    if (lumps[i].name.empty()) lumps[i].name = fmt::format("lump{}", i + 1);
    for (std::size_t k = 0; k < i; ++k) {
      if (lumps[k].name == lumps[i].name) fail(lumps[i], "has the name of another lump");
    }
  }
  return lumps;
}

Vec3 centreOf(const PlacedLump& lump) { return lump.lump.foot - lump.lump.shape.centreMm() * lump.lump.axis; }

/// From the middle to the rim along a direction.
double halfAlong(const PlacedLump& lump, const Vec3& direction) {
  const auto& half = lump.lump.shape.half_axes_mm;
  const double along = direction.dot(lump.lump.axis);
  const double across2 = std::max(0.0, 1.0 - along * along);
  return 1.0 / std::sqrt(across2 / (half[0] * half[0]) + along * along / (half[2] * half[2]));
}

void requireApart(const PlacedLump& one, const PlacedLump& other, std::vector<std::string>& notes) {
  const Vec3 between = centreOf(other) - centreOf(one);
  const double distance = between.norm();
  const Vec3 direction = distance > 0.0 ? Vec3(between / distance) : one.lump.axis;
  const double gap_mm = distance - halfAlong(one, direction) - halfAlong(other, direction);
  if (gap_mm < 0.0) {
    failAt(other.settings, other.settings.line,
           fmt::format("lumps '{}' and '{}' overlap by {:.1f} mm", one.name, other.name, -gap_mm));
  }
  const double larger_mm = std::max(one.lump.shape.radiusMm(), other.lump.shape.radiusMm());
  if (gap_mm >= larger_mm) return;
  notes.push_back(
      fmt::format("lumps '{}' and '{}' are {:.1f} mm apart: their forces are simply added, which can overestimate them "
                  "by up to a third",
                  one.name, other.name, gap_mm));
}

tissue::PressedPlace fingertipAt(const PlacedLump& lump) { return {lump.thickness_mm, tissue::kFingertipMm}; }

/// The factor on a lump's energy that keeps the force right over it, as a fingertip feels it, below the steepest that
/// tissue may be. Where the skin alone is nearly that steep a lump may still add a quarter of it.
double energyLimitFactor(const PlacedLump& placed, double stiffness_n_per_mm, const tissue::ForceLaw& law) {
  constexpr double kStepMm = 0.25;
  constexpr double kAlways = 0.25;
  double factor = 1.0;
  for (double depth = kStepMm; depth <= placed.lump.energy.deepestMm(); depth += kStepMm) {
    const double before = placed.lump.energy.at(0.0, depth - kStepMm).d_depth;
    const double slope = (placed.lump.energy.at(0.0, depth).d_depth - before) / kStepMm;
    const double plain = tissue::tangentStiffness(law, stiffness_n_per_mm, depth, fingertipAt(placed));
    const double room = std::max(tissue::kStiffestTissue - plain, kAlways * plain);
    if (slope > room) factor = std::min(factor, room / slope);
  }
  const double sideways = placed.lump.energy.steepest().rho;
  return sideways > tissue::kStiffestTissue ? std::min(factor, tissue::kStiffestTissue / sideways) : factor;
}

double stiffnessOver(const PlacedLump& placed, const LumpBed& bed) {
  return findFoot(placed.settings, bed).stiffness_n_per_mm;
}

/// One factor for all, so that lumps keep their ratios.
void boundAll(std::vector<PlacedLump>& all, const LumpBed& bed, std::vector<std::string>& notes) {
  double factor = 1.0;
  const PlacedLump* steepest = nullptr;
  for (const PlacedLump& placed : all) {
    const double own = energyLimitFactor(placed, stiffnessOver(placed, bed), bed.surface.force_law);
    if (own < factor) steepest = &placed;
    factor = std::min(factor, own);
  }
  if (steepest == nullptr) return;
  notes.push_back(fmt::format(
      "lumps push with {:.0f} % of their force: over '{}' stiffness would exceed {} N/mm, beyond any stable loop; "
      "make it softer, smaller or deeper",
      100.0 * factor, steepest->name, tissue::kStiffestTissue));
  for (PlacedLump& placed : all) placed.lump.energy = placed.lump.energy.scaled(factor);
}

void describe(PlacedLump& placed, double stiffness_n_per_mm, const tissue::ForceLaw& law) {
  for (std::size_t i = 0; i < kToldDepthsMm.size(); ++i) {
    const double plain = tissue::normalForce(law, stiffness_n_per_mm, kToldDepthsMm[i], fingertipAt(placed));
    const double extra = placed.lump.energy.at(0.0, kToldDepthsMm[i]).d_depth;
    placed.share[i] = plain > 0.0 ? extra / plain : 0.0;
  }
  const LumpSettings& settings = placed.settings;
  const std::string where =
      settings.at.empty() ? fmt::format("({:g}, {:g}) mm", settings.x_mm, settings.y_mm) : settings.at;
  placed.note = fmt::format(
      "lump '{}' at {}: {:.3g} kPa in tissue of {:.3g} kPa, its top {:g} mm deep; right over it the force is {:+.1f}, "
      "{:+.1f} and {:+.1f} % at 3, 5 and 8 mm",
      placed.name, where, placed.young_kpa, placed.layer_kpa, settings.depth_mm, 100.0 * placed.share[0],
      100.0 * placed.share[1], 100.0 * placed.share[2]);
}

void noteSnap(const PlacedLump& placed, std::vector<std::string>& notes) {
  const contact::LumpMobility& mobility = placed.lump.mobility;
  const double snapping = placed.lump.energy.steepest().snapping;
  if (!mobility.moves() || mobility.spring_n_per_mm >= snapping) return;
  notes.push_back(
      fmt::format("lump '{}' jumps sideways under a firm press; mobility_mm_per_n below {:.2g} makes it move smoothly",
                  placed.name, 1.0 / snapping));
}

}  // namespace

std::vector<std::shared_ptr<const PlacedLump>> placedLumps(const LumpBed& bed, std::vector<std::string>& notes) {
  if (bed.scene.lumps.empty()) return {};
  const std::vector<LumpSettings> lumps = named(bed.scene.lumps);
  if (lumps.size() > contact::kMaxLumps) {
    const LumpSettings& beyond = lumps[contact::kMaxLumps];
    failAt(beyond, beyond.line, fmt::format("more than {} [[lump]]", contact::kMaxLumps));
  }
  std::vector<PlacedLump> all;
  try {
    const LumpGround ground(bed.scene, bed.healthy, bed.layered, "lumps");
    for (const LumpSettings& lump : lumps) all.push_back(placed(lump, bed, ground));
  } catch (const Error& error) {
    if (!error.file().empty() || lumps.front().line == 0) throw;
    failAt(lumps.front(), lumps.front().line, error.what());
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) requireApart(all[k], all[i], notes);
  }
  boundAll(all, bed, notes);
  std::vector<std::shared_ptr<const PlacedLump>> result;
  for (PlacedLump& lump : all) {
    describe(lump, stiffnessOver(lump, bed), bed.surface.force_law);
    noteSnap(lump, notes);
    result.push_back(std::make_shared<const PlacedLump>(std::move(lump)));
  }
  return result;
}

std::shared_ptr<const contact::Lumps> feltLumps(const std::vector<std::shared_ptr<const PlacedLump>>& placed) {
  if (placed.empty()) return nullptr;
  contact::Lumps lumps;
  for (const auto& lump : placed) lumps.all.push_back(lump->lump);
  return std::make_shared<const contact::Lumps>(std::move(lumps));
}

std::shared_ptr<const contact::PressureGround> pressureGround(const LumpGround& ground) {
  std::vector<contact::PressureGround::Place> places;
  for (const double thickness : ground.thicknesses()) {
    places.push_back({thickness, tissue::PressureForm(ground.fieldsAt(thickness))});
  }
  return std::make_shared<const contact::PressureGround>(std::move(places));
}

std::shared_ptr<const contact::PressureGround> pressureGround(const World& world) {
  if (world.pressure) return world.pressure;
  return pressureGround(
      LumpGround(world.scene, *world.healthy, world.tissue.model == TissueModel::layered, "pressure pads"));
}

}  // namespace palpate::scene
