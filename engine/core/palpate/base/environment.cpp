// The environment of an engine without a host; a host installs its own.
#include "palpate/base/environment.h"

#include <exception>
#include <utility>

#include "palpate/base/error.h"

namespace palpate {

namespace {

constexpr const char* kNoFiles = "the engine reads and writes files only after palpate::installHost()";

std::string refuseToRead(const std::filesystem::path& file, std::uint64_t) {
  throw Error::inFile(file.string(), kNoFiles);
}

void refuseToWrite(const std::filesystem::path& file, std::string_view) {
  throw Error::inFile(file.string(), kNoFiles);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): as Environment::start has it
StartedWork runInCaller(std::function<void()> work) {
  std::exception_ptr thrown;
  try {
    work();
  } catch (...) {
    thrown = std::current_exception();
  }
  return {[] { return true; },
          [thrown] {
            if (thrown) std::rethrow_exception(thrown);
          }};
}

std::size_t oneProcessor() { return 1; }

Environment& current() {
  static Environment environment{refuseToRead, refuseToWrite, runInCaller, oneProcessor};
  return environment;
}

}  // namespace

const Environment& environment() { return current(); }

void useEnvironment(const Environment& environment) { current() = environment; }

}  // namespace palpate
