// The console's events come on a thread that the system makes. When a window is closed, a user logs off or the machine
// shuts down, the system ends the program as soon as the handler returns, or some seconds later: it waits for the
// orderly end.
#include <io.h>
#include <windows.h>

#include <atomic>
#include <cstring>

#include "palpate/base/stopwatch.h"
#include "palpate/base/system/signals.h"

namespace palpate::system {

namespace {

std::atomic<void (*)(int)> asked{nullptr};

BOOL WINAPI handle(DWORD event) {
  const bool by_hand = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
  if (auto* ask = asked.load()) ask(by_hand ? kInterrupt : event == CTRL_CLOSE_EVENT ? kHangUp : kTerminate);
  if (!by_hand) ::Sleep(INFINITE);
  return TRUE;
}

}  // namespace

void onStopRequest(void (*ask)(int signal)) {
  asked = ask;
  ::SetConsoleCtrlHandler(handle, TRUE);
}

void makeFailedWritesErrors() noexcept {}

void endWithStarter() {}

std::int64_t clockInHandlerNs() { return monotonicNs(); }

void printInHandler(const char* words) { ::_write(2, words, static_cast<unsigned>(std::strlen(words))); }

void endNow(int exit_code) {
  ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(exit_code));
  ::ExitProcess(static_cast<UINT>(exit_code));
}

}  // namespace palpate::system
