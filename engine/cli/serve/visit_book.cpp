#include "cli/serve/visit_book.h"

#include <algorithm>

namespace palpate::app::serving {

std::map<std::string, std::size_t> VisitBook::strangers() const {
  std::map<std::string, std::size_t> counts;
  for (const auto& [id, visit] : visits_) {
    if (!visit.known) ++counts[visit.client];
  }
  return counts;
}

template <class Is>
VisitId VisitBook::evictStalest(VisitId but, const Is& is) {
  auto stalest = visits_.end();
  for (auto at = visits_.begin(); at != visits_.end(); ++at) {
    if (at->first == but || !is(at->second)) continue;
    if (stalest == visits_.end() || at->second.moved_s < stalest->second.moved_s) stalest = at;
  }
  if (stalest == visits_.end()) return 0;
  const VisitId id = stalest->first;
  visits_.erase(stalest);
  return id;
}

VisitId VisitBook::enter(VisitId id, const std::string& client, double now_s) {
  visits_[id] = {client, false, now_s};
  const auto counts = strangers();
  const bool local = client.empty();
  std::string crowded = client;
  if (local || counts.at(client) <= limits_.strangers_of_one) {
    std::size_t all = 0;
    for (const auto& [of, count] : counts) all += count;
    if (all <= limits_.strangers) return 0;
    crowded = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                return a.second < b.second;
              })->first;
  }
  return evictStalest(id, [&](const Visit& visit) { return !visit.known && visit.client == crowded; });
}

VisitId VisitBook::markTokenShown(VisitId id, double now_s) {
  const auto at = visits_.find(id);
  if (at == visits_.end()) return 0;
  at->second.moved_s = now_s;
  if (at->second.known) return 0;
  at->second.known = true;
  const auto known = static_cast<std::size_t>(
      std::count_if(visits_.begin(), visits_.end(), [](const auto& visit) { return visit.second.known; }));
  if (known <= limits_.known) return 0;
  return evictStalest(id, [](const Visit& visit) { return visit.known; });
}

void VisitBook::moved(VisitId id, double now_s) {
  if (const auto at = visits_.find(id); at != visits_.end()) at->second.moved_s = now_s;
}

}  // namespace palpate::app::serving
