#include "cli/render/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/files.h"
#include "palpate/base/system/process.h"
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
std::string lastLineOf(std::string_view words) {
  std::string last;
  for (const std::string_view line : split(words, '\n')) {
    if (!trimmed(line).empty()) last = trimmed(line);
  }
  return last;
}

}  // namespace

bool isFilm(const std::filesystem::path& file) { return file.extension() == ".mp4" || file.extension() == ".webm"; }

std::optional<std::filesystem::path> installedFfmpeg() {
  const std::string path = system::variable("PATH");
  for (const std::string_view folder : split(path, system::kBetweenFolders)) {
    if (folder.empty()) continue;  // the current folder: a program there is not the system's
    const std::filesystem::path program = pathOf(folder) / pathOf(std::string(kProgram) + system::kProgramExtension);
    if (std::filesystem::is_regular_file(program) && system::mayRun(program)) return program;
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
    : film_(film), output_(film), ffmpeg_(ffmpeg, argumentsFor(film, output_.partial(), format)) {
  if (ffmpeg_.reason() == 0) return;
  throw Error::inFile(film_.string(), "ffmpeg cannot be started: " + std::generic_category().message(ffmpeg_.reason()));
}

void FilmWriter::fail(const system::FedProgram::Ending& ending) {
  const std::string words = lastLineOf(ffmpeg_.said());
  throw Error::inFile(film_.string(),
                      fmt::format("ffmpeg made no film of it ({}){}{}", ending.how, words.empty() ? "" : ": ", words));
}

void FilmWriter::add(const view::Image& picture) {
  const auto* bytes = reinterpret_cast<const char*>(picture.pixels.data());
  if (!ffmpeg_.feed({bytes, picture.pixels.size() * sizeof(view::Pixel)})) fail(ffmpeg_.finish());
}

void FilmWriter::finish() {
  const system::FedProgram::Ending ending = ffmpeg_.finish();
  // ffmpeg 5.1 ends with 0 where the film's last bytes find no room on the disk, and only says so.
  const bool unwritten = lastLineOf(ffmpeg_.said()).starts_with("Error ");
  if (!ending.well || unwritten) fail(ending);
  output_.commit();
}

}  // namespace palpate::app
