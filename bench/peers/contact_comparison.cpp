#include "bench/peers/contact_comparison.h"

#include <algorithm>

namespace palpate::bench {

ContactComparison compareContact(ContactWorld& world, const device::Trajectory& trajectory,
                                 const contact::FingerSettings& real, const Window& window, std::span<const Peer> peers,
                                 double seconds_per_peer) {
  contact::check(real);
  const device::Trajectory ticks = device::resampled(trajectory, real.tick_s);
  const FingerRun run = runFinger(world.surface, contact::scaled(real, world.scale), scaledTips(ticks, world.scale));
  ContactComparison comparison;
  comparison.ours = figuresOf(world, run, real, ticks.time_s, window);
  const std::vector<ContactQuery> queries = contactQueries(world, run, real, ticks.time_s, window);
  comparison.queries = queries.size();
  comparison.nearest_asked = static_cast<std::size_t>(
      std::count_if(queries.begin(), queries.end(), [](const auto& q) { return q.reach > 0; }));
  if (!queries.empty()) comparison.peers = comparePeers(peers, world, queries, seconds_per_peer);
  return comparison;
}

}  // namespace palpate::bench
