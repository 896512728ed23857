// The libraries that `--peers` compares with, as plain data: a name, and functions that build from a mesh and answer
// queries, timing themselves, so that nothing but the library is between two readings of the clock.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/peers/contact_queries.h"
#include "palpate/partition/haptic_box.h"

namespace palpate::bench {

/// What a library answered: `answers[i]` and `query_us[i]` belong to query `asked[i]`. All queries, or as many as the
/// time allowed, in blocks spread over the run.
template <class Answer>
struct PeerRun {
  double build_ns_per_triangle = 0.0;        ///< processor time from the mesh to the first query, one thread
  std::optional<double> bytes_per_triangle;  ///< what the library keeps; none where it cannot be counted
  std::vector<std::uint32_t> asked;
  std::vector<Answer> answers;
  std::vector<double> query_us;
};

/// What a box query found: how many triangles, and the sum of their hashed numbers, which does not depend on the order.
struct BoxAnswer {
  std::size_t count = 0;
  std::uint64_t sum = 0;
  friend bool operator==(const BoxAnswer&, const BoxAnswer&) = default;
};

BoxAnswer summaryOf(std::span<const Index> triangles);

/// What "in the box" means to a library.
enum class BoxTest : std::uint8_t {
  triangle_box,  ///< the triangle's own box meets it: ours and the dissertation's
  triangle       ///< the triangle itself does
};

/// Each function builds, asks for at most `seconds`, and frees. A null function: cannot do that.
struct Peer {
  std::string name;
  std::string package;  ///< Debian's, empty: needs none
  PeerRun<ContactAnswer> (*contact)(const mesh::TriangleMesh& mesh, std::span<const ContactQuery> queries,
                                    double seconds) = nullptr;
  PeerRun<BoxAnswer> (*boxes)(const mesh::TriangleMesh& mesh, std::span<const partition::Box3> boxes,
                              double seconds) = nullptr;
  BoxTest box_test = BoxTest::triangle;
};

}  // namespace palpate::bench
