// Windows: words are UTF-16 there and UTF-8 here.
#include <conio.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <windows.h>
// After windows.h.
#include <ntsecapi.h>
#include <shellapi.h>

#include <cerrno>
#include <cstdlib>

#include "palpate/base/path_text.h"
#include "palpate/base/system/clock.h"
#include "palpate/base/system/process.h"

namespace palpate::system {

namespace {

constexpr DWORD kLongestPath = 32768;

std::string inUtf8(const std::wstring& text) { return std::filesystem::path(text).string(); }
std::wstring inUtf16(const std::string& text) { return pathOf(text).wstring(); }

/// So that the other program reads the same words again: its C library takes them out of one line.
std::wstring quoteArgument(const std::string& word) {
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t letter : inUtf16(word)) {
    if (letter == L'"') text.append(backslashes + 1, L'\\');
    backslashes = letter == L'\\' ? backslashes + 1 : 0;
    text += letter;
  }
  text.append(backslashes, L'\\');
  return text + L"\"";
}

/// Ctrl-C goes to every program at the console: the other one ends in order, and this one waits for it. When a handler
/// returns from what is more than that, the system ends its program.
BOOL WINAPI ignoreCtrlC(DWORD event) {
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(INFINITE);
  return TRUE;
}

/// Ending this program ends those in the job, but not those that they have started.
HANDLE createKillOnCloseJob() {
  const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_SILENT_BREAKAWAY_OK;
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof(limits));
  return job;
}

/// Without a window of its own (CREATE_NO_WINDOW) it has no input and no output either.
bool begin(const std::filesystem::path& program, const std::string& called, const std::vector<std::string>& words,
           DWORD flags, PROCESS_INFORMATION& child) {
  std::vector<std::string> all = {called};
  all.insert(all.end(), words.begin(), words.end());
  std::wstring line = joinCommandLine(all);
  STARTUPINFOW start{};
  start.cb = sizeof(start);
  const bool quietly = flags == CREATE_NO_WINDOW;
  if (quietly) start.dwFlags = STARTF_USESTDHANDLES;  // null: no output
  const BOOL begun = ::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, quietly ? FALSE : TRUE, flags,
                                      nullptr, nullptr, &start, &child);
  if (begun == 0) errno = ::GetLastError() == ERROR_FILE_NOT_FOUND ? ENOENT : EACCES;
  return begun != 0;
}

/// The exit code of one that ended normally, else that of its fault, never below 0; -1 if unknown.
int waitForExitCode(const PROCESS_INFORMATION& child) {
  ::WaitForSingleObject(child.hProcess, INFINITE);
  DWORD answer = 0;
  const bool ended = ::GetExitCodeProcess(child.hProcess, &answer) != 0;
  ::CloseHandle(child.hThread);
  ::CloseHandle(child.hProcess);
  constexpr DWORD kMaxExitCode = 0x7fffffff;
  return ended ? static_cast<int>(answer & kMaxExitCode) : -1;
}

}  // namespace

std::wstring joinCommandLine(const std::vector<std::string>& words) {
  std::wstring line;
  for (const std::string& word : words) line += (line.empty() ? L"" : L" ") + quoteArgument(word);
  return line;
}

std::string variable(const char* name) {
  const std::wstring wide = inUtf16(name);
  std::wstring value(kLongestPath, L'\0');
  const DWORD length = ::GetEnvironmentVariableW(wide.c_str(), value.data(), kLongestPath);
  if (length >= kLongestPath) return {};
  value.resize(length);
  return inUtf8(value);
}

int ownProcess() { return static_cast<int>(::GetCurrentProcessId()); }

bool isRunning(int process) {
  const HANDLE handle = ::OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(process));
  if (handle == nullptr) return ::GetLastError() == ERROR_ACCESS_DENIED;
  const bool runs = ::WaitForSingleObject(handle, 0) == WAIT_TIMEOUT;
  ::CloseHandle(handle);
  return runs;
}

bool fillWithRandom(std::span<unsigned char> bytes) noexcept {
  return ::RtlGenRandom(bytes.data(), static_cast<ULONG>(bytes.size())) != FALSE;
}

std::string describeMachine() {
  OSVERSIONINFOW version{};
  version.dwOSVersionInfoSize = sizeof(version);
  // GetVersionEx answers by the program's manifest; the kernel's own function is truthful.
  const auto ask = reinterpret_cast<LONG(WINAPI*)(OSVERSIONINFOW*)>(
      reinterpret_cast<void*>(::GetProcAddress(::GetModuleHandleW(L"ntdll.dll"), "RtlGetVersion")));
  if (ask == nullptr || ask(&version) != 0) return "Windows, x86_64";
  return fmt::format("Windows {}.{}.{}, x86_64", version.dwMajorVersion, version.dwMinorVersion, version.dwBuildNumber);
}

Identity identity() {
  std::wstring computer(256, L'\0');
  auto size = static_cast<DWORD>(computer.size());
  computer.resize(::GetComputerNameExW(ComputerNamePhysicalDnsHostname, computer.data(), &size) != 0 ? size : 0);
  // Spelt as in messages and in scenes.
  const std::string home = variable("USERPROFILE");
  return {{variable("USERNAME")}, {}, {home, pathOf(home).generic_string()}, inUtf8(computer)};
}

std::filesystem::path settingsFolder() { return pathOf(variable("APPDATA")); }
std::filesystem::path stateFolder() { return pathOf(variable("LOCALAPPDATA")); }
std::filesystem::path cacheFolder() { return stateFolder(); }

std::filesystem::path ownProgram() {
  std::wstring name(kLongestPath, L'\0');
  name.resize(::GetModuleFileNameW(nullptr, name.data(), kLongestPath));
  return name;
}

bool readRawClock(RawClock& clock) noexcept {
  return ::QueryPerformanceCounter(reinterpret_cast<LARGE_INTEGER*>(&clock)) != 0;
}

// The C library has no libintl, and Debian's compiler for Windows has none.

void useCatalogue(const std::filesystem::path&, const std::string&) {}

const char* translate(const char* text) noexcept { return text; }

const char* translate(const char* one, const char* many, std::size_t count) noexcept { return count == 1 ? one : many; }

bool isStderrTerminal() { return ::_isatty(::_fileno(stderr)) != 0; }

std::optional<char> typedLetter(bool& open) {
  const HANDLE input = ::GetStdHandle(STD_INPUT_HANDLE);
  DWORD waiting = 0;
  if (!open) return std::nullopt;
  if (::GetFileType(input) == FILE_TYPE_CHAR) {
    if (::_kbhit() == 0) return std::nullopt;
  } else if (::GetFileType(input) == FILE_TYPE_PIPE) {
    open = ::PeekNamedPipe(input, nullptr, 0, nullptr, &waiting, nullptr) != 0;
    if (!open || waiting == 0) return std::nullopt;
  }
  char letter = 0;
  open = ::_read(::_fileno(stdin), &letter, 1) == 1;
  return open ? std::optional(letter) : std::nullopt;
}

/// Also prints the same bytes as elsewhere: UTF-8, and no carriage returns.
std::vector<std::string> commandLine(int, char**) {
  ::SetConsoleOutputCP(CP_UTF8);
  ::_setmode(::_fileno(stdout), _O_BINARY);
  int count = 0;
  wchar_t** words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> own;
  for (int i = 1; i < count; ++i) own.push_back(inUtf8(words[i]));
  ::LocalFree(words);
  return own;
}

void returnLargeArrays() noexcept {}  // its heap returns them automatically

int becomeProgram(const std::filesystem::path& program, const std::string& called,
                  const std::vector<std::string>& words) {
  const HANDLE job = createKillOnCloseJob();
  PROCESS_INFORMATION child{};
  if (!begin(program, called, words, CREATE_SUSPENDED, child)) return -1;
  ::SetConsoleCtrlHandler(ignoreCtrlC, TRUE);
  ::AssignProcessToJobObject(job, child.hProcess);
  ::ResumeThread(child.hThread);
  const int answer = waitForExitCode(child);
  ::SetConsoleCtrlHandler(ignoreCtrlC, FALSE);
  ::CloseHandle(job);
  return answer;
}

int runQuietly(const std::filesystem::path& program, const std::string& called, const std::vector<std::string>& words) {
  PROCESS_INFORMATION child{};
  return begin(program, called, words, CREATE_NO_WINDOW, child) ? waitForExitCode(child) : -1;
}

}  // namespace palpate::system
