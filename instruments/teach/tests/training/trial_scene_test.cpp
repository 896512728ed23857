#include "palpate/training/session/trial_scene.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/scene/body_parts.h"
#include "teach/tests/training/twelve.h"

namespace palpate::training {
namespace {

/// A flat back around the sites, a vertex every 4 mm.
std::shared_ptr<const scene::World> flatBack(const scene::Scene& requested) {
  mesh::TriangleMesh mesh;
  constexpr int kColumns = 61;
  constexpr int kRows = 81;
  constexpr double kStepMm = 4.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      mesh.positions.emplace_back(-120.0 + kStepMm * column, -60.0 + kStepMm * row, 100.0);
    }
  }
  const auto at = [](int row, int column) { return static_cast<Index>(row * kColumns + column); };
  for (int row = 0; row + 1 < kRows; ++row) {
    for (int column = 0; column + 1 < kColumns; ++column) {
      mesh.triangles.push_back({at(row, column), at(row, column + 1), at(row + 1, column + 1)});
      mesh.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row + 1, column)});
    }
  }
  std::vector<Index> source;
  scene::Scene scene = requested;
  scene.body.kind = scene::BodyKind::mesh;
  return scene::buildOn(scene, scene::mendedBody(std::move(mesh), "flat back", {}, source));
}

/// The least and the greatest stiffness of all vertices within `radius` of a place, N/mm.
std::pair<double, double> stiffnessAround(const scene::World& world, const Vec2& place, double from, double to) {
  double least = 1e9;
  double greatest = 0.0;
  for (std::size_t i = 0; i < world.body->skin.positions.size(); ++i) {
    const Vec3& point = world.body->skin.positions[i];
    const double distance = std::hypot(point.x() - place.x(), point.y() - place.y());
    if (distance < from || distance > to) continue;
    least = std::min(least, (*world.surface.stiffness_n_per_mm)[i]);
    greatest = std::max(greatest, (*world.surface.stiffness_n_per_mm)[i]);
  }
  return {least, greatest};
}

TEST(TrialScene, WhatTheBaseSceneHidesIsGone) {
  scene::Scene base;
  base.dysfunctions.emplace_back();
  base.lumps.emplace_back();
  const scene::Scene scene = trialScene(base, builtInProtocol(), SessionKind::pre_test, flatTwelve(), std::nullopt);
  EXPECT_TRUE(scene.dysfunctions.empty());
  EXPECT_TRUE(scene.lumps.empty());
}

TEST(TrialScene, TheHiddenPlaceIsStifferByExactlyItsChangeAndNothingElseIs) {
  const SiteSet sites = flatTwelve();
  const Protocol protocol = builtInProtocol();
  const scene::Scene scene =
      trialScene({}, protocol, SessionKind::pre_test, sites, HiddenNow{.site = 8, .change = 0.28});
  const auto world = flatBack(scene);
  const Vec2 hidden = sites.numbered(8)->place_mm;
  const double plateau_mm = protocol.hidden.radius_mm * (1.0 - protocol.hidden.edge_softness);
  const auto [least, greatest] = stiffnessAround(*world, hidden, 0.0, plateau_mm - 0.1);
  EXPECT_NEAR(least, 0.3 / 0.72, 1e-9);  // compliance 28 % less
  EXPECT_NEAR(greatest, 0.3 / 0.72, 1e-9);
  const auto [base_least, base_greatest] = stiffnessAround(*world, hidden, protocol.hidden.radius_mm, 1e9);
  EXPECT_NEAR(base_least, 0.3, 1e-9);
  EXPECT_NEAR(base_greatest, 0.3, 1e-9);
}

TEST(TrialScene, NoOtherSiteFeelsAnythingOfAHiddenPlace) {
  const SiteSet sites = flatTwelve();
  const Protocol protocol = builtInProtocol();
  for (const Site& hidden : sites.sites) {
    for (const Site& other : sites.sites) {
      if (other.number == hidden.number) continue;
      const maps::Dysfunction place = dysfunctionAt(hidden, protocol.hidden, 0.5, ChangeMeaning::compliance);
      EXPECT_EQ(maps::stiffnessFactor(place, other.place_mm), 1.0) << hidden.number << " " << other.number;
    }
  }
}

TEST(TrialScene, OwnDysfunctionsAreTakenOutAndTestsAreMadeOnEvenTissue) {
  scene::Scene base;
  base.dysfunctions.push_back({.x_mm = 0, .y_mm = 0});
  const Protocol protocol = builtInProtocol();
  const scene::Scene scene = trialScene(base, protocol, SessionKind::exam, flatTwelve(), {});
  EXPECT_TRUE(scene.dysfunctions.empty());
  EXPECT_EQ(scene.stiffness.source, scene::StiffnessSource::constant);
  EXPECT_EQ(scene.tissue.force_law.kind, tissue::ForceLaw::Kind::linear);
}

TEST(TrialScene, NaturalTissueStaysWhereTheProtocolAsksForIt) {
  scene::Scene base;
  base.stiffness.source = scene::StiffnessSource::depth;
  Protocol protocol = builtInProtocol();
  protocol.practice.natural_stiffness = true;
  const auto source = [&](SessionKind kind) {
    return trialScene(base, protocol, kind, flatTwelve(), {}).stiffness.source;
  };
  EXPECT_EQ(source(SessionKind::practice), scene::StiffnessSource::depth);
  EXPECT_EQ(source(SessionKind::pre_test), scene::StiffnessSource::constant);
}

TEST(TrialScene, WhatLiesDeepReachesTheSkinWeakerAndWider) {
  const SiteSet sites = flatTwelve();
  const HiddenPlace shallow{.radius_mm = 20.0};
  const HiddenPlace deep{.radius_mm = 20.0, .depth_mm = 20.0};
  EXPECT_NEAR(feltRatio(shallow, 0.5, ChangeMeaning::compliance), 2.0, 1e-12);
  EXPECT_NEAR(feltRatio(deep, 0.5, ChangeMeaning::compliance), 1.5, 1e-12);
  const maps::Dysfunction felt = dysfunctionAt(*sites.numbered(1), deep, 0.5, ChangeMeaning::compliance);
  EXPECT_NEAR(felt.radius_mm, 28.284, 1e-3);
}

TEST(TrialScene, ABoneThatStandsNearerIsStifferByTheDepthLaw) {
  const HiddenPlace raised{.radius_mm = 20.0, .bony_displacement_mm = 5.0};
  const double expected = (0.3 + 0.9 * std::exp(-25.0 / 23.0)) / (0.3 + 0.9 * std::exp(-30.0 / 23.0));
  EXPECT_NEAR(feltRatio(raised, 0.5, ChangeMeaning::compliance), 2.0 * expected, 1e-12);
}

TEST(Stimulus, ADeclaredChangeHasOneMeaning) {
  EXPECT_NEAR(stiffnessRatio(0.28, ChangeMeaning::compliance), 1.0 / 0.72, 1e-15);
  EXPECT_NEAR(stiffnessRatio(0.28, ChangeMeaning::stiffness), 1.28, 1e-15);
  for (const ChangeMeaning meaning : {ChangeMeaning::compliance, ChangeMeaning::stiffness}) {
    const std::vector<double> levels = adaptiveLevels(meaning);
    ASSERT_EQ(levels.size(), 33U);
    EXPECT_NEAR(levels.front(), 0.04, 1e-12);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      EXPECT_NEAR(changeFromRatio(stiffnessRatio(levels[i], meaning), meaning), levels[i], 1e-12);
      if (i == 0) continue;
      EXPECT_NEAR(levels[i] / levels[i - 1], 1.10, 0.02);
    }
  }
}

}  // namespace
}  // namespace palpate::training
