// The system's files and folders, for base/output_file.cpp and base/private_folder.cpp, which say what is done with
// them. No words and no exceptions: what fails returns false, or -1, and leaves its reason in errno.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace palpate::system {

enum class ReadableBy : unsigned char { usual, owner };  // usual: as the system does it for any program

/// A file that is not there yet; EEXIST where it is.
int createFile(const std::filesystem::path& file, ReadableBy readers);
/// One that is there, from its beginning; for pipes and devices.
int openForWriting(const std::filesystem::path& file);
/// Returns the number of bytes taken.
std::ptrdiff_t writeSome(int descriptor, std::string_view bytes);
/// Flushes to the disk. True also where the file system cannot.
bool flush(int descriptor);
bool close(int descriptor);
/// Its name was taken away while it was open.
bool wasDeleted(int descriptor);
/// Copies another file's permissions; another user's never open ours wider. Where that fails, the usual ones are as
/// good.
void copyPermissions(const std::filesystem::path& other, int descriptor);
/// Gives the file another's name and place, in one step.
bool replace(const std::filesystem::path& file, const std::filesystem::path& place);
/// The names in it, to the disk, where the system does that.
void flushFolder(const std::filesystem::path& folder);

bool mayWrite(const std::filesystem::path& file);
bool mayReadAndWrite(const std::filesystem::path& file);
bool mayRun(const std::filesystem::path& program);

/// Whether all users may make a link there under any name, as in /tmp; "" is the current folder.
bool isOpenToAll(const std::filesystem::path& folder);
/// Whether only its owner (and the administrator) may read or write it.
bool isClosedToOthers(const std::filesystem::path& file);
/// The same, but those of its group may, where the system has groups of files.
bool isClosedToStrangers(const std::filesystem::path& file);
/// The command that closes it to others, for messages.
std::string howToClose(const std::filesystem::path& file);
/// A folder, no link, that belongs to this user.
bool isOwnFolder(const std::filesystem::path& folder);

/// A new folder, closed to others from its first moment; EEXIST where it is there.
bool makeClosedFolder(const std::filesystem::path& folder);
bool closeToOthers(const std::filesystem::path& folder);
/// A fresh one of those, in the folder for temporary files; empty where it cannot be made.
std::filesystem::path makeTemporaryFolder(std::string_view stem);
/// Where a running program keeps what only its own user may see; it need not be there.
std::filesystem::path runtimeFolder();

/// If our starter has closed standard input, output or error, the next opened file would take its number and get its
/// text. Opens a device in its place that refuses reads, or writes. Call before any file is opened.
void holdStandardStreams() noexcept;

}  // namespace palpate::system
