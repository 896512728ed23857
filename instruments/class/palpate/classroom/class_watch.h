// The instructor's connection: messages of the broker go onto a board (class_board.h), commands go out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/classroom/class_board.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/messages.h"

namespace palpate::classroom {

class ClassWatch {
 public:
  /// A broker that is not there is waited for. Throws Error for certificates that cannot be used.
  explicit ClassWatch(const Member& instructor);
  ~ClassWatch();
  ClassWatch(const ClassWatch&) = delete;
  ClassWatch& operator=(const ClassWatch&) = delete;

  // Any thread; of now.
  std::vector<Tile> tiles() const;
  std::optional<Tile> tile(const std::string& station) const;
  std::vector<ForcePoint> forces(const std::string& station) const;  ///< `s`: before now, negative
  std::vector<CurvePoint> learningCurve() const;
  void remember(const training::Uuid& trainee, const training::BlockRow& block);

  /// Sends to one station; forgotten after ten seconds. False: it could not be sent.
  bool ask(const std::string& station, const Command& command);

  bool connected() const;
  std::string trouble() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::classroom
