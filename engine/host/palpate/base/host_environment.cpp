// The environment of a program on a usual system: the file system, and a thread for each piece of work by std::async,
// whose future carries what it threw. Without a pool, each piece must be worth a thread of its own.
#include "palpate/base/host_environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <limits>
#include <memory>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"

namespace palpate {

namespace {

/// The size is read before memory is allocated for it; a file that shrinks meanwhile is read as far as it goes.
std::size_t sizeOfReadableFile(const std::filesystem::path& file, std::uint64_t max_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw Error::inFile(file.string(), "no such file");
  if (!std::filesystem::is_regular_file(status)) throw Error::inFile(file.string(), "not a file");
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw Error::inFile(file.string(), error.message());
  const std::uint64_t limit = std::min<std::uint64_t>(max_bytes, std::numeric_limits<std::size_t>::max());
  if (size > limit) {
    throw Error::inFile(file.string(), fmt::format("the file has {} bytes; expected at most {}", size, limit));
  }
  return static_cast<std::size_t>(size);
}

std::string readWholeFile(const std::filesystem::path& file, std::uint64_t max_bytes) {
  std::string content(sizeOfReadableFile(file, max_bytes), '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error::inFile(file.string(), "cannot be opened for reading");
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(stream.gcount()));
  return content;
}

void writeWholeFile(const std::filesystem::path& file, std::string_view content) {
  OutputFile output(file);
  output.write(content);
  output.commit();
}

#ifndef PALPATE_NO_THREADS

StartedWork startOnThread(std::function<void()> work) {
  // This policy falls back on doing the work in `join` where the system refuses a thread. Such a piece is never `done`:
  // there is nothing to wait for. For work that is moved in, libstdc++ 12 falls back on what the refused thread has
  // left: an empty function. So it is copied.
  const std::function<void()> copied = std::move(work);
  const auto future =
      std::make_shared<std::future<void>>(std::async(std::launch::async | std::launch::deferred, copied));
  return {[future] { return future->wait_for(std::chrono::seconds(0)) != std::future_status::timeout; },
          [future] { future->get(); }};
}

std::size_t hardwareThreads() { return std::max(1u, std::thread::hardware_concurrency()); }

#endif

}  // namespace

void installHostEnvironment() {
  Environment host = environment();
  host.read_file = readWholeFile;
  host.write_file = writeWholeFile;
#ifndef PALPATE_NO_THREADS
  host.start = startOnThread;
  host.processors = hardwareThreads;
#endif
  useEnvironment(host);
}

}  // namespace palpate
