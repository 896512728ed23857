// Every peer that this build has, the literal one included, against brute force.
#include <gtest/gtest.h>

#include <cmath>

#include "lab/peers/judge.h"
#include "lab/peers/peer.h"
#include "lab/peers/timed_answers.h"
#include "palpate/base/random.h"
#include "palpate/contact/tool_shapes.h"
#include "palpate/tree/closest_on_triangle.h"
#include "support/mesh_zoo.h"

namespace palpate::bench {

namespace {

#ifdef PALPATE_HAS_PEERS
std::vector<Peer> peers() { return linkedPeers(); }
std::vector<ToolPeer> toolPeers() { return linkedToolPeers(); }
#else
std::vector<Peer> peers() { return peersWithoutLibraries(); }
std::vector<ToolPeer> toolPeers() { return toolPeersWithoutLibraries(); }
#endif

/// Between, on and beyond the hills of a sheet of 100 mm.
Vec3 somewhere(Random& random) {
  return {100.0 * random.uniform(), 100.0 * random.uniform(), 20.0 * random.uniform() - 10.0};
}

double distanceTo(const mesh::TriangleMesh& mesh, const Vec3& point) {
  double squared = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<Vec3, 3> corners = {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
    squared = std::min(squared, tree::closestOnTriangle(corners, point).squared_distance);
  }
  return std::sqrt(squared);
}

/// The sheet is a height field, and so finely divided that a short way which ends on its other side crosses it.
bool below(const Vec3& p) {
  const double wave = 2.0 * M_PI * 2.0 / 100.0;
  return p.z() < 5.0 * std::sin(wave * p.x()) * std::sin(wave * p.y());
}

}  // namespace

TEST(Peers, AreListedWithTheirPackages) {
  const std::vector<Peer> none = peersWithoutLibraries();
  ASSERT_EQ(none.size(), 4u);
  EXPECT_EQ(none[0].name, "embree");
  EXPECT_EQ(none[0].package, "libembree-dev");
  EXPECT_EQ(none[0].contact, nullptr);
  EXPECT_EQ(none[3].name, "literal");
  EXPECT_NE(none[3].contact, nullptr);
}

TEST(Peers, FindTheNearestPointOfAWavySheet) {
  const mesh::TriangleMesh mesh = zoo::wavyGrid();
  Random random(11);
  std::vector<ContactQuery> queries(200);
  for (ContactQuery& q : queries) {
    q.point = somewhere(random);
    q.proxy = q.from = q.to = q.point;
    q.from.z() = q.to.z() = 30.0;
    q.to.x() += 1.0;
    q.reach = 12.5;  // half the detecting box of the literal one
    q.bound = std::min(q.reach, 1.001 * distanceTo(mesh, q.point));
  }
  for (const Peer& peer : peers()) {
    if (peer.contact == nullptr) continue;
    const PeerRun<ContactAnswer> run = peer.contact(mesh, queries, 10.0);
    ASSERT_EQ(run.answers.size(), queries.size()) << peer.name;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const double distance = distanceTo(mesh, queries[i].point);
      if (distance < queries[i].reach) {
        EXPECT_NEAR(run.answers[i].distance, distance, 1e-4) << peer.name << " " << i;
      } else {
        EXPECT_TRUE(std::isinf(run.answers[i].distance)) << peer.name << " " << i;
      }
      EXPECT_FALSE(run.answers[i].crosses) << peer.name << " " << i;
    }
  }
}

TEST(Peers, SeeASegmentCrossFromEitherSide) {
  const mesh::TriangleMesh mesh = zoo::wavyGrid(64);
  Random random(12);
  std::vector<ContactQuery> queries(200);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    ContactQuery& q = queries[i];
    q.from = somewhere(random);
    q.to = q.from + Vec3(0, 0, i % 2 == 0 ? 3.0 : -3.0);
    q.proxy = q.from;
  }
  for (const Peer& peer : peers()) {
    if (peer.contact == nullptr) continue;
    const PeerRun<ContactAnswer> run = peer.contact(mesh, queries, 10.0);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Vec3 slack(0, 0, 0.05);  // facets are not the wave
      const bool surely = below(queries[i].from) != below(queries[i].to);
      if (below(queries[i].from + slack) != below(queries[i].from - slack)) continue;
      if (below(queries[i].to + slack) != below(queries[i].to - slack)) continue;
      EXPECT_EQ(run.answers[i].crosses, surely) << peer.name << " " << i;
      EXPECT_TRUE(std::isinf(run.answers[i].distance)) << peer.name;  // was not asked
    }
  }
}

TEST(Peers, ListTheTrianglesOfABox) {
  // Every triangle fills half of its box's square, and this box ends between the lines of the grid: both tests agree.
  const mesh::TriangleMesh mesh = zoo::grid(20, 100.0);
  const std::vector<Box3> boxes = {{Vec3(11, 21, -5), Vec3(34, 39, 5)}, {Vec3(50, 50, 1), Vec3(60, 60, 2)}};
  for (const Peer& peer : peers()) {
    if (peer.boxes == nullptr) continue;
    const PeerRun<BoxAnswer> run = peer.boxes(mesh, boxes, 10.0);
    ASSERT_EQ(run.answers.size(), 2u) << peer.name;
    const std::size_t squares = 5 * 4;                              // of 5 mm, from 10 to 35 and from 20 to 40
    EXPECT_GE(run.answers[0].count, 2 * squares - 2) << peer.name;  // two corners may be passed by
    EXPECT_LE(run.answers[0].count, 2 * squares) << peer.name;
    EXPECT_EQ(run.answers[1].count, 0u) << peer.name;
  }
}

TEST(Peers, FindThePadsOfAToolThatTouchAWavySheet) {
  const mesh::TriangleMesh mesh = zoo::wavyGrid();
  const contact::ToolShape hand = contact::handTool();
  ToolQueries queries{hand, {}};
  Random random(13);
  for (std::size_t k = 0; k < 50 * hand.rest.size(); ++k) {
    const Vec3 axis(random.normal(), random.normal(), random.normal());
    queries.poses.push_back({somewhere(random), Eigen::AngleAxisd(1.0, axis.normalized()).toRotationMatrix()});
  }
  for (const ToolPeer& peer : toolPeers()) {
    if (peer.tool == nullptr) continue;
    const PeerRun<ToolAnswer> run = peer.tool(mesh, queries, 10.0);
    ASSERT_EQ(run.answers.size(), 50u) << peer.name;
    for (std::size_t tick = 0; tick < run.answers.size(); ++tick) {
      std::size_t surely = 0, perhaps = 0;
      for (const contact::Pad& pad : hand.pads) {
        const contact::ToolPose& pose = queries.at(tick)[pad.part];
        const double gap = distanceTo(mesh, pose.position + pose.rotation * pad.offset) - pad.radius_mm;
        surely += gap < -1e-3 ? 1 : 0;
        perhaps += gap < 1e-3 ? 1 : 0;
      }
      EXPECT_GE(run.answers[tick].touching, surely) << peer.name << " " << tick;
      EXPECT_LE(run.answers[tick].touching, perhaps) << peer.name << " " << tick;
    }
  }
}

TEST(Peers, GetTheQueriesOfOurOwnRun) {
  ContactWorld world = buildContactWorld(zoo::wavyGrid(64));
  device::Trajectory path;
  for (int k = 0; k < 400; ++k) {
    path.time_s.push_back(1e-3 * k);
    path.tip_mm.push_back({30.0 + 0.1 * k, 50.0, std::max(-2.0, 8.0 - 0.1 * k)});
  }
  const ContactComparison comparison = compareContact(world, path, {}, {}, peers(), 5.0);
  EXPECT_EQ(comparison.queries, 400u);
  EXPECT_GT(comparison.nearest_asked, 250u);
  EXPECT_LT(comparison.nearest_asked, 400u);
  for (const PeerFigures& f : comparison.peers) {
    if (!f.skipped.empty()) continue;
    EXPECT_EQ(f.queries, 400u) << f.name;
    EXPECT_EQ(f.disagreements, 0u) << f.name;
    EXPECT_NEAR(f.mean_distance_mm, comparison.peers.back().mean_distance_mm, 1e-4) << f.name;
    EXPECT_GE(f.hits, 1u) << f.name;
    EXPECT_NE(f.hash, 0u) << f.name;
  }
}

TEST(Peers, AWrongAnswerShows) {
  const Peer liar{"liar", "", [](const mesh::TriangleMesh&, std::span<const ContactQuery> queries, double) {
                    PeerRun<ContactAnswer> run;
                    for (std::size_t i = 0; i < queries.size(); ++i) {
                      run.asked.push_back(static_cast<std::uint32_t>(i));
                      run.answers.push_back({1.0, false});
                      run.query_us.push_back(0.001);
                    }
                    return run;
                  }};
  ContactWorld world = buildContactWorld(zoo::grid());
  ContactQuery query;
  query.point = Vec3(50, 50, 3);
  query.reach = 10.0;
  query.to = Vec3(0, 0, 10);
  const auto figures = comparePeers(std::vector{liar}, world, std::vector{query, query, query}, 1.0);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].disagreements, 3u);
}

TEST(AffordableQueries, AreAllOrBlocksSpreadOverTheRun) {
  EXPECT_EQ(affordableQueries(1000, 1.0, 1.0).size(), 1000u);
  const std::vector<std::uint32_t> few = affordableQueries(10000, 1000.0, 1.0);  // room for 1000
  EXPECT_NEAR(static_cast<double>(few.size()), 1000.0, 64.0);
  EXPECT_EQ(few[0] + 1, few[1]);
  EXPECT_LT(few.front(), 100u);
  EXPECT_GT(few.back(), 9000u);
  EXPECT_FALSE(affordableQueries(10, 1e9, 0.01).empty());
}

}  // namespace palpate::bench
