// A socket in place of a pipe: writing to one whose reader has ended can be told not to raise SIGPIPE. ffmpeg's words
// go to a file and not to another pipe, which it could fill while we fill its input. It gets a process group of its
// own, so that Ctrl-C reaches this program alone, which then ends it.
#include "cli/render/film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

constexpr const char* kProgram = "ffmpeg";
/// yuv420p is what every player shows; it needs even sides.
constexpr const char* kEvenSides = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p";

bool isWebm(const std::filesystem::path& film) { return film.extension() == ".webm"; }

/// How the pictures are compressed: no loss that one sees.
std::vector<std::string> encoderOf(const std::filesystem::path& film) {
  std::vector<std::string> words = {"-vf", kEvenSides, "-colorspace", "bt709", "-color_primaries", "bt709"};
  const std::vector<std::string> of_format =
      isWebm(film) ? std::vector<std::string>{"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"}
                   : std::vector<std::string>{"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"};
  words.insert(words.end(), of_format.begin(), of_format.end());
  return words;
}

std::vector<std::string> argumentsFor(const std::filesystem::path& film, const std::filesystem::path& written,
                                      const FilmFormat& format) {
  std::vector<std::string> words = {kProgram, "-loglevel", "error", "-nostats", "-y"};
  const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  add({"-f", "rawvideo", "-pixel_format", "rgb24"});
  add({"-video_size", fmt::format("{}x{}", format.size.width, format.size.height)});
  add({"-framerate", fmt::format("{}", format.frames_per_s), "-i", "pipe:0"});
  const std::vector<std::string> encoder = encoderOf(film);
  words.insert(words.end(), encoder.begin(), encoder.end());
  // "file:" and the whole path: a name is never taken for an option or an address.
  add({"-f", isWebm(film) ? "webm" : "mp4", "file:" + std::filesystem::absolute(written).string()});
  return words;
}

/// For a shell, so that what is printed can be typed.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./%:=";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The last line that is not empty.
std::string lastLineOf(std::FILE* words) {
  std::rewind(words);
  std::string line;
  std::string last;
  for (int c = std::fgetc(words); c != EOF; c = std::fgetc(words)) {
    if (c != '\n') line += static_cast<char>(c);
    if (!trimmed(line).empty()) last = line;
    if (c == '\n') line.clear();
  }
  return std::string(trimmed(last));
}

[[noreturn]] void failFor(const std::filesystem::path& film, std::string_view what, int reason) {
  throw Error::inFile(film.string(), fmt::format("{}: {}", what, std::generic_category().message(reason)));
}

}  // namespace

bool isFilm(const std::filesystem::path& file) { return file.extension() == ".mp4" || file.extension() == ".webm"; }

std::optional<std::filesystem::path> installedFfmpeg() {
  const char* path = std::getenv("PATH");
  for (const std::string_view folder : split(path != nullptr ? path : "", ':')) {
    if (folder.empty()) continue;  // the current folder: a program there is not the system's
    const std::filesystem::path program = std::filesystem::path(folder) / kProgram;
    if (std::filesystem::is_regular_file(program) && access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

std::string commandToJoin(const std::filesystem::path& film, double frames_per_s) {
  std::string pattern = (film.parent_path() / film.stem()).string();
  for (std::size_t at = 0; (at = pattern.find('%', at)) != std::string::npos; at += 2) pattern.insert(at, 1, '%');
  std::vector<std::string> words = {kProgram, "-framerate", fmt::format("{}", frames_per_s), "-i",
                                    pattern + "_%04d.png"};
  const std::vector<std::string> encoder = encoderOf(film);
  words.insert(words.end(), encoder.begin(), encoder.end());
  words.push_back(film.string());
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + quoted(word);
  return command;
}

FilmWriter::FilmWriter(const std::filesystem::path& ffmpeg, const std::filesystem::path& film, const FilmFormat& format)
    : film_(film), output_(film), words_(std::tmpfile(), &std::fclose) {
  if (!words_) failFor(film_, "ffmpeg cannot be started", errno);
  start(ffmpeg, format);
}

void FilmWriter::start(const std::filesystem::path& ffmpeg, const FilmFormat& format) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    failFor(film_, "ffmpeg cannot be started", errno);
  }
  std::vector<std::string> words = argumentsFor(film_, output_.partial(), format);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, fileno(words_.get()), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawn(&process_, ffmpeg.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  input_ = ends[0];
  if (error == 0) return;
  process_ = -1;
  closeInput();
  failFor(film_, "ffmpeg cannot be started", error);
}

FilmWriter::~FilmWriter() {
  closeInput();
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  wait();
}

void FilmWriter::closeInput() {
  if (input_ >= 0) close(std::exchange(input_, -1));
}

int FilmWriter::wait() {
  const int process = std::exchange(process_, -1);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

void FilmWriter::fail(int status) {
  const std::string words = lastLineOf(words_.get());
  const std::string how =
      WIFEXITED(status) ? fmt::format("exit code {}", WEXITSTATUS(status)) : fmt::format("signal {}", WTERMSIG(status));
  throw Error::inFile(film_.string(),
                      fmt::format("ffmpeg made no film of it ({}){}{}", how, words.empty() ? "" : ": ", words));
}

void FilmWriter::add(const view::Image& picture) {
  const auto* bytes = reinterpret_cast<const char*>(picture.pixels.data());
  std::size_t left = picture.pixels.size() * sizeof(view::Pixel);
  while (left > 0) {
    const ssize_t sent = send(input_, bytes, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      closeInput();
      fail(wait());  // it reads no more: it has ended, or will now
    }
    bytes += sent;
    left -= static_cast<std::size_t>(sent);
  }
}

void FilmWriter::finish() {
  closeInput();
  const int status = wait();
  // ffmpeg 5.1 ends with 0 where the film's last bytes find no room on the disk, and only says so.
  const bool unwritten = lastLineOf(words_.get()).starts_with("Error ");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || unwritten) fail(status);
  output_.commit();
}

}  // namespace palpate::app
