#include <signal.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <time.h>
#include <unistd.h>

#include <cstring>
#include <initializer_list>
#include <string>

#include "palpate/base/system/process.h"
#include "palpate/base/system/signals.h"

namespace palpate::system {

static_assert(kInterrupt == SIGINT && kHangUp == SIGHUP && kTerminate == SIGTERM && kBrokenPipe == SIGPIPE);

void onStopRequest(void (*ask)(int signal)) {
  for (const int signal : {kInterrupt, kTerminate, kHangUp}) {
    struct sigaction before = {};
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    struct sigaction action = {};
    action.sa_handler = ask;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

void makeFailedWritesErrors() noexcept {
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
}

void endWithStarter() {
#ifdef __linux__
  const std::string starter = variable(kStarterVariable);
  const auto is_our_parent = [&] { return starter == std::to_string(::getppid()); };
  if (!is_our_parent()) return;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (!is_our_parent()) ::raise(SIGTERM);  // it has ended meanwhile
#endif
}

std::int64_t clockInHandlerNs() {
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

void printInHandler(const char* words) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words, std::strlen(words));
}

void endNow(int exit_code) { ::_exit(exit_code); }

}  // namespace palpate::system
