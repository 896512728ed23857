// A pipe and CREATE_NEW_PROCESS_GROUP, which keeps Ctrl-C away from it; no console window appears. Its words go to a
// file that the system deletes when it is closed. Not tried with a real ffmpeg.
#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <utility>

#include "palpate/base/path_text.h"
#include "palpate/base/system/fed_program.h"
#include "palpate/base/system/process.h"

namespace palpate::system {

namespace {

HANDLE toHandle(std::intptr_t number) { return reinterpret_cast<HANDLE>(number); }
std::intptr_t numberOf(HANDLE handle) { return reinterpret_cast<std::intptr_t>(handle); }

std::FILE* fileWithoutName() {
  wchar_t folder[MAX_PATH + 1];
  wchar_t name[MAX_PATH + 1];
  if (::GetTempPathW(MAX_PATH, folder) == 0 || ::GetTempFileNameW(folder, L"plp", 0, name) == 0) return nullptr;
  HANDLE handle =
      ::CreateFileW(name, GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                    CREATE_ALWAYS, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return nullptr;
  return ::_fdopen(::_open_osfhandle(numberOf(handle), _O_RDWR | _O_BINARY), "w+b");
}

HANDLE inheritable(HANDLE handle) {
  ::SetHandleInformation(handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  return handle;
}

}  // namespace

FedProgram::FedProgram(const std::filesystem::path& program, const std::vector<std::string>& words)
    : words_(fileWithoutName(), &std::fclose) {
  HANDLE theirs = nullptr;
  HANDLE ours = nullptr;
  if (!words_ || ::CreatePipe(&theirs, &ours, nullptr, 1 << 20) == 0) {
    reason_ = EIO;
    return;
  }
  STARTUPINFOW start{};
  start.cb = sizeof(start);
  start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = inheritable(theirs);
  start.hStdError = inheritable(toHandle(::_get_osfhandle(::_fileno(words_.get()))));
  PROCESS_INFORMATION child{};
  std::wstring line = joinCommandLine(words);
  const bool runs =
      ::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                       CREATE_NO_WINDOW | CREATE_NEW_PROCESS_GROUP, nullptr, nullptr, &start, &child) != 0;
  ::CloseHandle(theirs);
  input_ = numberOf(ours);
  reason_ = runs ? 0 : ENOENT;
  if (!runs) return;
  ::CloseHandle(child.hThread);
  process_ = numberOf(child.hProcess);
}

FedProgram::~FedProgram() {
  closeInput();
  if (process_ == -1) return;
  ::TerminateProcess(toHandle(process_), 1);
  ::CloseHandle(toHandle(process_));
}

void FedProgram::closeInput() {
  if (input_ != -1) ::CloseHandle(toHandle(std::exchange(input_, -1)));
}

bool FedProgram::feed(std::string_view bytes) {
  while (!bytes.empty()) {
    DWORD sent = 0;
    const auto most = static_cast<DWORD>(std::min<std::size_t>(bytes.size(), 1u << 20));
    if (::WriteFile(toHandle(input_), bytes.data(), most, &sent, nullptr) == 0) return false;
    bytes.remove_prefix(sent);
  }
  return true;
}

FedProgram::Ending FedProgram::finish() {
  closeInput();
  const HANDLE process = toHandle(std::exchange(process_, -1));
  ::WaitForSingleObject(process, INFINITE);
  DWORD answer = 1;
  ::GetExitCodeProcess(process, &answer);
  ::CloseHandle(process);
  return {answer == 0, fmt::format("exit code {}", answer)};
}

bool FedProgram::hasEnded() { return process_ == -1 || ::WaitForSingleObject(toHandle(process_), 0) == WAIT_OBJECT_0; }

void FedProgram::sendInterrupt() {
  if (!hasEnded()) ::TerminateProcess(toHandle(process_), 1);
}

}  // namespace palpate::system
