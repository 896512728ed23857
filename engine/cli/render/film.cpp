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
/// Every player shows yuv420p; it needs even sides.
constexpr const char* kEvenSides = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p";

std::vector<std::string> argumentsFor(const std::filesystem::path& written, const film::FilmFormat& format) {
  std::vector<std::string> words = {kProgram, "-loglevel", "error", "-nostats", "-y"};
  const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  add({"-f", "rawvideo", "-pixel_format", "rgb24"});
  add({"-video_size", fmt::format("{}x{}", format.size.width, format.size.height)});
  add({"-framerate", fmt::format("{}", format.frames_per_s), "-i", "pipe:0"});
  add({"-vf", kEvenSides, "-colorspace", "bt709", "-color_primaries", "bt709"});
  add({"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"});  // no visible loss
  // "file:" and the whole path: a name is never taken for an option or an address.
  add({"-f", "mp4", "file:" + std::filesystem::absolute(written).string()});
  return words;
}

/// The last line that is not empty.
std::string lastNonEmptyLine(std::string_view words) {
  std::string last;
  for (const std::string_view line : split(words, '\n')) {
    if (!trimmed(line).empty()) last = trimmed(line);
  }
  return last;
}

bool isMp4(const std::filesystem::path& film) { return film.extension() == ".mp4"; }

/// The first ffmpeg on PATH; empty when there is none.
std::optional<std::filesystem::path> installedFfmpeg() {
  const std::string path = system::variable("PATH");
  for (const std::string_view folder : split(path, system::kBetweenFolders)) {
    if (folder.empty()) continue;  // the current folder: a program there is not the system's
    const std::filesystem::path program = pathOf(folder) / pathOf(std::string(kProgram) + system::kProgramExtension);
    if (std::filesystem::is_regular_file(program) && system::mayRun(program)) return program;
  }
  return std::nullopt;
}

std::filesystem::path requiredFfmpeg(const std::filesystem::path& film) {
  if (auto ffmpeg = installedFfmpeg()) return *ffmpeg;
  const std::string name = film.stem().string();
  throw Error::inFile(film.string(),
                      fmt::format("MP4 requires ffmpeg, which is not installed; {0}.webm and {0}.gif do not", name));
}

}  // namespace

bool isFilm(const std::filesystem::path& file) { return isMp4(file) || film::isOwnFilm(file); }

void requireFilmWriter(const std::filesystem::path& file, const film::FilmFormat& format) {
  isMp4(file) ? static_cast<void>(requiredFfmpeg(file)) : film::requireFilm(file, format);
}

FfmpegFilm::FfmpegFilm(const std::filesystem::path& ffmpeg, const std::filesystem::path& film,
                       const film::FilmFormat& format)
    : film_(film), output_(film), ffmpeg_(ffmpeg, argumentsFor(output_.partial(), format)) {
  if (ffmpeg_.reason() == 0) return;
  throw Error::inFile(film_.string(), "ffmpeg cannot be started: " + std::generic_category().message(ffmpeg_.reason()));
}

void FfmpegFilm::fail(const system::FedProgram::Ending& ending) {
  const std::string words = lastNonEmptyLine(ffmpeg_.said());
  throw Error::inFile(film_.string(), fmt::format("ffmpeg failed to write the film ({}){}{}", ending.how,
                                                  words.empty() ? "" : ": ", words));
}

void FfmpegFilm::add(const view::Image& picture) {
  const auto* bytes = reinterpret_cast<const char*>(picture.pixels.data());
  if (!ffmpeg_.feed({bytes, picture.pixels.size() * sizeof(view::Pixel)})) fail(ffmpeg_.finish());
}

void FfmpegFilm::finish() {
  const system::FedProgram::Ending ending = ffmpeg_.finish();
  // ffmpeg 5.1 ends with 0 where the film's last bytes find no room on the disk, and only prints an error.
  const bool unwritten = lastNonEmptyLine(ffmpeg_.said()).starts_with("Error ");
  if (!ending.well || unwritten) fail(ending);
  output_.commit();
}

FilmWriter::FilmWriter(const std::filesystem::path& file, const film::FilmFormat& format) {
  if (isMp4(file)) {
    ffmpeg_.emplace(requiredFfmpeg(file), file, format);
  } else {
    own_ = film::beginFilm(file, format);
  }
}

void FilmWriter::add(const view::Image& picture, double at_s) {
  ffmpeg_ ? ffmpeg_->add(picture) : own_->add(picture, at_s);
}

void FilmWriter::finish() { ffmpeg_ ? ffmpeg_->finish() : own_->finish(); }

}  // namespace palpate::app
