// The libraries that `--peers` compares with, as plain data: a name, and functions that build from a mesh and answer
// queries, timing themselves, so that nothing but the library is between two readings of the clock.
//
// A run of our finger is turned into the queries that a finger has to make in each tick (contactQueries); each peer
// answers the very same ones; judge.h checks the answers.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/runs/contact_run.h"
#include "palpate/contact/tool.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::bench {

/// Queries of a finger to a surface in one tick.
///
/// Point finger: where it touches, the nearest point of the skin to the tip, and whether the way from the old proxy to
/// the new one is free (lifted off the skin, for both ends lie on it); in free space, whether the way of the tip is
/// free. Sphere: the nearest point to its centre within its radius, and whether the way of the centre is free.
struct ContactQuery {
  Vec3 point = Vec3::Zero();  ///< its nearest point of the surface is wanted
  double reach = 0.0;         ///< within this distance; 0: not asked
  double bound = 0.0;         ///< <= reach: the finger's bound of the distance from its last tick
  Vec3 from = Vec3::Zero();   ///< a segment that may cross the surface, from either side
  Vec3 to = Vec3::Zero();
  Vec3 proxy = Vec3::Zero();  ///< where the finger was before this tick: the centre of a detecting box
};

struct ContactAnswer {
  double distance = std::numeric_limits<double>::infinity();  ///< to the nearest point; infinite: none, or not queried
  bool crosses = false;
};

/// One query a tick of the window, in the world's units. `finger` has real lengths.
std::vector<ContactQuery> contactQueries(const ContactWorld& world, const FingerRun& run,
                                         const contact::FingerSettings& finger, std::span<const double> time_s,
                                         const Window& window);

/// The exact answer, by our own tree: the peers' reference.
ContactAnswer exactAnswer(const tree::TriangleTree& tree, const ContactQuery& query);

/// A library's answers: `answers[i]` and `query_us[i]` belong to query `asked[i]`. All queries, or as many as the time
/// allowed, in blocks spread over the run.
template <class Answer>
struct PeerRun {
  double build_ns_per_triangle = 0.0;        ///< processor time from the mesh to the first query, one thread
  std::optional<double> bytes_per_triangle;  ///< memory of the library; nothing where it cannot be counted
  std::vector<std::uint32_t> asked;
  std::vector<Answer> answers;
  std::vector<double> query_us;
};

/// Result of a box query: how many triangles, and the sum of their hashed numbers, which does not depend on the order.
struct BoxAnswer {
  std::size_t count = 0;
  std::uint64_t sum = 0;
  friend bool operator==(const BoxAnswer&, const BoxAnswer&) = default;
};

BoxAnswer summariseTriangles(std::span<const Index> triangles);

/// Meaning of "in the box" in a library.
enum class BoxTest : std::uint8_t {
  triangle_box,  ///< the triangle's own box meets it: ours and the dissertation's
  triangle       ///< the triangle itself does
};

/// Each function builds, queries for at most `seconds`, and frees. A null function: cannot do that.
struct Peer {
  std::string name;
  std::string package;  ///< Debian's, empty: needs none
  PeerRun<ContactAnswer> (*contact)(const mesh::TriangleMesh& mesh, std::span<const ContactQuery> queries,
                                    double seconds) = nullptr;
  PeerRun<BoxAnswer> (*boxes)(const mesh::TriangleMesh& mesh, std::span<const Box3> boxes, double seconds) = nullptr;
  BoxTest box_test = BoxTest::triangle;
};

// ---- tools of several pads

/// Where a tool's parts lay on the skin, tick by tick (posesOnSkin): pads are spheres.
struct ToolQueries {
  const contact::ToolShape& shape;
  std::vector<contact::ToolPose> poses;  ///< one per part and tick
  std::size_t ticks() const { return poses.size() / shape.rest.size(); }
  std::span<const contact::ToolPose> at(std::size_t tick) const {
    return std::span(poses).subspan(tick * shape.rest.size(), shape.rest.size());
  }
  Vec3 centreOf(const contact::Pad& pad, std::size_t tick) const {
    const contact::ToolPose& pose = at(tick)[pad.part];
    return pose.position + pose.rotation * pad.offset;
  }
};

/// Number of pads on the skin.
struct ToolAnswer {
  std::size_t touching = 0;
};

/// A library of collisions, asked which pads touch. It has no proxy, depth or friction to give.
struct ToolPeer {
  std::string name;
  std::string package;
  PeerRun<ToolAnswer> (*tool)(const mesh::TriangleMesh& mesh, const ToolQueries& queries, double seconds) = nullptr;
};

/// Tests sphere against triangle, one by one; a part is one compound.
ToolPeer bulletToolPeer();
ToolPeer fclToolPeer();

/// As linkedPeers() and peersWithoutLibraries().
std::vector<ToolPeer> linkedToolPeers();
std::vector<ToolPeer> toolPeersWithoutLibraries();

// ---- those that there are

Peer embreePeer();
/// The same, but the point query starts with the distance that the last tick's proxy proves. Contact only.
Peer embreeBoundedPeer();
Peer cgalPeer();
Peer fclPeer();
/// The dissertation (instruments/study/lab/literal/hdb_contact.h): it needs no library.
Peer literalPeer();

/// All peers, in the order of reports. Those of libraries that were not found at build time cannot do anything. For
/// programs that link the target palpate_peer_libraries only.
std::vector<Peer> linkedPeers();

/// For every other program: the literal dissertation can, the libraries cannot.
std::vector<Peer> peersWithoutLibraries();

}  // namespace palpate::bench
