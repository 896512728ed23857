// Chooses which HTTP connection closes when there are too many: strangers, who have shown no token, for strangers;
// never one with a token for one without. A new connection is always admitted: it replaces the one that has been idle
// for longest, of the client that has most.
//
// A plain list without network or clock. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace palpate::app::serving {

/// Identifies a connection; 0 is none.
using VisitId = std::uint64_t;

struct VisitLimits {
  std::size_t strangers = 256;        ///< without a token, all clients together
  std::size_t strangers_of_one = 64;  ///< per address; not counted on loopback, where a proxy has the connections of
                                      ///< all
  std::size_t known = 256;            ///< with a token
};

class VisitBook {
 public:
  explicit VisitBook(const VisitLimits& limits = {}) : limits_(limits) {}

  // Each returns the connection to close for it, or 0; that one has left the book.

  /// A connection begins. `client`: its address, or the network that one client has; empty: on this computer.
  VisitId enter(VisitId id, const std::string& client, double now_s);
  /// It has presented a token.
  VisitId markTokenShown(VisitId id, double now_s);

  /// It made progress: a whole request arrived, or a piece of the answer was accepted.
  void moved(VisitId id, double now_s);
  void leave(VisitId id) { visits_.erase(id); }

  std::size_t size() const { return visits_.size(); }

 private:
  struct Visit {
    std::string client;
    bool known = false;
    double moved_s = 0.0;
  };
  /// Number of strangers per client.
  std::map<std::string, std::size_t> strangers() const;
  template <class Is>
  VisitId evictStalest(VisitId but, const Is& is);

  VisitLimits limits_;
  std::map<VisitId, Visit> visits_;
};

}  // namespace palpate::app::serving
