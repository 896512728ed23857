// Pictures one after the other -> a film (MP4, WebM), by the system's ffmpeg where it is installed. ffmpeg is a program
// beside this one, never a part of it: it is given raw pictures through its input, and an argument list, never a shell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "palpate/base/output_file.h"
#include "palpate/base/system/fed_program.h"
#include "palpate/view/image.h"

namespace palpate::app {

/// By its extension: .mp4 or .webm.
bool isFilm(const std::filesystem::path& file);

/// The first ffmpeg on PATH; nothing when there is none.
std::optional<std::filesystem::path> installedFfmpeg();

struct FilmFormat {
  view::ImageSize size;  ///< of every picture; odd sides get a black row or column
  double frames_per_s = 25.0;
};

/// What one types to make the film of numbered pictures, FILM_0001.png and so on beside it.
std::string commandToJoin(const std::filesystem::path& film, double frames_per_s);

/// Without `finish` ffmpeg is ended and no film is left.
class FilmWriter {
 public:
  /// Starts ffmpeg. Throws Error naming the film.
  FilmWriter(const std::filesystem::path& ffmpeg, const std::filesystem::path& film, const FilmFormat& format);

  /// Throws Error with ffmpeg's own last words when it has given up.
  void add(const view::Image& picture);
  /// Waits for ffmpeg; the film appears under its name. Throws Error like `add`.
  void finish();

 private:
  [[noreturn]] void fail(const system::FedProgram::Ending& ending);

  std::filesystem::path film_;
  OutputFile output_;
  system::FedProgram ffmpeg_;
};

}  // namespace palpate::app
