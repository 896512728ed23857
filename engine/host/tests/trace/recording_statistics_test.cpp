// Statistics of recordings: hand-made samples whose contacts, phases and sizes are known, judged by sorting and
// counting.
#include "palpate/trace/recording_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::trace {
namespace {

Sample freeAt(std::uint64_t tick, const Vec3& tip = Vec3::Zero()) {
  Sample sample;
  sample.tick = tick;
  sample.contact.tip = tip;
  sample.contact.proxy = tip;
  return sample;
}

Sample pressedAt(std::uint64_t tick, double force_n, const Vec3& proxy = Vec3::Zero()) {
  Sample sample = freeAt(tick, proxy);
  sample.contact.touch = contact::Touch::stick;
  sample.contact.force = {0.0, 0.6 * force_n, 0.8 * force_n};
  sample.contact.depth_mm = 2.0 * force_n;
  sample.contact.triangle = 3;
  return sample;
}

RecordingStatistics statisticsOf(const std::vector<Sample>& samples, double rate = 1000.0) {
  RecordingMeasurement measurement(1, rate);
  for (const Sample& sample : samples) measurement.add(std::span(&sample, 1));
  return measurement.finish();
}

/// Pressed in the ticks of `touching` and nowhere else.
std::vector<Sample> tapped(const std::vector<bool>& touching) {
  std::vector<Sample> samples;
  for (std::size_t tick = 0; tick < touching.size(); ++tick) {
    samples.push_back(touching[tick] ? pressedAt(tick, 1.0) : freeAt(tick));
  }
  return samples;
}

// --- distributions and series ---

TEST(FixedHistogram, TellsQuantilesWithinABinOfTheSortedValues) {
  Random random(7);
  std::vector<double> values;
  FixedHistogram histogram(0.25);
  for (int i = 0; i < 5000; ++i) {
    values.push_back(std::pow(10.0, 3.0 * random.uniform(0.0, 1.0)));
    histogram.add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double share : {0.05, 0.5, 0.95, 0.99}) {
    const auto rank = static_cast<std::size_t>(share * 5000.0);
    EXPECT_GE(histogram.quantile(share), values[rank - 1] - 0.25) << share;
    EXPECT_LE(histogram.quantile(share), values[rank] + 0.25) << share;
  }
  EXPECT_NEAR(histogram.mean(), std::accumulate(values.begin(), values.end(), 0.0) / 5000.0, 1e-9);
  EXPECT_EQ(histogram.greatest(), values.back());
  EXPECT_EQ(histogram.least(), values.front());
}

TEST(FixedHistogram, TellsAQuantileBetweenTheEdgesOfABin) {
  FixedHistogram histogram(100.0);
  for (int i = 0; i <= 99; ++i) histogram.add(i);
  EXPECT_NEAR(histogram.quantile(0.25), 25.0, 1.0);
  EXPECT_NEAR(histogram.quantile(0.75), 75.0, 1.0);
}

TEST(FixedHistogram, CountsWhatLiesBeyondAndNotWhatIsNoNumber) {
  FixedHistogram histogram(1.0);
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  for (const double value : {-1.0, 2.5, 1e9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    histogram.add(value);
  }
  EXPECT_EQ(histogram.count(), 3u);
  EXPECT_EQ(histogram.beyond(), 1u);
  EXPECT_EQ(histogram.quantile(1.0), 1e9);
  EXPECT_EQ(histogram.bins()[0], 1u);
}

TEST(Extremes, OfTwoAreThoseOfAllValuesInEitherOrderAndOfNone) {
  Extremes low, high;
  for (const double value : {3.0, 4.0}) low.add(value);
  for (const double value : {7.0, 5.0}) high.add(value);
  for (const auto& [first, second] : {std::pair(low, high), std::pair(high, low)}) {
    Extremes all;
    all.add(Extremes{});
    all.add(first);
    all.add(second);
    EXPECT_EQ(all.least, 3.0);
    EXPECT_EQ(all.greatest, 7.0);
    EXPECT_EQ(all.count, 4u);
  }
}

TEST(TickSeries, KeepsTimeSpikesAndSumsInSoManyBuckets) {
  TickSeries series;
  double sum = 0.0;
  for (std::uint64_t tick = 500; tick < 100'500; ++tick) {
    if (tick >= 40'000 && tick < 60'000) continue;  // nothing was recorded
    const double value = tick == 77'777 ? 40.0 : static_cast<double>(tick % 7);
    series.add(tick, {value, 0.0, std::nan(""), 0.0}, tick % 2 == 0);
    sum += value;
  }
  ASSERT_LE(series.buckets().size(), TickSeries::kMaxBuckets);
  EXPECT_GT(series.buckets().size(), TickSeries::kMaxBuckets / 2 - 1);
  EXPECT_EQ(series.firstTick(), 500u);
  double seen = 0.0;
  std::uint64_t ticks = 0;
  std::uint64_t touching = 0;
  for (std::size_t i = 0; i < series.buckets().size(); ++i) {
    const SeriesBucket& bucket = series.buckets()[i];
    const std::uint64_t from = 500 + i * series.ticksPerBucket();
    seen += bucket.values[0].sum;
    ticks += bucket.ticks;
    touching += bucket.touching;
    const bool has_spike = from <= 77'777 && 77'777 < from + series.ticksPerBucket();
    EXPECT_EQ(bucket.values[0].greatest == 40.0, has_spike) << i;
    if (from >= 40'000 && from + series.ticksPerBucket() <= 60'000) {
      EXPECT_EQ(bucket.ticks, 0u) << i;
    }
    EXPECT_EQ(bucket.values[2].count, 0u) << "never known";
  }
  EXPECT_EQ(seen, sum);
  EXPECT_EQ(ticks, 80'000u);
  EXPECT_EQ(touching, 40'000u);
}

// --- contacts ---

TEST(RecordingStatistics, ABreakOfTwentyMillisecondsIsNoneAndALongerOneIs) {
  std::vector<bool> touching(600, false);
  std::fill(touching.begin() + 100, touching.begin() + 300, true);
  std::fill(touching.begin() + 320, touching.begin() + 400, true);  // 20 ticks between
  std::fill(touching.begin() + 421, touching.begin() + 431, true);  // 21 ticks between
  const RecordingStatistics s = statisticsOf(tapped(touching));
  ASSERT_EQ(s.contacts.size(), 2u);
  EXPECT_EQ(s.contacts[0].first_tick, 100u);
  EXPECT_EQ(s.contacts[0].last_tick, 399u);
  EXPECT_EQ(s.contacts[0].touching, 280u);
  EXPECT_EQ(s.contacts[1].first_tick, 421u);
  EXPECT_EQ(s.contacts[1].ticks(), 10u);
  EXPECT_EQ(s.fingers[0].touching, 290u);
  EXPECT_EQ(s.fingers[0].longest_contact_ticks, 300u);
}

/// Runs of touching ticks, then those joined that are near: the same by other means.
std::vector<std::pair<std::uint64_t, std::uint64_t>> runsOf(const std::vector<bool>& touching, std::size_t gap) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> runs;
  for (std::size_t tick = 0; tick < touching.size(); ++tick) {
    if (!touching[tick]) continue;
    if (!runs.empty() && tick - runs.back().second - 1 <= gap) {
      runs.back().second = tick;
    } else {
      runs.emplace_back(tick, tick);
    }
  }
  return runs;
}

TEST(RecordingStatistics, FindsTheContactsOfRandomTaps) {
  Random random(3);
  for (const double rate : {1000.0, 500.0, 2000.0}) {
    std::vector<bool> touching;
    while (touching.size() < 20'000) {
      const bool now = random.below(2) == 0;
      touching.insert(touching.end(), 1 + random.below(60), now);
    }
    const RecordingStatistics s = statisticsOf(tapped(touching), rate);
    const auto runs = runsOf(touching, static_cast<std::size_t>(0.02 * rate));
    ASSERT_EQ(s.contacts.size(), runs.size()) << rate;
    ASSERT_GT(runs.size(), 50u);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      EXPECT_EQ(s.contacts[i].first_tick, runs[i].first);
      EXPECT_EQ(s.contacts[i].last_tick, runs[i].second);
    }
  }
}

TEST(RecordingStatistics, AContactTellsItsPeakItsMeanItsPathAndItsPlace) {
  std::vector<Sample> samples;
  for (std::uint64_t tick = 0; tick < 200; ++tick) {
    const double force = tick == 120 ? 5.0 : 1.0;
    // Out along x and back, half a millimetre a tick; 30 um of tremor across.
    const double x = 0.5 * static_cast<double>(tick < 100 ? tick : 199 - tick);
    samples.push_back(pressedAt(tick, force, {x, tick % 2 == 0 ? 0.03 : 0.0, 7.0}));
  }
  const RecordingStatistics s = statisticsOf(samples);
  ASSERT_EQ(s.contacts.size(), 1u);
  const Contact& contact = s.contacts[0];
  EXPECT_DOUBLE_EQ(contact.peak_force_n, 5.0);
  EXPECT_NEAR(contact.mean_force_n, (199.0 + 5.0) / 200.0, 1e-12);
  EXPECT_DOUBLE_EQ(contact.peak_depth_mm, 10.0);
  EXPECT_NEAR(contact.path_mm, 99.0, 0.5);
  EXPECT_NEAR(contact.peak_place.x(), 39.5, 1e-12);
  EXPECT_EQ(contact.peak_place.z(), 7.0);
}

TEST(RecordingStatistics, TremblingInPlaceIsNoPath) {
  std::vector<Sample> samples;
  for (std::uint64_t tick = 0; tick < 5000; ++tick) {
    samples.push_back(pressedAt(tick, 1.0, {tick % 2 == 0 ? 0.05 : 0.0, 0.0, 0.0}));
  }
  const RecordingStatistics s = statisticsOf(samples);
  EXPECT_LT(s.contacts[0].path_mm, 0.1);
  EXPECT_LT(s.fingers[0].of(Measured::proxy_speed).greatest(), 10.0) << "50 um a tick would be 50 mm/s";
}

TEST(RecordingStatistics, AFingerThatWasPutElsewhereBeginsAnotherContactAndHasNoSpeed) {
  std::vector<Sample> samples;
  for (std::uint64_t tick = 0; tick < 400; ++tick) {
    samples.push_back(pressedAt(tick, 1.0, {tick < 200 ? 0.0 : 300.0, 0.0, 0.0}));
    if (tick == 200) samples.back().forgot = kForgotTouch;
  }
  const RecordingStatistics s = statisticsOf(samples);
  ASSERT_EQ(s.contacts.size(), 2u);
  EXPECT_EQ(s.contacts[0].path_mm, 0.0);
  EXPECT_EQ(s.fingers[0].of(Measured::proxy_speed).greatest(), 0.0);
}

TEST(RecordingStatistics, ListsEndButCountsGoOn) {
  constexpr std::uint64_t kTaps = 7000;
  std::vector<bool> touching;
  for (std::uint64_t i = 0; i < kTaps; ++i) {
    touching.push_back(true);
    touching.insert(touching.end(), 25, false);
  }
  const RecordingStatistics s = statisticsOf(tapped(touching));
  EXPECT_EQ(s.contacts.size(), kMaxListed);
  EXPECT_EQ(s.contact_count, kTaps);
  EXPECT_EQ(s.fingers[0].contacts, kTaps);
  EXPECT_EQ(s.fingers[0].touching, kTaps);
  EXPECT_LE(s.fingers[0].series.buckets().size(), TickSeries::kMaxBuckets);
  EXPECT_EQ(s.places.size(), 1u) << "all in one place";
  EXPECT_EQ(s.places[0].ticks, kTaps);
}

// --- sizes ---

TEST(RecordingStatistics, SizesAreOfTicksInContact) {
  std::vector<Sample> samples;
  std::vector<double> forces;
  Random random(11);
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    const double force = random.uniform(0.1, 8.0);
    if (tick % 3 == 0) {
      samples.push_back(freeAt(tick));
      samples.back().contact.force = {9.0, 0.0, 0.0};  // a force that fades after the skin was left
    } else {
      samples.push_back(pressedAt(tick, force));
      forces.push_back(force);
    }
  }
  std::sort(forces.begin(), forces.end());
  const FingerStatistics finger = statisticsOf(samples).fingers[0];
  const FixedHistogram& force = finger.of(Measured::force);
  EXPECT_EQ(finger.touching, forces.size());
  EXPECT_NEAR(force.mean(), std::accumulate(forces.begin(), forces.end(), 0.0) / 2000.0, 1e-9);
  EXPECT_NEAR(force.quantile(0.5), forces[1000], 0.02);
  EXPECT_NEAR(force.quantile(0.95), forces[1900], 0.02);
  EXPECT_NEAR(force.greatest(), forces.back(), 1e-12);
  EXPECT_NEAR(finger.of(Measured::depth).greatest(), 2.0 * forces.back(), 1e-12);
}

TEST(RecordingStatistics, SpeedIsMillimetresASecondAtEveryRate) {
  for (const double rate : {500.0, 1000.0, 4000.0}) {
    std::vector<Sample> samples;
    for (std::uint64_t tick = 0; tick < 2000; ++tick) {
      samples.push_back(pressedAt(tick, 1.0, {0.0, 30.0 * static_cast<double>(tick) / rate, 0.0}));
      samples.back().contact.tip = 2.0 * samples.back().contact.proxy;
    }
    const FingerStatistics finger = statisticsOf(samples, rate).fingers[0];
    EXPECT_NEAR(finger.of(Measured::proxy_speed).mean(), 30.0, 1e-9) << rate;
    EXPECT_NEAR(finger.of(Measured::tip_speed).greatest(), 60.0, 1e-9) << rate;
  }
}

TEST(RecordingStatistics, TheWayDownToTheSkinIsNoWayOverIt) {
  std::vector<Sample> samples;
  for (std::uint64_t tick = 0; tick < 500; ++tick) {
    const double height = 100.0 - 0.4 * static_cast<double>(tick);  // 400 mm/s, the skin at 20 mm
    samples.push_back(height > 20.0 ? freeAt(tick, {0.0, 0.0, height}) : pressedAt(tick, 1.0, {0.0, 0.0, 20.0}));
    samples.back().contact.tip.z() = height;
  }
  const FingerStatistics finger = statisticsOf(samples).fingers[0];
  EXPECT_EQ(finger.of(Measured::proxy_speed).greatest(), 0.0);
  EXPECT_NEAR(finger.of(Measured::tip_speed).greatest(), 400.0, 1e-9);
}

// --- phases ---

TEST(RecordingStatistics, SearchIsLightOrMovingAndPalpationPressesInPlace) {
  std::vector<Sample> samples;
  Vec3 place = Vec3::Zero();
  for (std::uint64_t tick = 0; tick < 5000; ++tick) {
    const bool glides = tick >= 2000 && tick < 3000;
    if (glides) place.x() += 0.04;  // 40 mm/s
    if (tick < 1000) {
      samples.push_back(freeAt(tick, place));
    } else {
      samples.push_back(pressedAt(tick, tick < 1500 ? 0.2 : 2.0, place));
    }
    if (tick >= 4000 && tick < 4100) samples.back() = freeAt(tick, place);  // shorter than a phase
  }
  const RecordingStatistics s = statisticsOf(samples);
  std::vector<Phase> kinds;
  for (const PhaseSpan& phase : s.phases) kinds.push_back(phase.phase);
  EXPECT_EQ(kinds, (std::vector<Phase>{Phase::away, Phase::search, Phase::palpation, Phase::search, Phase::palpation}));
  ASSERT_EQ(s.phases.size(), 5u);
  EXPECT_EQ(s.phases[1].first_tick, 1000u);
  EXPECT_EQ(s.phases[2].first_tick, 1500u);
  EXPECT_NEAR(static_cast<double>(s.phases[3].first_tick), 2000.0, 20.0) << "within the window of speed";
  EXPECT_NEAR(static_cast<double>(s.phases[4].first_tick), 3000.0, 20.0);
  EXPECT_EQ(s.phases[4].last_tick, 4999u);
  std::uint64_t all = 0;
  for (const std::uint64_t ticks : s.fingers[0].phase_ticks) all += ticks;
  EXPECT_EQ(all, 5000u) << "no tick is lost or counted twice";
  EXPECT_EQ(s.fingers[0].phase_ticks[0], 1000u);
}

TEST(RecordingStatistics, PhasesFillRandomCoursesWithoutHolesOrOverlap) {
  Random random(23);
  for (int round = 0; round < 20; ++round) {
    std::vector<Sample> samples;
    std::uint64_t tick = 0;
    while (samples.size() < 10'000) {
      const std::uint32_t kind = random.below(3);
      for (std::uint32_t left = 1 + random.below(600); left > 0; --left, ++tick) {
        samples.push_back(kind == 0 ? freeAt(tick) : pressedAt(tick, kind == 1 ? 0.1 : 3.0));
      }
    }
    const RecordingStatistics s = statisticsOf(samples);
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < s.phases.size(); ++i) {
      EXPECT_EQ(s.phases[i].first_tick, next);
      next = s.phases[i].last_tick + 1;
      const bool inner = i > 0 && i + 1 < s.phases.size();
      if (inner) {
        EXPECT_GE(s.phases[i].ticks(), 250u);
        EXPECT_NE(s.phases[i].phase, s.phases[i - 1].phase);
      }
    }
    EXPECT_EQ(next, samples.size());
  }
}

// --- the recording itself ---

TEST(RecordingStatistics, CountsMissingTicksGapsAndBits) {
  std::vector<Sample> samples;
  for (std::uint64_t tick = 100; tick < 1000; ++tick) {
    if (tick == 300 || (tick >= 500 && tick < 540) || tick == 900) continue;
    samples.push_back(pressedAt(tick, 1.0));
    if (tick % 100 < 10) samples.back().safety = 1u << 5;
    if (tick >= 700 && tick < 800) samples.back().safety |= 1u << 11;
    samples.back().world = tick < 600 ? 0 : 1;
  }
  samples.push_back(pressedAt(400, 1.0));  // which no writer leaves
  const RecordingStatistics s = statisticsOf(samples);
  EXPECT_EQ(s.ticks.expected(), 900u);
  EXPECT_EQ(s.ticks.recorded, 858u);
  EXPECT_EQ(s.ticks.missing(), 42u);
  EXPECT_EQ(s.ticks.gaps, 3u);
  EXPECT_EQ(s.ticks.longest_gap.after_tick, 499u);
  EXPECT_EQ(s.ticks.longest_gap.missing, 40u);
  EXPECT_EQ(s.ticks.out_of_order, 1u);
  const BitTallies& safety = s.fingers[0].safety;
  EXPECT_EQ(safety[5].ticks, 9u * 10u - 1u - 10u - 1u) << "those of the gaps were not recorded";
  EXPECT_EQ(safety[5].times, 8u);
  EXPECT_EQ(safety[5].first_tick, 100u);
  EXPECT_EQ(safety[11].times, 1u);
  EXPECT_EQ(safety[11].ticks, 100u);
  EXPECT_EQ(safety[0].ticks, 0u);
  EXPECT_EQ(s.world_changes, 1u);
  ASSERT_EQ(s.worlds.size(), 2u);
  EXPECT_EQ(s.worlds[1].tick, 600u);
  EXPECT_EQ(s.contact_count, 2u) << "forty ticks without a record part a contact, one does not";
}

TEST(RecordingStatistics, OfNothingAreZero) {
  const RecordingStatistics s = statisticsOf({});
  EXPECT_EQ(s.ticks.expected(), 0u);
  EXPECT_EQ(s.ticks.missing(), 0u);
  EXPECT_TRUE(s.contacts.empty());
  EXPECT_TRUE(s.phases.empty());
  EXPECT_TRUE(s.places.empty());
}

TEST(RecordingStatistics, BearWhatNoWriterWrites) {
  std::vector<Sample> samples;
  Random random(17);
  std::uint64_t tick = 0;
  for (int i = 0; i < 2000; ++i) {
    tick += i % 50 == 0 ? std::uint64_t{1} << random.below(58) : 1;
    Sample sample = pressedAt(tick, 1.0);
    sample.contact.proxy.x() = i % 3 == 0 ? std::nan("") : std::pow(10.0, random.uniform(-300.0, 300.0));
    sample.contact.depth_mm = i % 5 == 0 ? std::nan("") : std::pow(10.0, random.uniform(-300.0, 300.0));
    if (i % 7 == 0) sample.contact.force.x() = std::numeric_limits<double>::infinity();
    sample.contact.triangle = random.below(1u << 31);
    sample.world = random.below(1u << 31);
    sample.finger = i % 11 == 0 ? 900 : 0;
    sample.safety = random.below(1u << 31);
    samples.push_back(sample);
  }
  const RecordingStatistics s = statisticsOf(samples);
  EXPECT_EQ(s.ticks.recorded, samples.size());
  EXPECT_LE(s.fingers[0].series.buckets().size(), TickSeries::kMaxBuckets);
  EXPECT_LE(s.worlds.size(), kMaxListed);
}

TEST(RecordingStatistics, OfAFileAreThoseOfItsSpan) {
  const support::TemporaryFolder folder;
  {
    RecordingWriter writer(
        folder / "a.session",
        {.started_utc = "2026-11-21T12:00:00Z", .software = "", .machine = "", .notes = {}, .tags = {}},
        {{"index", "script"}, {"middle", "mouse"}});
    for (std::uint64_t tick = 0; tick < 1000; ++tick) {
      for (std::uint32_t finger = 0; finger < 2; ++finger) {
        Sample sample = finger == 1 ? pressedAt(tick, 2.0) : freeAt(tick);
        sample.finger = finger;
        writer.add(sample);
      }
    }
    writer.finish("done");
  }
  RecordingReader reader(folder / "a.session");
  const RecordingStatistics s = measure(reader, {200, 449});
  EXPECT_EQ(s.ticks.recorded, 250u);
  EXPECT_EQ(s.ticks.first, 200u);
  EXPECT_EQ(s.fingers[0].touching, 0u);
  EXPECT_EQ(s.fingers[1].touching, 250u);
  ASSERT_EQ(s.contacts.size(), 1u);
  EXPECT_EQ(s.contacts[0].finger, 1u);
  EXPECT_DOUBLE_EQ(s.contacts[0].peak_force_n, 2.0);
  Database(folder / "a.session", Database::Mode::write).run("UPDATE blocks SET crc32 = crc32 + 1 WHERE id = 3");
  RecordingReader damaged(folder / "a.session");
  EXPECT_THROW(measure(damaged), Error);
}

// --- places ---

TEST(TouchedPlaces, ARoundPlaceIsTouchedOnAFineAndOnACoarseSheet) {
  const TouchedPlace place{
      .world = 0, .finger = 0, .triangle = kNoIndex, .place = {50.0, 50.0, 0.0}, .ticks = 40, .peak_force_n = 2.5};
  for (const int cells : {1, 4, 40}) {
    const TouchedSurface surface = touchedSurface(zoo::grid(cells, 100.0), std::span(&place, 1), std::vector{8.0});
    EXPECT_NEAR(surface.touched_mm2, std::numbers::pi * 64.0, 0.04 * std::numbers::pi * 64.0) << cells;
    EXPECT_NEAR(surface.dorsal_mm2, 1e4, 1e-6) << cells;
    EXPECT_EQ(surface.touched_dorsal_mm2, surface.touched_mm2);
    EXPECT_EQ(surface.astray_ticks, 0u);
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
      const double distance = (mesh::centreOf(surface.mesh, surface.mesh.triangles[t]) - place.place).norm();
      EXPECT_EQ(surface.ticks[t], distance <= 8.0 ? 40.0 : 0.0);
      EXPECT_EQ(surface.peak_force_n[t], distance <= 8.0 ? 2.5 : 0.0);
    }
  }
}

TEST(TouchedPlaces, SkinThatIsFineEnoughIsNotCut) {
  const TouchedPlace place{
      .world = 0, .finger = 0, .triangle = kNoIndex, .place = {50.0, 50.0, 0.0}, .ticks = 1, .peak_force_n = 1.0};
  const mesh::TriangleMesh fine = zoo::grid(100, 100.0);  // sides of 1.4 mm
  EXPECT_EQ(touchedSurface(fine, std::span(&place, 1), std::vector{8.0}).mesh.triangles.size(), fine.triangles.size());
  EXPECT_GT(touchedSurface(fine, std::span(&place, 1), std::vector{4.0}).mesh.triangles.size(), fine.triangles.size());
}

TEST(TouchedPlaces, AddTimesAndKeepTheGreatestForce) {
  const std::vector<TouchedPlace> places = {{0, 0, 0, {50.0, 50.0, 0.0}, 10, 3.0},
                                            {0, 1, 0, {52.0, 50.0, 0.0}, 5, 1.0}};
  const TouchedSurface surface = touchedSurface(zoo::grid(10, 100.0), places, std::vector{8.0, 3.0});
  const auto both = std::max_element(surface.ticks.begin(), surface.ticks.end());
  EXPECT_EQ(*both, 15.0);
  EXPECT_EQ(surface.peak_force_n[static_cast<std::size_t>(both - surface.ticks.begin())], 3.0);
}

TEST(TouchedPlaces, DoNotReachThroughAThinBody) {
  const mesh::TriangleMesh plate = zoo::plate(50.0, 2.0);
  const TouchedPlace on_top{
      .world = 0, .finger = 0, .triangle = kNoIndex, .place = {25.0, 25.0, 2.0}, .ticks = 1, .peak_force_n = 1.0};
  const TouchedSurface surface = touchedSurface(plate, std::span(&on_top, 1), std::vector{8.0});
  EXPECT_GT(surface.touched_mm2, 180.0);
  EXPECT_EQ(surface.touched_mm2, surface.touched_dorsal_mm2);
  EXPECT_NEAR(surface.dorsal_mm2, 2500.0, 1e-6) << "one side of the plate is the back";
}

TEST(TouchedPlaces, TellWhatLiesOnNoSkin) {
  const TouchedPlace lost{
      .world = 0, .finger = 0, .triangle = 0, .place = {50.0, 50.0, 90.0}, .ticks = 7, .peak_force_n = 1.0};
  const TouchedSurface surface = touchedSurface(zoo::grid(4, 100.0), std::span(&lost, 1), std::vector{8.0});
  EXPECT_EQ(surface.astray_ticks, 7u);
  EXPECT_EQ(surface.touched_mm2, 0.0);
}

TEST(TouchedPlaces, CollectTimeAndPeakByCell) {
  PlaceCollector collector;
  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    collector.add(pressedAt(tick, tick == 30 ? 4.0 : 1.0, {0.01 * static_cast<double>(tick), 0.5, 0.5}));
    collector.add(freeAt(tick));
  }
  collector.add(pressedAt(100, 1.0, {40.0, 0.5, 0.5}));
  collector.add(pressedAt(101, 1.0, {std::nan(""), 0.0, 0.0}));
  const std::vector<TouchedPlace> places = collector.places();
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].ticks, 100u);
  EXPECT_EQ(places[0].peak_force_n, 4.0);
  EXPECT_NEAR(places[0].place.x(), 0.495, 1e-12);
  EXPECT_EQ(places[1].ticks, 1u);
  EXPECT_EQ(collector.leftOut(), 1u);
}

}  // namespace
}  // namespace palpate::trace
