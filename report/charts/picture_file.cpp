#include "report/charts/picture_file.h"

#include "palpate/base/error.h"

namespace palpate::app {

void checkPictureName(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".png" && extension != ".svg") throw Error::inFile(file.string(), "a plot is written as .png, .svg");
}

void writePicture(const figures::Figure& figure, const std::filesystem::path& file, double png_scale) {
  checkPictureName(file);
  file.extension() == ".svg" ? figures::writeSvg(figure, file) : figures::writePng(figure, file, png_scale);
}

}  // namespace palpate::app
