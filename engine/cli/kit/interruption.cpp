// The handler does only what is safe there: it reads and stores lock-free numbers, writes a line and leaves by _exit.
// Work under FinishesInOrder checks the number at its next report of progress.
#include "cli/kit/interruption.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

#include "palpate/base/output_file.h"
#include "palpate/base/system/signals.h"

namespace palpate::app {

namespace {

struct EndingSignal {
  int number;
  std::string_view name;
};
constexpr std::array<EndingSignal, 3> kEndingSignals = {
    {{system::kInterrupt, "SIGINT"}, {system::kTerminate, "SIGTERM"}, {system::kHangUp, "SIGHUP"}}};

constexpr const char* kEnding = "\npalpate: stopping; press Ctrl+C again to quit immediately\n";
constexpr const char* kEnded = "\npalpate: ended by a signal\n";

/// A closing terminal sends its signal twice, a logout two kinds at once: only a later one counts as a second.
constexpr std::int64_t kSecondAfterNs = 300'000'000;

std::atomic<int> asked_by{0};
std::atomic<std::int64_t> asked_at_ns{0};
std::atomic<int> orderly{0};  // live FinishesInOrder
std::atomic<servo::EmergencyStop*> pressed_first{nullptr};
static_assert(std::atomic<servo::EmergencyStop*>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

extern "C" void askForEnd(int signal) {
  if (servo::EmergencyStop* stop = pressed_first.load()) stop->press();
  int nobody = 0;
  if (asked_by.compare_exchange_strong(nobody, signal)) {
    asked_at_ns.store(system::clockInHandlerNs());
    if (orderly.load() > 0 || filesUnderWay() > 0) return system::printInHandler(kEnding);
    system::printInHandler(kEnded);
    system::endNow(signalExitCode(signal));
  }
  if (system::clockInHandlerNs() - asked_at_ns.load() > kSecondAfterNs) system::endNow(signalExitCode(signal));
}

}  // namespace

void listenForSignals() {
  system::onStopRequest(askForEnd);
  system::endWithStarter();
}

FinishesInOrder::FinishesInOrder() { ++orderly; }
FinishesInOrder::~FinishesInOrder() { --orderly; }

EndAtOnce::EndAtOnce() : orderly_before_(orderly.exchange(0)) {
  if (endingSignal() == 0) return;
  orderly += orderly_before_;
  throw Ended();
}
EndAtOnce::~EndAtOnce() { orderly += orderly_before_; }

StoppedBySignal::StoppedBySignal(servo::EmergencyStop& stop) { pressed_first = &stop; }
StoppedBySignal::~StoppedBySignal() { pressed_first = nullptr; }

int endingSignal() { return asked_by.load(); }

std::string_view nameOfSignal(int signal) {
  for (const EndingSignal& known : kEndingSignals) {
    if (known.number == signal) return known.name;
  }
  return {};
}

void throwIfInterrupted() {
  if (endingSignal() != 0) throw Ended();
}

Progress interruptible(Progress progress) {
  return [progress = std::move(progress)](std::string_view stage, double done) {
    throwIfInterrupted();
    report(progress, stage, done);
  };
}

}  // namespace palpate::app
