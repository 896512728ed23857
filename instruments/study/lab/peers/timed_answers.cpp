// Where not all queries can be afforded, blocks of consecutive ones are asked, spread over the run: what a library
// keeps from query to query still helps it.
#include "lab/peers/timed_answers.h"

#include <malloc.h>

#include <algorithm>

#include "palpate/base/hash.h"

namespace palpate::bench {

namespace {
/// Consecutive queries: long enough for a library's caches between queries to help. For the slowest shorter, so that
/// there are still some blocks.
constexpr std::size_t kLongestBlock = 64;
constexpr std::size_t kFewestBlocks = 8;
}  // namespace

std::vector<std::uint32_t> affordableQueries(std::size_t count, double query_us, double seconds) {
  const double affordable = 1e6 * seconds / std::max(query_us, 1e-3);
  std::vector<std::uint32_t> asked;
  if (affordable >= static_cast<double>(count)) {
    for (std::size_t i = 0; i < count; ++i) asked.push_back(static_cast<std::uint32_t>(i));
    return asked;
  }
  const std::size_t length =
      std::clamp<std::size_t>(static_cast<std::size_t>(affordable) / kFewestBlocks, 1, kLongestBlock);
  const std::size_t blocks = std::max(kFewestBlocks, static_cast<std::size_t>(affordable) / length);
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t first = block * count / blocks;
    const std::size_t end = std::min(first + length, (block + 1) * count / blocks);
    for (std::size_t i = first; i < end; ++i) asked.push_back(static_cast<std::uint32_t>(i));
  }
  return asked;
}

std::optional<double> heapBytes() {
#if defined(__GLIBC__)
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd);
#else
  return std::nullopt;
#endif
}

BoxAnswer summariseTriangles(std::span<const Index> triangles) {
  BoxAnswer answer;
  answer.count = triangles.size();
  for (const Index triangle : triangles) {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(triangle));
    answer.sum += hash.value();
  }
  return answer;
}

}  // namespace palpate::bench
