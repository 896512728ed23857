// Requests to end a program: signals, and on Windows the console's events and the end of a session.
#pragma once

#include <cstdint>

namespace palpate::system {

/// POSIX numbers on every system: exit codes are made of them.
inline constexpr int kInterrupt = 2;    ///< Ctrl-C
inline constexpr int kHangUp = 1;       ///< the terminal was closed
inline constexpr int kTerminate = 15;   ///< other programs
inline constexpr int kBrokenPipe = 13;  ///< the reader of the output has left

/// `ask` is called with the signal: in its handler, so that it may do only what a handler may (lock-free numbers,
/// printInHandler, endNow); on Windows on a thread of its own. A signal that was ignored when the program started stays
/// ignored.
void onStopRequest(void (*ask)(int signal));

/// A file that grows over a limit and a reader of a pipe that has left become errors of the write instead of the
/// program's end. First of all in a program; a library leaves its host's signals as they are.
void makeFailedWritesErrors() noexcept;

/// In the environment of a program that another of ours has started: the other's number.
inline constexpr const char* kStarterVariable = "PALPATE_STARTER";
/// Where such a one has started us, and still lives, we are asked to end (SIGTERM) when it is gone, also by a crash.
/// On Linux only.
void endWithStarter();

// Allowed in a handler.

/// The monotonic clock.
std::int64_t clockInHandlerNs();
/// Writes to the standard error; lost without a reader.
void printInHandler(const char* words);
[[noreturn]] void endNow(int exit_code);

}  // namespace palpate::system
