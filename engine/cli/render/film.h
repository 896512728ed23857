// Pictures one after the other -> a film. WebM and GIF are written by this program (palpate/film); MP4 by the system's
// ffmpeg where it is installed. ffmpeg runs as a separate program, never as a part of this one: it gets raw pictures
// through its input, and an argument list, never a shell.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "palpate/base/output_file.h"
#include "palpate/base/system/fed_program.h"
#include "palpate/film/film.h"
#include "palpate/view/image.h"

namespace palpate::app {

/// Judges by the extension: .webm, .gif or .mp4.
bool isFilm(const std::filesystem::path& file);

/// Throws Error where such a film cannot be made: for .mp4 without ffmpeg on PATH.
void requireFilmWriter(const std::filesystem::path& file, const film::FilmFormat& format);

/// Odd sides get a black row or column.
class FfmpegFilm {
 public:
  /// Starts ffmpeg. Throws Error naming the film.
  FfmpegFilm(const std::filesystem::path& ffmpeg, const std::filesystem::path& film, const film::FilmFormat& format);

  /// Throws Error with ffmpeg's own last words when it has failed.
  void add(const view::Image& picture);
  /// Waits for ffmpeg; the film appears under its name. Throws Error like `add`.
  void finish();

 private:
  [[noreturn]] void fail(const system::FedProgram::Ending& ending);

  std::filesystem::path film_;
  OutputFile output_;
  system::FedProgram ffmpeg_;
};

/// Without `finish` no film is left.
class FilmWriter {
 public:
  /// Throws Error like `requireFilmWriter`, and where the place cannot be written.
  FilmWriter(const std::filesystem::path& file, const film::FilmFormat& format);

  /// Shown from this moment, s. Throws Error.
  void add(const view::Image& picture, double at_s);
  void finish();

 private:
  std::unique_ptr<film::Film> own_;
  std::optional<FfmpegFilm> ffmpeg_;  // in its place
};

}  // namespace palpate::app
