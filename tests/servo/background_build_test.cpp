#include "palpate/servo/background_build.h"

#include <gtest/gtest.h>

#include <chrono>

#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::servo {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{60};  // for a loaded machine; a build here takes milliseconds

std::shared_ptr<const mesh::TriangleMesh> shared(mesh::TriangleMesh mesh) {
  return std::make_shared<const mesh::TriangleMesh>(std::move(mesh));
}

std::optional<BuildResult> waitFor(BackgroundBuild& builder) {
  for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
    if (auto result = builder.take()) return result;
    std::this_thread::yield();
  }
  return std::nullopt;
}

}  // namespace

TEST(BackgroundBuild, HandsOverWhatWasAskedFor) {
  BackgroundBuild builder;
  EXPECT_FALSE(builder.take().has_value());
  const std::uint64_t number = builder.request(shared(zoo::sphere()), {.threshold = 64});
  const auto result = waitFor(builder);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->request, number);
  EXPECT_EQ(result->error, "");
  EXPECT_EQ(result->partition->triangle_count, zoo::sphere().triangles.size());
  EXPECT_EQ(builder.progress(), 1.0);
  EXPECT_FALSE(builder.take().has_value());  // once
}

TEST(BackgroundBuild, HandsOverAnErrorAsText) {
  BackgroundBuild builder;
  builder.request(shared(zoo::cubeWithWrongIndices()), {});
  const auto result = waitFor(builder);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->partition, nullptr);
  EXPECT_NE(result->error.find("vertex that does not exist"), std::string::npos) << result->error;
  builder.request(nullptr, {});
  EXPECT_NE(waitFor(builder)->error, "");
}

TEST(BackgroundBuild, OnlyTheLatestRequestCounts) {
  BackgroundBuild builder;
  const auto large = shared(zoo::hugeGrid(300000)), small = shared(zoo::cube());
  std::uint64_t last = 0;
  for (int i = 0; i < 20; ++i) {
    builder.request(large, {.threshold = 16});
    last = builder.request(small, {});
  }
  const auto result = waitFor(builder);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->request, last);
  EXPECT_EQ(result->partition->triangle_count, 12u);
}

TEST(BackgroundBuild, ACancelledRequestLeavesNothing) {
  BackgroundBuild builder;
  builder.request(shared(zoo::hugeGrid(300000)), {.threshold = 16});
  builder.cancel();
  const std::uint64_t next = builder.request(shared(zoo::cube()), {});
  EXPECT_EQ(waitFor(builder)->request, next);
}

TEST(BackgroundBuild, ReportsProgressWhileItBuilds) {
  BackgroundBuild builder;
  builder.request(shared(zoo::hugeGrid(400000)), {.threshold = 16});
  double last = 0.0;
  bool between = false;
  std::optional<BuildResult> result;
  for (const auto end = Clock::now() + kPatience; !result && Clock::now() < end; result = builder.take()) {
    const double now = builder.progress();
    EXPECT_GE(now, last);
    last = now;
    between = between || (now > 0.0 && now < 1.0);
    std::this_thread::yield();
  }
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(between);
  EXPECT_EQ(builder.progress(), 1.0);
}

TEST(BackgroundBuild, StopsSoonWhenItIsDestroyed) {
  const auto large = shared(zoo::hugeGrid(1000000));
  const auto begin = Clock::now();
  hdb::buildPartition(*large, {.threshold = 16});
  const auto whole = Clock::now() - begin;
  const auto start = Clock::now();
  {
    BackgroundBuild builder;
    builder.request(large, {.threshold = 16});
  }
  EXPECT_LT(Clock::now() - start, whole + std::chrono::milliseconds(100));
}

TEST(BackgroundBuild, KeepsWhatItHandedOverUntilTheNextBuild) {
  // So that dropping the last reference outside frees nothing there.
  BackgroundBuild builder;
  builder.request(shared(zoo::sphere()), {});
  auto result = waitFor(builder);
  const std::weak_ptr<const hdb::Partition> watched = result->partition;
  result.reset();
  EXPECT_FALSE(watched.expired());
  builder.request(shared(zoo::cube()), {});
  waitFor(builder);
  EXPECT_TRUE(watched.expired());
}

TEST(BackgroundBuild, ManyThreadsAskAndTakeAtOnce) {
  BackgroundBuild builder;
  const auto mesh = shared(zoo::sphere(20.0, 4));
  std::atomic<std::uint64_t> taken{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      Random random(static_cast<std::uint64_t>(t));
      for (int i = 0; i < 300; ++i) {
        if (random.below(4) == 0) builder.request(mesh, {.threshold = static_cast<Index>(1 + random.below(64))});
        if (random.below(20) == 0) builder.cancel();
        const double progress = builder.progress();
        EXPECT_TRUE(progress >= 0.0 && progress <= 1.0);
        if (const auto result = builder.take()) {
          EXPECT_EQ(result->partition->triangles.size(), mesh->triangles.size());
          ++taken;
        }
        if (random.below(8) == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::uint64_t last = builder.request(mesh, {});
  EXPECT_EQ(waitFor(builder)->request, last);
}

}  // namespace palpate::servo
