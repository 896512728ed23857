// Work on its own thread that a display does not wait for: begun in one frame, its result used in a later one.
#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "palpate/base/background.h"

namespace palpate::viewer {

template <class T>
class AsyncTask {
 public:
  AsyncTask() = default;
  AsyncTask(const AsyncTask&) = delete;  // the work writes into this one
  AsyncTask& operator=(const AsyncTask&) = delete;

  bool busy() const { return work_.has_value(); }
  /// False, with nothing done, while other work is running.
  bool start(std::function<T()> work) {
    if (busy()) return false;
    result_ = {};
    work_.emplace([this, work = std::move(work)] {
      try {
        result_.value = work();
      } catch (const std::exception& error) {
        result_.error = error.what();
      }
    });
    return true;
  }
  struct Result {
    std::optional<T> value = {};
    std::string error = {};  ///< why `value` is empty
  };
  /// Returns the result once.
  std::optional<Result> collectResult() {
    if (!work_ || !work_->done()) return std::nullopt;
    work_->join();
    work_.reset();
    return std::exchange(result_, {});
  }

 private:
  Result result_;                   // the work's, until it is done
  std::optional<Background> work_;  // last: it uses the result
};

}  // namespace palpate::viewer
