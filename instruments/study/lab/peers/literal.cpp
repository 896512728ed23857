// The literal dissertation as a peer, answering as the libraries do.
#include "lab/literal/hdb_contact.h"
#include "lab/peers/timed_answers.h"

namespace palpate::bench {

namespace {

PeerRun<ContactAnswer> answerContact(const mesh::TriangleMesh& mesh, std::span<const ContactQuery> queries,
                                     double seconds) {
  PeerRun<ContactAnswer> run;
  auto contact = timedBuild(mesh.triangles.size(), run, [&] { return literal::buildHdbContact(mesh); });
  timeContactAnswers(
      queries, seconds, run,
      [&](const ContactQuery& q) { return literal::nearestInLeaves(contact, q.proxy, q.point, q.reach); },
      [&](const ContactQuery& q) { return literal::crossesInLeaves(contact, q.proxy, q.from, q.to); });
  return run;
}

PeerRun<BoxAnswer> answerBoxes(const mesh::TriangleMesh& mesh, std::span<const Box3> boxes, double seconds) {
  PeerRun<BoxAnswer> run;
  auto contact = timedBuild(mesh.triangles.size(), run, [&] { return literal::buildHdbContact(mesh); });
  std::vector<Index> found;
  const auto ask = [&](std::size_t i) { literal::trianglesInLeaves(contact, boxes[i], found); };
  timeAnswers(boxes.size(), seconds, run, ask, [&](std::size_t) { return summariseTriangles(found); });
  return run;
}

}  // namespace

Peer literalPeer() { return {"literal", "", answerContact, answerBoxes, BoxTest::triangle_box}; }

}  // namespace palpate::bench
