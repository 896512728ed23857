// A simulated trainee without a body: each press has the force and depth that even tissue and its hidden place would
// give, at 100 Hz, and nothing is computed by contact or servo. For classes of hundreds of sessions in seconds; records
// are marked in their device field.
#pragma once

#include <optional>
#include <string_view>

#include "palpate/training/trainee/touching.h"

namespace palpate::training {

/// SessionRow::device of trainees who trained like this.
inline constexpr std::string_view kNoBody = "simulated, no body";
/// Interval of its samples, s.
inline constexpr double kImaginedTickS = 0.01;

class ImaginedTouch final : public Touching {
 public:
  ImaginedTouch(const Protocol& protocol, SessionKind kind);

  void change(const std::optional<HiddenNow>& hidden) override { hidden_ = hidden; }
  FeltPress press(const Site& site, const MeantPress& meant, const EachTick& each_tick) override;
  void rest(double seconds, const EachTick& each_tick) override;
  std::uint64_t tick() const override { return next_; }
  double tickS() const override { return kImaginedTickS; }
  void mark(const std::string& /*text*/) override {}
  void finish(std::int64_t /*end_ms*/) override {}

 private:
  void travelTo(const Vec3& place, const EachTick& each_tick);
  void feel(const Vec3& tip, double force_n, double depth_mm, const EachTick& each_tick);
  double stiffnessAt(int site) const;

  Protocol protocol_;
  ChangeMeaning meaning_;
  std::optional<HiddenNow> hidden_;
  std::optional<Vec3> place_;  ///< finger's place; nothing: not yet anywhere
  std::uint64_t next_ = 0;
};

}  // namespace palpate::training
