// The engine gets whole files, and threads for cold work, from the program that it runs in. It has neither by itself:
// without a host, as on a web page, a file is refused by an Error and work is done by the caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace palpate {

/// Work that was started. Both may be called from the thread that started it.
struct StartedWork {
  std::function<bool()> done;  ///< whether `join` would return soon
  std::function<void()> join;  ///< waits, and throws what the work threw
};

struct Environment {
  /// See readFile and writeFile (base/text.h).
  std::string (*read_file)(const std::filesystem::path& file, std::uint64_t max_bytes);
  void (*write_file)(const std::filesystem::path& file, std::string_view content);
  /// Starts the work on a thread of its own, or does it now, or in `join`.
  StartedWork (*start)(std::function<void()> work);
  /// Number of threads that run at once here; at least 1.
  std::size_t (*processors)();
};

/// The one in use. Any thread.
const Environment& environment();

/// Before any other thread runs. Programs on a usual system call installHost (scene/host.h of the host) instead.
void useEnvironment(const Environment& environment);

}  // namespace palpate
