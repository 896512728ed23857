// POSIX; the program's own file comes from Linux's /proc or macOS's loader.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <pwd.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <cstdlib>
#ifdef __GLIBC__
#include <libintl.h>
#include <malloc.h>
// libintl's own: from its next value on a changed LANGUAGE counts. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int _nl_msg_cat_cntr;
#endif
#ifdef __APPLE__
#include <crt_externs.h>
#include <mach-o/dyld.h>
#include <sys/random.h>
#endif

#include "palpate/base/system/clock.h"
#include "palpate/base/system/process.h"

namespace palpate::system {

namespace {

/// Arguments for the system; `words` must outlive them.
std::vector<char*> makeArgv(std::string& called, std::vector<std::string>& words) {
  std::vector<char*> arguments = {called.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return arguments;
}

}  // namespace

char** environmentOfTheProgram() {
#ifdef __APPLE__
  return *::_NSGetEnviron();
#else
  return ::environ;
#endif
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value == nullptr ? std::string() : value;
}

int ownProcess() { return ::getpid(); }
bool isRunning(int process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

bool fillWithRandom(std::span<unsigned char> bytes) noexcept { return ::getentropy(bytes.data(), bytes.size()) == 0; }

std::string describeMachine() {
  utsname machine{};
  if (::uname(&machine) != 0) return "unknown";
  return fmt::format("{} {}, {}", machine.sysname, machine.release, machine.machine);
}

Identity identity() {
  Identity here{{variable("USER"), variable("LOGNAME")}, {}, {variable("HOME")}, {}};
  if (const passwd* account = ::getpwuid(::geteuid())) {  // NOLINT(concurrency-mt-unsafe)
    here.accounts.emplace_back(account->pw_name);
    here.homes.emplace_back(account->pw_dir);
    const std::string about = account->pw_gecos == nullptr ? "" : account->pw_gecos;
    here.full_name = about.substr(0, about.find(','));
  }
  std::array<char, 256> computer{};
  if (::gethostname(computer.data(), computer.size() - 1) == 0) here.computer = computer.data();
  return here;
}

namespace {

/// The specification of base directories: a variable, or a folder in the user's home.
std::filesystem::path baseFolder(const char* name, const char* in_home) {
  if (const std::string folder = variable(name); !folder.empty()) return folder;
  const std::string home = variable("HOME");
  return home.empty() ? std::filesystem::path() : std::filesystem::path(home) / in_home;
}

}  // namespace

std::filesystem::path settingsFolder() { return baseFolder("XDG_CONFIG_HOME", ".config"); }
std::filesystem::path stateFolder() { return baseFolder("XDG_STATE_HOME", ".local/state"); }
std::filesystem::path cacheFolder() { return baseFolder("XDG_CACHE_HOME", ".cache"); }

std::filesystem::path ownProgram() {
#ifdef __APPLE__
  char name[4096];
  std::uint32_t size = sizeof(name);
  return ::_NSGetExecutablePath(name, &size) == 0 ? std::filesystem::path(name) : std::filesystem::path();
#else
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown);
#endif
}

bool readRawClock(RawClock& clock) noexcept { return ::clock_gettime(CLOCK_MONOTONIC, &clock) == 0; }

#ifdef __GLIBC__

namespace {
constexpr const char* kTextDomain = "palpate";
}

void useCatalogue(const std::filesystem::path& folder, const std::string& code) {
  // In the locale "C" libintl translates nothing; C.UTF-8 is on every system and changes no number.
  ::setlocale(LC_MESSAGES, "C.UTF-8");
  ::setenv("LANGUAGE", code.c_str(), 1);
  ++_nl_msg_cat_cntr;
  ::bindtextdomain(kTextDomain, folder.c_str());
  ::bind_textdomain_codeset(kTextDomain, "UTF-8");
}

const char* translate(const char* text) noexcept { return ::dgettext(kTextDomain, text); }

const char* translate(const char* one, const char* many, std::size_t count) noexcept {
  return ::dngettext(kTextDomain, one, many, count);
}

#else

void useCatalogue(const std::filesystem::path&, const std::string&) {}

const char* translate(const char* text) noexcept { return text; }

const char* translate(const char* one, const char* many, std::size_t count) noexcept { return count == 1 ? one : many; }

#endif

bool isStderrTerminal() { return ::isatty(STDERR_FILENO) != 0; }

std::optional<char> typedLetter(bool& open) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (!open || ::poll(&input, 1, 0) != 1) return std::nullopt;
  char letter = 0;
  open = ::read(STDIN_FILENO, &letter, 1) == 1;
  return open ? std::optional(letter) : std::nullopt;
}

std::vector<std::string> commandLine(int argc, char** argv) { return {argv + std::min(argc, 1), argv + argc}; }

void returnLargeArrays() noexcept {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, kLargeArrayBytes);
  // With the first set, glibc takes its least for the second, 128 KB: a list that is freed and made again and again
  // would get new pages each time. A tick of a point on 1,000,000 triangles took 7 us in place of 1.1 (p99) with that.
  ::mallopt(M_TRIM_THRESHOLD, 2 * kLargeArrayBytes);
#endif
}

void* largeArray(std::size_t bytes) noexcept {
  constexpr std::size_t kHugePage = 2 << 20;
  void* memory = nullptr;
  if (::posix_memalign(&memory, kHugePage, bytes) != 0) return nullptr;
#ifdef MADV_HUGEPAGE
  // Whole pages alone: the rest of the last one would be memory that was not requested. Refused: small pages, as
  // before.
  ::madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return memory;
}

int becomeProgram(const std::filesystem::path& program, const std::string& called,
                  const std::vector<std::string>& words) {
  std::string name = called;
  std::vector<std::string> own = words;
  return ::execv(program.c_str(), makeArgv(name, own).data());
}

int runQuietly(const std::filesystem::path& program, const std::string& called, const std::vector<std::string>& words) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
  }
  std::string name = called;
  std::vector<std::string> own = words;
  pid_t child = 0;
  const bool started =
      posix_spawn(&child, program.c_str(), &files, nullptr, makeArgv(name, own).data(), environmentOfTheProgram()) == 0;
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  while (started && ::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return started && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace palpate::system
