// The C runtime's descriptors over handles of the system, and its lists of who may do what (ACLs) where POSIX has
// modes.
#include <windows.h>
// After windows.h.
#include <aclapi.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <sddl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/path_text.h"
#include "palpate/base/system/files.h"
#include "palpate/base/system/process.h"

namespace palpate::system {

namespace {

namespace fs = std::filesystem;

struct Freed {
  void operator()(void* memory) const { ::LocalFree(memory); }
};
using Descriptor = std::unique_ptr<void, Freed>;

/// The system's error as errno.
int toErrno(DWORD error) {
  switch (error) {
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      return EEXIST;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
      return ENOENT;
    case ERROR_DISK_FULL:
      return ENOSPC;
    default:
      return EACCES;
  }
}

bool failed() {
  errno = toErrno(::GetLastError());
  return false;
}

int toDescriptor(HANDLE handle) {
  if (handle != INVALID_HANDLE_VALUE)
    return ::_open_osfhandle(reinterpret_cast<intptr_t>(handle), _O_WRONLY | _O_BINARY);
  failed();
  return -1;
}

/// A TOKEN_USER, which points into itself: moved, but never copied.
std::vector<unsigned char> ownUser() {
  HANDLE token = nullptr;
  std::vector<unsigned char> user(512);
  DWORD size = 0;
  if (::OpenProcessToken(::GetCurrentProcess(), TOKEN_QUERY, &token) == 0) return {};
  const bool known = ::GetTokenInformation(token, TokenUser, user.data(), static_cast<DWORD>(user.size()), &size) != 0;
  ::CloseHandle(token);
  if (!known) user.clear();
  return user;
}

bool isOwnUser(PSID who) {
  static const std::vector<unsigned char> user = ownUser();
  return !user.empty() && ::EqualSid(who, reinterpret_cast<const TOKEN_USER*>(user.data())->User.Sid) != 0;
}

/// This user, or one who may do everything anyway.
bool isTrustedAccount(PSID who) {
  return isOwnUser(who) || ::IsWellKnownSid(who, WinLocalSystemSid) != 0 ||
         ::IsWellKnownSid(who, WinBuiltinAdministratorsSid) != 0 ||
         ::IsWellKnownSid(who, WinCreatorOwnerRightsSid) != 0;
}

/// Protected from inherited rights: this user and the system itself, also for files made within.
Descriptor ownerOnlyDescriptor() {
  static const std::vector<unsigned char> user = ownUser();
  wchar_t* name = nullptr;
  if (user.empty() || ::ConvertSidToStringSidW(reinterpret_cast<const TOKEN_USER*>(user.data())->User.Sid, &name) == 0)
    return {};
  const std::wstring list = L"D:P(A;OICI;FA;;;" + std::wstring(name) + L")(A;OICI;FA;;;SY)";
  ::LocalFree(name);
  PSECURITY_DESCRIPTOR descriptor = nullptr;
  ::ConvertStringSecurityDescriptorToSecurityDescriptorW(list.c_str(), SDDL_REVISION_1, &descriptor, nullptr);
  return Descriptor(descriptor);
}

struct Rights {
  Descriptor memory;
  PSID owner = nullptr;
  PACL list = nullptr;
};

bool readRights(const fs::path& file, Rights& rights) {
  PSECURITY_DESCRIPTOR memory = nullptr;
  const DWORD error =
      ::GetNamedSecurityInfoW(file.c_str(), SE_FILE_OBJECT, OWNER_SECURITY_INFORMATION | DACL_SECURITY_INFORMATION,
                              &rights.owner, nullptr, &rights.list, nullptr, &memory);
  rights.memory.reset(memory);
  return error == ERROR_SUCCESS;
}

/// Some right of reading or writing.
bool opensToOthers(PACL list) {
  if (list == nullptr) return true;
  for (DWORD i = 0; i < list->AceCount; ++i) {
    void* entry = nullptr;
    if (::GetAce(list, i, &entry) == 0) return true;
    auto* allows = static_cast<ACCESS_ALLOWED_ACE*>(entry);
    if (allows->Header.AceType != ACCESS_ALLOWED_ACE_TYPE) continue;
    constexpr DWORD kHarmless = READ_CONTROL | SYNCHRONIZE | FILE_READ_ATTRIBUTES;
    if ((allows->Mask & ~kHarmless) != 0 && !isTrustedAccount(&allows->SidStart)) return true;
  }
  return false;
}

}  // namespace

int createFile(const fs::path& file, ReadableBy readers) {
  const Descriptor alone = readers == ReadableBy::owner ? ownerOnlyDescriptor() : Descriptor();
  SECURITY_ATTRIBUTES attributes{sizeof(SECURITY_ATTRIBUTES), alone.get(), FALSE};
  return toDescriptor(::CreateFileW(file.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, &attributes,
                                    CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
}

int openForWriting(const fs::path& file) {
  return toDescriptor(::CreateFileW(file.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                    OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
}

std::ptrdiff_t writeSome(int descriptor, std::string_view bytes) {
  constexpr std::size_t kMaxBytes = 1u << 30;
  return ::_write(descriptor, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), kMaxBytes)));
}

bool flush(int descriptor) { return ::_commit(descriptor) == 0 || errno == EBADF; }
bool close(int descriptor) { return ::_close(descriptor) == 0; }
bool wasDeleted(int) { return false; }         // the system does not delete a file that is open for writing
void copyPermissions(const fs::path&, int) {}  // the folder hands them down

bool replace(const fs::path& file, const fs::path& place) {
  return ::MoveFileExW(file.c_str(), place.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0 ||
         failed();
}

void flushFolder(const fs::path&) {}  // MOVEFILE_WRITE_THROUGH did

bool mayWrite(const fs::path& file) { return ::_waccess(file.c_str(), 2) == 0; }
bool mayReadAndWrite(const fs::path& file) { return ::_waccess(file.c_str(), 6) == 0; }
bool mayRun(const fs::path& program) { return ::_waccess(program.c_str(), 4) == 0; }

bool isOpenToAll(const fs::path&) { return false; }  // links are for administrators, or one's own developer mode

bool isClosedToOthers(const fs::path& file) {
  Rights rights;
  return readRights(file, rights) && isTrustedAccount(rights.owner) && !opensToOthers(rights.list);
}

bool isClosedToStrangers(const fs::path& file) { return isClosedToOthers(file); }

std::string howToClose(const fs::path& file) {
  return "icacls \"" + file.string() + "\" /inheritance:r /grant:r \"%USERNAME%:F\"";
}

bool isOwnFolder(const fs::path& folder) {
  const DWORD facts = ::GetFileAttributesW(folder.c_str());
  Rights rights;
  return facts != INVALID_FILE_ATTRIBUTES && (facts & FILE_ATTRIBUTE_DIRECTORY) != 0 &&
         (facts & FILE_ATTRIBUTE_REPARSE_POINT) == 0 && readRights(folder, rights) && isTrustedAccount(rights.owner);
}

bool makeClosedFolder(const fs::path& folder) {
  const Descriptor alone = ownerOnlyDescriptor();
  SECURITY_ATTRIBUTES attributes{sizeof(SECURITY_ATTRIBUTES), alone.get(), FALSE};
  return ::CreateDirectoryW(folder.c_str(), &attributes) != 0 || failed();
}

bool closeToOthers(const fs::path& folder) {
  const Descriptor alone = ownerOnlyDescriptor();
  return ::SetFileSecurityW(folder.c_str(), DACL_SECURITY_INFORMATION, alone.get()) != 0 || failed();
}

fs::path makeTemporaryFolder(std::string_view stem) {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    std::array<unsigned char, 6> random{};
    if (!fillWithRandom(random)) return {};
    std::string name(stem);
    for (const unsigned char byte : random) name += fmt::format("{}{:02x}", &byte == random.data() ? "-" : "", byte);
    fs::path folder = fs::temp_directory_path() / pathOf(name);
    if (makeClosedFolder(folder)) return folder;
    if (errno != EEXIST) break;
  }
  return {};
}

fs::path runtimeFolder() {
  const std::string own = variable("LOCALAPPDATA");
  return (own.empty() ? fs::temp_directory_path() : pathOf(own)) / "palpate-run";
}

void holdStandardStreams() noexcept {}

}  // namespace palpate::system
