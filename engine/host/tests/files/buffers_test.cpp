#include <gtest/gtest.h>

#include <thread>

#include "palpate/base/ring_buffer.h"
#include "palpate/base/triple_buffer.h"

namespace palpate {
namespace {

/// A value whose parts must belong together: a torn read shows.
struct TwoParts {
  std::uint64_t a = 0;
  std::uint64_t b = 0;
};

TEST(TripleBuffer, ReaderSeesTheNewestAndKeepsItUntilAsked) {
  TripleBuffer<int> buffer(7);
  EXPECT_EQ(buffer.newest(), 7);
  buffer.publish(1);
  buffer.publish(2);
  const int& seen = buffer.newest();
  EXPECT_EQ(seen, 2);
  buffer.publish(3);
  buffer.publish(4);
  EXPECT_EQ(seen, 2);
  EXPECT_EQ(buffer.newest(), 4);
  EXPECT_EQ(buffer.newest(), 4);
}

TEST(TripleBuffer, NeverTearsOrGoesBackwardsBetweenThreads) {
  constexpr std::uint64_t kLast = 50000;
  TripleBuffer<TwoParts> buffer;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) buffer.publish({i, ~i});
  });
  std::uint64_t last = 0;
  while (last < kLast) {
    const TwoParts seen = buffer.newest();
    if (seen.a != 0) {
      ASSERT_EQ(seen.b, ~seen.a);
    }
    ASSERT_GE(seen.a, last);
    last = seen.a;
  }
  writer.join();
}

TEST(RingBuffer, DropsAndCountsWhenFull) {
  RingBuffer<int> ring(3);
  ASSERT_EQ(ring.capacity(), 4u);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(ring.push(i), i < 4);
  EXPECT_EQ(ring.dropped(), 2u);
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
}

TEST(RingBuffer, KeepsOrderBetweenThreads) {
  constexpr std::uint64_t kLast = 50000;
  RingBuffer<TwoParts> ring(64);
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= kLast;) i += ring.push({i, ~i}) ? 1 : 0;
  });
  TwoParts value;
  for (std::uint64_t expected = 1; expected <= kLast;) {
    if (!ring.pop(value)) continue;
    ASSERT_EQ(value.a, expected);
    ASSERT_EQ(value.b, ~expected);
    ++expected;
  }
  producer.join();
}

}  // namespace
}  // namespace palpate
