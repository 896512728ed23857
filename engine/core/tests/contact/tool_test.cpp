// A tool feels with every pad what a finger alone feels there, to the last bit; what it adds is one search for all and
// a wrench.
#include "palpate/contact/tool.h"

#include <cstring>
#include <functional>
#include <numbers>

#include "core/tests/contact/finger_track.h"
#include "lab/workloads/hunted_bodies.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/base/random.h"
#include "palpate/contact/lump_force.h"
#include "palpate/contact/tool_shapes.h"
#include "support/counted.h"
#include "support/error_message.h"
#include "support/lump_field.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

namespace {

/// Every bit, but for the sign of a zero.
bool isSame(const Vec3& one, const Vec3& other) { return one == other; }

bool isSame(const FingerOutput& one, const FingerOutput& other) {
  return isSame(one.tip, other.tip) && isSame(one.proxy, other.proxy) && isSame(one.anchor, other.anchor) &&
         isSame(one.hold, other.hold) && isSame(one.normal, other.normal) && isSame(one.force, other.force) &&
         one.depth_mm == other.depth_mm && one.tissue_mm == other.tissue_mm && one.finger_mm == other.finger_mm &&
         one.touch == other.touch && one.triangle == other.triangle && one.anchor_triangle == other.anchor_triangle &&
         one.status == other.status && one.rest_mm == other.rest_mm && one.dent.rest_mm == other.dent.rest_mm &&
         isSame(one.dent.place, other.dent.place) && one.lump == other.lump &&
         isSame(one.lump_force, other.lump_force) && one.lump_share == other.lump_share;
}

Mat3 turned(const Vec3& axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

/// A tool and, beside it, a finger for every pad, which is what the pads must feel; and another finger that keeps the
/// skin near it, which must feel the same.
class ToolTrack {
 public:
  ToolTrack(const Surface& surface, ToolShape shape, FingerSettings settings = {})
      : surface_(surface),
        shape_(std::move(shape)),
        settings_(settings),
        state_(makeToolState(shape_, surface)),
        fingers_(shape_.pads.size()),
        planed_(surface),
        keeping_(shape_.pads.size()),
        skins_(shape_.pads.size()),
        poses_(shape_.rest.size()) {
    planed_.planes = state_.planes;
  }

  /// The tool in one piece.
  Wrench to(const ToolPose& pose) {
    posesAtRest(shape_, pose, poses_);
    return toPoses();
  }

  Wrench toPoses() {
    const Wrench wrench = stepTool(surface_, shape_, settings_, state_, poses_);
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      FingerSettings settings = settings_;
      settings.radius_mm = shape_.pads[i].radius_mm;
      const ToolPose& pose = poses_[shape_.pads[i].part];
      const Vec3 tip = pose.position + pose.rotation * shape_.pads[i].offset;
      const FingerOutput alone = step(surface_, settings, fingers_[i], tip);
      if (!isSame(alone, state_.felt[i])) ++differences_;
      if (!isSame(alone, step(planed_, settings, keeping_[i], tip, nullptr, &skins_[i]))) ++differences_;
      known_ += keeping_[i].touching && skins_[i].skin.planes != nullptr ? 1 : 0;
      touching_ += touches(alone) ? 1 : 0;
      settled_in_valleys_ += alone.status == 0 && fingers_[i].standing.count > 1 ? 1 : 0;
    }
    ++ticks_;
    return wrench;
  }

  std::vector<ToolPose>& poses() { return poses_; }
  const ToolState& state() const { return state_; }
  const ToolShape& shape() const { return shape_; }
  std::size_t differences() const { return differences_; }
  std::size_t touching() const { return touching_; }
  std::size_t inValleys() const { return settled_in_valleys_; }
  /// Of fingers that touch, how often the skin near them was known.
  std::size_t known() const { return known_; }

 private:
  const Surface& surface_;
  ToolShape shape_;
  FingerSettings settings_;
  ToolState state_;
  std::vector<FingerState> fingers_;
  Surface planed_;
  std::vector<FingerState> keeping_;
  std::vector<FingerSkin> skins_;
  std::vector<ToolPose> poses_;
  std::size_t known_ = 0;
  std::size_t differences_ = 0, touching_ = 0, settled_in_valleys_ = 0, ticks_ = 0;
};

FingerSettings slick() {
  FingerSettings settings;
  settings.mu_static = settings.mu_dynamic = 0.0;
  return settings;
}

Box3 computeSurfaceBox(const Surface& surface) {
  Box3 box;
  for (const tree::TriangleRecord& record : surface.geometry->tree.records) {
    for (const Vec3& corner : record.corners) box.extend(corner);
  }
  return box;
}

/// A wandering tool that comes at a body from all sides, presses, turns, jumps now and then and leaves again.
void wander(ToolTrack& tool, const Surface& surface, int ticks, std::uint64_t seed) {
  Random random(seed);
  const Box3 box = computeSurfaceBox(surface);
  const double size = box.diagonal().norm();
  Vec3 at = box.center() + Vec3(0.0, 0.0, 0.7 * size);
  Vec3 goal = box.center();
  Mat3 rotation = Mat3::Identity();
  for (int i = 0; i < ticks; ++i) {
    if (i % 120 == 0) goal = box.center() + 0.25 * size * random.normal3();
    if (i % 400 == 399) at = box.center() + 0.6 * size * random.normal3();
    at += 0.02 * (goal - at) + 0.0005 * size * random.normal3();
    rotation = turned(random.normal3(), 0.02) * rotation;
    tool.to({at, rotation});
  }
}

}  // namespace

TEST(Tool, OfOnePadIsTheSphereFingerToTheBit) {
  const Surface back = surfaceOf(lab::backMesh(8'163));
  const auto path = lab::backSlide();
  for (const double radius : {1.0, 8.0}) {
    ToolTrack tool(back, sphereTool(radius));
    for (std::size_t k = 0; k < path.tip_mm.size(); k += 3) {
      const Wrench wrench = tool.to({path.tip_mm[k], Mat3::Identity()});
      ASSERT_TRUE(isSame(wrench.force_n, tool.state().felt[0].force));
      ASSERT_TRUE(isSame(wrench.moment_n_mm, Vec3::Zero())) << "at the origin of its part";
    }
    EXPECT_EQ(tool.differences(), 0u) << radius;
    EXPECT_GT(tool.touching(), 4000u);
    EXPECT_GT(tool.known(), 0.9 * static_cast<double>(tool.touching()));
  }
}

TEST(Tool, EachPadFeelsWhatAFingerAloneFeelsOnABack) {
  const Surface back = surfaceOf(lab::backMesh(20'389));
  const auto path = lab::backSlide();
  const std::pair<const char*, ToolShape> tools[] = {{"fingertip", fingertipTool()}, {"knuckle", knuckleTool()},
                                                     {"palm", palmTool()},           {"head", headTool()},
                                                     {"hand", handTool()},           {"fingertips", fingertipsTool()}};
  for (const auto& [name, shape] : tools) {
    ToolTrack tool(back, shape);
    for (std::size_t k = 0; k < path.tip_mm.size(); k += 8) {
      tool.to({path.tip_mm[k], turned({1.0, 0.3, 1.0}, 0.1 * std::sin(0.002 * static_cast<double>(k)))});
    }
    EXPECT_EQ(tool.differences(), 0u) << name;
    EXPECT_GT(tool.inValleys(), 10u) << name;
  }
}

TEST(Tool, EachPadFeelsWhatAFingerAloneFeelsOnBodiesOfEveryKind) {
  int seed = 1;
  std::size_t touching = 0;
  for (const zoo::Specimen& specimen : zoo::specimens()) {
    const Surface surface = surfaceOf(specimen.mesh);
    for (const FingerSettings& settings : {FingerSettings{}, slick()}) {
      ToolTrack tool(surface, fingertipTool(), settings);
      wander(tool, surface, 1000, static_cast<std::uint64_t>(++seed));
      EXPECT_EQ(tool.differences(), 0u) << specimen.name;
      touching += tool.touching();
    }
  }
  EXPECT_GT(touching, 10'000u);
}

TEST(Tool, EachPadFeelsWhatAFingerAloneFeelsOnTornAndFoldedBodies) {
  std::uint64_t seed = 7;
  for (const std::string& kind : lab::huntedBodyKinds()) {
    const Surface surface = surfaceOf(lab::huntedBody(kind, ++seed));
    ToolTrack tool(surface, headTool());
    wander(tool, surface, 250, seed);
    EXPECT_EQ(tool.differences(), 0u) << kind;
  }
}

TEST(Tool, EachPadFeelsWhatAFingerAloneFeelsInNarrowValleys) {
  for (const mesh::TriangleMesh& mesh :
       {lab::grooveMesh(60.0), lab::pitMesh(), lab::eggcrateMesh(), zoo::wavyGrid(60, 120.0, 6.0)}) {
    const Surface surface = surfaceOf(mesh);
    ToolTrack tool(surface, fingertipTool());
    wander(tool, surface, 3000, 3);
    EXPECT_EQ(tool.differences(), 0u);
    EXPECT_GT(tool.inValleys(), 20u);
  }
}

TEST(Tool, EachPadRelaxesAndFeelsLumpsAsAFingerAloneDoes) {
  mesh::TriangleMesh mesh = zoo::wavyGrid(40, 120.0, 2.0);
  Surface surface = surfaceOf(mesh);
  surface.lumps = std::make_shared<const Lumps>(Lumps{.all = {test::inventedLump({60, 60, 0})}});
  FingerSettings settings;
  settings.relaxation = {.share = 0.4, .time_s = 0.05};
  ToolTrack tool(surface, fingertipTool(), settings);
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.001 * i;
    tool.to(
        {Vec3(60 + 15 * std::sin(2 * t), 60 + 10 * std::sin(3 * t), 4.0 - 6.0 * std::sin(5 * t)), Mat3::Identity()});
  }
  EXPECT_EQ(tool.differences(), 0u);
  EXPECT_GT(tool.touching(), 1000u);
}

TEST(Tool, EachPadFollowsOtherForceLawsAsAFingerAloneDoes) {
  Surface surface = surfaceOf(zoo::wavyGrid(40, 120.0, 3.0));
  surface.force_law.kind = tissue::ForceLaw::Kind::power;
  ToolTrack tool(surface, headTool());
  wander(tool, surface, 3000, 5);
  EXPECT_EQ(tool.differences(), 0u);
  EXPECT_GT(tool.touching(), 1000u);
}

TEST(Tool, WhoseTipsAreLostFeelsNothingAndGoesOn) {
  const Surface plate = surfaceOf(zoo::grid());
  ToolTrack tool(plate, fingertipTool());
  for (int i = 0; i < 200; ++i) tool.to({Vec3(50, 50, 10 - 0.05 * i), Mat3::Identity()});
  ASSERT_EQ(tool.state().touching, 7u);
  const Wrench lost = tool.to({Vec3::Constant(std::nan("")), Mat3::Identity()});
  EXPECT_TRUE(isSame(lost.force_n, Vec3::Zero()));
  tool.to({Vec3(1e12, 0, 0), Mat3::Identity()});
  for (int i = 0; i < 50; ++i) tool.to({Vec3(50, 50, 0), Mat3::Identity()});
  EXPECT_EQ(tool.state().touching, 7u);
  for (int i = 0; i < 200; ++i) tool.to({Vec3(50, 50, 0.3 * i), Mat3::Identity()});
  tool.to({Vec3::Constant(std::nan("")), Mat3::Identity()});
  tool.to({Vec3(50, 50, 60), Mat3::Identity()});
  EXPECT_EQ(tool.state().touching, 0u);
  EXPECT_EQ(tool.differences(), 0u);
}

TEST(Tool, PartsMoveByThemselves) {
  const Surface plate = surfaceOf(zoo::grid(40, 300.0));
  ToolTrack tool(plate, handTool());
  for (int i = 0; i < 400; ++i) {
    posesAtRest(tool.shape(), {Vec3(150, 150, 20), Mat3::Identity()}, tool.poses());
    tool.poses()[3].position.z() = 10 - 0.03 * i;
    tool.toPoses();
  }
  EXPECT_EQ(tool.state().touching, 7u) << "only the fourth finger";
  EXPECT_GT(tool.state().of_part[3].force_n.z(), 0.5);
  EXPECT_EQ(tool.state().of_part[4].force_n.z(), 0.0);
  EXPECT_EQ(tool.differences(), 0u);
}

TEST(Tool, PressedFlatPushesBackLikeOneFingerOfItsShares) {
  const Surface plate = surfaceOf(zoo::grid(40, 300.0));
  ToolTrack head(plate, headTool(), slick());
  Wrench wrench;
  for (int i = 0; i < 400; ++i) wrench = head.to({Vec3(150, 150, 3.0 + 2.0 - 0.01 * i), Mat3::Identity()});
  double shares = 0.0;
  for (const Pad& pad : headTool().pads) shares += pad.share;
  EXPECT_NEAR(shares, 1.9, 0.02);
  EXPECT_NEAR(wrench.force_n.z(), shares * kTestStiffness * 1.99, 1e-3);
  EXPECT_LT(wrench.moment_n_mm.norm(), 1e-3);
}

TEST(Tool, PressedAtOneEndIsTurned) {
  const Surface plate = surfaceOf(zoo::grid(40, 300.0));
  ToolTrack head(plate, headTool(), slick());
  const Mat3 tilted = turned(Vec3::UnitY(), 0.1);  // the end at +x goes down
  Wrench wrench;
  for (int i = 0; i < 300; ++i) wrench = head.to({Vec3(150, 150, 8.0 - 0.01 * i), tilted});
  EXPECT_GT(wrench.force_n.z(), 0.0);
  EXPECT_LT(wrench.moment_n_mm.y(), 0.0) << "back to level";
  const Wrench at_end = about(wrench, wrench.point + tilted * Vec3(27, 0, 0));
  EXPECT_LT(std::abs(at_end.moment_n_mm.y()), std::abs(wrench.moment_n_mm.y()));
  EXPECT_TRUE(isSame(about(at_end, wrench.point).force_n, wrench.force_n));
  EXPECT_NEAR((about(at_end, wrench.point).moment_n_mm - wrench.moment_n_mm).norm(), 0.0, 1e-9);
}

// What the wrench does on a way of motion and turning is what the pads do there, and on a plate without friction a
// round trip gives back what it took.
TEST(Tool, DoesTheWorkOfItsPadsAndNoneOnARoundTrip) {
  for (const bool flat : {true, false}) {
    const Surface surface = surfaceOf(flat ? zoo::grid(40, 200.0) : zoo::wavyGrid(80, 200.0, 3.0));
    const ToolShape shape = fingertipTool();
    ToolTrack tool(surface, shape, slick());
    const auto pose_at = [](double t) {
      return ToolPose{Vec3(100 + 8 * std::sin(t), 100 + 6 * std::sin(2 * t), -1.0 + 1.5 * std::cos(t)),
                      turned({1.0, 2.0, 0.5}, 0.2 * std::sin(3 * t))};
    };
    for (int i = 0; i < 300; ++i) tool.to({pose_at(0).position + Vec3(0, 0, 15 - 0.05 * i), pose_at(0).rotation});
    double work = 0.0, of_pads = 0.0, moved = 0.0;
    ToolPose before = pose_at(0);
    Wrench felt = tool.to(before);
    std::vector<FingerOutput> pads_before = tool.state().felt;
    constexpr int kTicks = 20'000;
    for (int i = 1; i <= kTicks; ++i) {
      const ToolPose pose = pose_at(2.0 * std::numbers::pi * i / kTicks);
      const Wrench now = tool.to(pose);
      const Eigen::AngleAxisd turn(Mat3(pose.rotation * before.rotation.transpose()));
      const double part = 0.5 * (felt.force_n + now.force_n).dot(pose.position - before.position) +
                          0.5 * (felt.moment_n_mm + now.moment_n_mm).dot(turn.angle() * turn.axis());
      work += part;
      moved += std::abs(part);
      for (std::size_t k = 0; k < pads_before.size(); ++k) {
        const FingerOutput& pad = tool.state().felt[k];
        of_pads += 0.5 * shape.pads[k].share * (pads_before[k].force + pad.force).dot(pad.tip - pads_before[k].tip);
      }
      felt = now;
      before = pose;
      pads_before = tool.state().felt;
    }
    EXPECT_GT(moved, 1.0);
    EXPECT_NEAR(work, of_pads, 1e-5 * moved);
    if (flat) {
      EXPECT_LT(std::abs(work), 1e-4 * moved);
    }
    EXPECT_EQ(tool.differences(), 0u);
  }
}

TEST(Tool, AsksForNoMemoryInATick) {
  const Surface back = surfaceOf(lab::backMesh(8'163));
  const ToolShape shape = handTool();
  ToolState state = makeToolState(shape, back);
  std::vector<ToolPose> poses(shape.rest.size());
  std::size_t touching = 0;
  support::expectNoAllocation([&] {
    for (int i = 0; i < 3000; ++i) {
      posesAtRest(shape, {Vec3(175 + 0.02 * i, 200 + 0.01 * i, 180 - 0.05 * i), Mat3::Identity()}, poses);
      stepTool(back, shape, {}, state, poses);
      touching += state.touching;
    }
  });
  EXPECT_GT(touching, 10'000u);
}

TEST(Tool, GathersAnewOnAnotherSkin) {
  const Surface plate = surfaceOf(zoo::grid(40, 300.0));
  const Surface hills = surfaceOf(zoo::wavyGrid(80, 300.0, 3.0));
  const ToolShape shape = fingertipTool();
  ToolState state = makeToolState(shape, plate);
  ToolState fresh = makeToolState(shape, hills);
  std::vector<ToolPose> poses(1);
  for (int i = 0; i < 300; ++i) {
    poses[0].position = Vec3(150, 150, 10 - 0.03 * i);
    stepTool(plate, shape, {}, state, poses);
  }
  lift(state);
  for (int i = 0; i < 300; ++i) {
    poses[0].position = Vec3(140, 150, 20 - 0.06 * i);
    const Wrench again = stepTool(hills, shape, {}, state, poses);
    ASSERT_TRUE(isSame(again.force_n, stepTool(hills, shape, {}, fresh, poses).force_n)) << i;
  }
  EXPECT_EQ(state.touching, 7u);
}

TEST(ToolShapes, HaveThePadsTheyAreNamedFor) {
  EXPECT_EQ(fingertipTool().pads.size(), 7u);
  EXPECT_EQ(knuckleTool().pads.size(), 3u);
  EXPECT_EQ(palmTool().pads.size(), 24u);
  EXPECT_EQ(headTool().pads.size(), 33u);
  EXPECT_EQ(fingertipsTool().pads.size(), 10u);
  EXPECT_EQ(handTool().pads.size(), 94u);
  Box3 head;
  for (const Pad& pad : headTool().pads) {
    head.extend(Vec3(pad.offset + Vec3::Constant(pad.radius_mm)));
    head.extend(Vec3(pad.offset - Vec3::Constant(pad.radius_mm)));
  }
  EXPECT_NEAR(head.sizes().x(), 60.0, 1e-9);
  EXPECT_NEAR(head.sizes().y(), 12.0, 1e-9);
}

TEST(ToolShapes, ThatMakeNoSenseAreRefusedByName) {
  const Surface plate = surfaceOf(zoo::grid());
  const auto message = [&](const ToolShape& shape) {
    return support::thrownMessage([&] { (void)makeToolState(shape, plate); });
  };
  EXPECT_NE(message({}).find("at least one pad"), std::string::npos);
  ToolShape flat = fingertipTool();
  flat.pads[2].radius_mm = 0.0;
  EXPECT_NE(message(flat).find("pad 2: its radius"), std::string::npos);
  flat = fingertipTool();
  flat.pads[1].part = 1;
  EXPECT_NE(message(flat).find("pad 1: its part"), std::string::npos);
}

}  // namespace palpate::contact
