// Who is being answered over HTTP, and who has to go when there are too many: strangers, who have shown no token, for
// strangers; never one with a token for one without. Whoever comes gets in: for it goes the one that has been getting
// nowhere for longest, of the client that has most.
//
// A plain list: it knows no network and no clock. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace palpate::app::serving {

/// Names a connection; 0 is none.
using VisitId = std::uint64_t;

struct VisitLimits {
  std::size_t strangers = 256;        ///< without a token, of all clients
  std::size_t strangers_of_one = 64;  ///< of one address; not counted on loopback, where a proxy brings all of them
  std::size_t known = 256;            ///< with a token
};

class VisitBook {
 public:
  explicit VisitBook(const VisitLimits& limits = {}) : limits_(limits) {}

  // Each returns who is to be hung up on for it, or 0; that one is no longer in the book.

  /// A connection begins. `client`: its address, or the network that one client has; empty: on this computer.
  VisitId enter(VisitId id, const std::string& client, double now_s);
  /// It has shown a token.
  VisitId showedToken(VisitId id, double now_s);

  /// It got somewhere: a whole request came, or a piece of the answer was taken.
  void moved(VisitId id, double now_s);
  void leave(VisitId id) { visits_.erase(id); }

  std::size_t size() const { return visits_.size(); }

 private:
  struct Visit {
    std::string client;
    bool known = false;
    double moved_s = 0.0;
  };
  /// How many strangers each client has.
  std::map<std::string, std::size_t> strangers() const;
  template <class Is>
  VisitId takeOutStalest(VisitId but, const Is& is);

  VisitLimits limits_;
  std::map<VisitId, Visit> visits_;
};

}  // namespace palpate::app::serving
