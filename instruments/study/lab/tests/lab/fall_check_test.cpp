// The judge is judged with fingers that are made to fail in known ways.
#include "lab/judges/fall_check.h"

#include <gtest/gtest.h>

#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"

namespace palpate::lab {
namespace {

lab::Observation freeAt(const Vec3& tip) { return {tip, tip, false, false}; }
lab::Observation heldAt(const Vec3& tip) { return {tip, tip, true, true}; }

/// A finger that always holds a tip below z = 0 of the plate.
std::vector<lab::Observation> perfectFinger(const device::Trajectory& path) {
  std::vector<lab::Observation> ticks;
  for (const Vec3& tip : path.tip_mm) {
    const bool over_plate = tip.x() >= 0 && tip.x() <= 100 && tip.y() >= 0 && tip.y() <= 100;
    ticks.push_back(tip.z() < 0 && over_plate ? heldAt(tip) : freeAt(tip));
  }
  return ticks;
}

TEST(FallCheck, AFingerThatHoldsHasNoFalls) {
  lab::SurfaceSide plate(lab::flatMesh());
  const lab::FallReport report = lab::checkFalls(plate, perfectFinger(lab::workloadPath("flat_press")));
  EXPECT_EQ(report.ticks, 0u);
  EXPECT_EQ(report.first_contact_delay_ticks, 0u);
  EXPECT_EQ(report.first_contacts, 16u);
}

TEST(FallCheck, CountsEveryTickOfAFreeTipBelowAndNamesTheFirst) {
  lab::SurfaceSide plate(lab::flatMesh());
  std::vector<lab::Observation> ticks{freeAt({50, 50, 2}),  heldAt({50, 50, -1}), freeAt({50, 50, -2}),
                                      freeAt({50, 50, -3}), heldAt({50, 50, -2}), freeAt({50, 50, 1}),
                                      freeAt({50, 50, -1}), freeAt({50, 50, 1})};
  const lab::FallReport report = lab::checkFalls(plate, ticks);
  EXPECT_EQ(report.ticks, 3u);
  EXPECT_EQ(report.events, 2u);
  EXPECT_EQ(report.first_tick, 2u);
}

TEST(FallCheck, ATunnellingFingerFallsAtEveryStab) {
  lab::SurfaceSide back(lab::backMesh(2962));
  std::vector<lab::Observation> ticks;
  for (const Vec3& tip : lab::backStabs(5.0, 1).tip_mm) ticks.push_back(freeAt(tip));
  const lab::FallReport report = lab::checkFalls(back, ticks);
  EXPECT_EQ(report.events, 300u);
  EXPECT_EQ(report.first_contacts, 300u);
  EXPECT_GE(report.first_contact_delay_ticks, 7u);  // 40 mm at 5 mm a tick are below for 7 to 9 ticks
}

TEST(FallCheck, DelayRunsFromTheEntryToTheFirstForce) {
  lab::SurfaceSide plate(lab::flatMesh());
  lab::Observation touching = freeAt({50, 50, -1});
  touching.touching = true;
  const std::vector<lab::Observation> late{freeAt({50, 50, 1}), touching, touching, heldAt({50, 50, -1})};
  const lab::FallReport report = lab::checkFalls(plate, late);
  EXPECT_EQ(report.first_contact_delay_ticks, 2u);
  EXPECT_EQ(report.ticks, 0u) << "a tip in contact without force has not fallen";
}

TEST(FallCheck, ATipOfUnknownPastIsLetBe) {
  lab::SurfaceSide plate(lab::flatMesh());
  const std::vector<lab::Observation> under{freeAt({50, 50, -20}), freeAt({50, 50, -10})};
  EXPECT_EQ(lab::checkFalls(plate, under).ticks, 0u) << "starts inside";
  const std::vector<lab::Observation> round{freeAt({90, 50, 5}), freeAt({120, 50, 5}), freeAt({120, 50, -9}),
                                            freeAt({80, 50, -9})};
  EXPECT_EQ(lab::checkFalls(plate, round).ticks, 0u) << "comes from beyond the border";
}

TEST(FallCheck, ATipReleasedBesideTheBorderIsLetBe) {
  lab::SurfaceSide plate(lab::flatMesh());
  const std::vector<lab::Observation> sideways{heldAt({90, 50, -3}), heldAt({98, 50, -5}), freeAt({80, 50, -9})};
  EXPECT_EQ(lab::checkFalls(plate, sideways).ticks, 0u);
  const std::vector<lab::Observation> fallen{heldAt({90, 50, -3}), heldAt({94, 50, -5}), freeAt({80, 50, -9})};
  EXPECT_EQ(lab::checkFalls(plate, fallen).ticks, 1u);
}

TEST(FallCheck, ATipOnTheSurfaceHasNotFallen) {
  lab::SurfaceSide plate(lab::flatMesh());
  const std::vector<lab::Observation> ticks{freeAt({50, 50, 1}), freeAt({50, 50, 0}), freeAt({50, 50, -1e-8}),
                                            freeAt({50, 50, -1e-3})};
  const lab::FallReport report = lab::checkFalls(plate, ticks);  // the judge's tolerance is 1.4e-7 mm here
  EXPECT_EQ(report.ticks, 1u);
  EXPECT_EQ(report.first_tick, 3u);
}

TEST(SphereCheck, FindsASphereInTheSkinAndAMissedContact) {
  lab::SurfaceSide plate(lab::flatMesh());
  lab::Observation held = heldAt({50, 50, -1});
  held.centre = {50, 50, 5};
  lab::Observation sunk = held;
  sunk.centre = {50, 50, 2};
  const std::vector<lab::Observation> ticks{held, sunk, freeAt({50, 50, 4}), freeAt({50, 50, 6})};
  const lab::SphereReport report = lab::checkSphere(plate, ticks, 5.0);
  EXPECT_EQ(report.infeasible_ticks, 1u);
  EXPECT_EQ(report.missed_ticks, 1u);
  EXPECT_NEAR(report.least_distance, 0.4, 1e-12);
}

}  // namespace
}  // namespace palpate::lab
