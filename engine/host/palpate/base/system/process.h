// A program's requests to the system about itself and its surroundings, and how it starts another.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palpate::system {

/// An environment variable, in UTF-8; empty where it is not set.
std::string variable(const char* name);

#ifdef _WIN32
inline constexpr bool kIsWindows = true;
#else
inline constexpr bool kIsWindows = false;
#endif
#ifdef __APPLE__
inline constexpr bool kIsApple = true;
#else
inline constexpr bool kIsApple = false;
#endif
inline constexpr char kBetweenFolders = kIsWindows ? ';' : ':';  ///< in a variable that lists them
inline constexpr const char* kProgramExtension = kIsWindows ? ".exe" : "";

/// False where the system gives no random numbers.
bool fillWithRandom(std::span<unsigned char> bytes) noexcept;

/// "Linux 6.1.0, x86_64"; for recordings.
std::string describeMachine();

/// The user of this computer, as far as the system says; to be left out of files for others.
struct Identity {
  std::vector<std::string> accounts;
  std::string full_name;
  std::vector<std::string> homes;
  std::string computer;
};
Identity identity();

/// Folders of a program for its user's settings, for its own state, and for files that it can make again; empty without
/// a home.
std::filesystem::path settingsFolder();
std::filesystem::path stateFolder();
std::filesystem::path cacheFolder();

/// The file of the running program; empty if unknown.
std::filesystem::path ownProgram();

/// From now on the texts of <folder>/<code>/LC_MESSAGES/palpate.mo, a catalogue of gettext, replace those of the code.
/// Changes the process's environment and its locale for messages. Without libintl (Windows) every text stays as it is.
void useCatalogue(const std::filesystem::path& folder, const std::string& code);
const char* translate(const char* text) noexcept;
const char* translate(const char* one, const char* many, std::size_t count) noexcept;

/// Whether messages are read at a terminal, which can rewrite a line.
bool isStderrTerminal();

/// A letter that was typed or sent to the program; does not wait. Nothing: none is there now; `open` becomes false at
/// the end of the input.
std::optional<char> typedLetter(bool& open);

/// The number of this process; whether one runs that has this number, ours or another's.
int ownProcess();
bool isRunning(int process);

/// From this size on an array has pages of its own, which come from the system and go back to it.
inline constexpr std::size_t kLargeArrayBytes = 4 << 20;

/// From now on arrays of kLargeArrayBytes and more go back to the system when they are freed, and smaller ones stay
/// with the program. glibc raises that to 32 MB by itself and keeps twice as much in each thread: a tenth of what a
/// body of 4,000,000 triangles takes. Others keep nothing.
void returnLargeArrays() noexcept;

/// Memory for a large array, in pages of 2 MB where the system has them on request (Linux, "madvise"); null: there is
/// none. std::free() frees it.
void* largeArray(std::size_t bytes) noexcept;

/// The words of the command line, without the program's own, in UTF-8.
std::vector<std::string> commandLine(int argc, char** argv);

/// The other program takes this one's place, under the name `called`. -1: it cannot be started, and errno says why.
/// On Windows, which cannot, it runs below this one to its end, gets Ctrl-C in its place and ends with it, and its exit
/// code is returned.
int becomeProgram(const std::filesystem::path& program, const std::string& called,
                  const std::vector<std::string>& words);

#ifdef _WIN32
/// Words as one line, from which the other program's C library takes them again.
std::wstring joinCommandLine(const std::vector<std::string>& words);
#else
char** environmentOfTheProgram();
#endif

/// Runs another program to its end without a word; its exit code, or -1 where it did not come to one.
int runQuietly(const std::filesystem::path& program, const std::string& called, const std::vector<std::string>& words);

}  // namespace palpate::system
