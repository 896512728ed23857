// The module palpate._view: pictures of a world without a window or a display, as arrays. palpate/view.py is its face.
//
//   World, Skin, touches, options ─► PictureJob (copies what may change) ─► DrawingThread ─► (H, W, 3) uint8
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <iterator>

#include "arrays.h"
#include "dicts.h"
#include "drawing_thread.h"
#include "interrupts.h"
#include "palpate/view/scene_view.h"
#include "picture_options.h"
#include "skin_handle.h"

namespace palpate::python {

namespace {

constexpr double kFingertipMm = 8.0;  // a point finger is drawn as a fingertip
constexpr int kLargestSide = 16384;

/// Not freed at exit but by `close`: the interpreter's end is no time to wait for a driver.
std::unique_ptr<DrawingThread>& theThread() {
  static auto* thread = new std::unique_ptr<DrawingThread>();
  return *thread;
}

DrawingThread& drawingThread() {
  auto& thread = theThread();
  if (thread && thread->isOfAnotherProcess()) {
    throw std::runtime_error(
        "palpate.view: this process was forked from one that had drawn, and OpenGL does not survive that; start it "
        "anew (multiprocessing's \"spawn\"), or draw nothing before the fork");
  }
  if (!thread) thread = std::make_unique<DrawingThread>();
  return *thread;
}

/// With the interpreter's lock. The child of a fork leaves alone what is not its own.
void closeDrawing() {
  auto& thread = theThread();
  if (thread && thread->isOfAnotherProcess()) {
    static_cast<void>(thread.release());
    return;
  }
  std::unique_ptr<DrawingThread> ending = std::move(thread);
  const Unlocked free;
  ending.reset();
}

std::vector<view::FingerMark> marksFor(const scene::World& world, const std::vector<contact::FingerOutput>& touches,
                                       const std::optional<double>& radius_mm) {
  const Vec3f colours[] = {view::kLeftFinger, view::kRightFinger, view::kOtherFinger};
  std::vector<view::FingerMark> marks;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const double scene_mm = i < world.scene.fingers.size() ? world.scene.fingers[i].radius_mm : 0.0;
    view::FingerMark mark;
    mark.contact = touches[i];
    mark.haptic_radius_mm = radius_mm.value_or(scene_mm);
    mark.radius_mm = mark.haptic_radius_mm > 0.0 ? mark.haptic_radius_mm : kFingertipMm;
    mark.colour = colours[std::min(i, std::size(colours) - 1)];
    mark.left = i % 2 == 0;
    marks.push_back(mark);
  }
  return marks;
}

/// The skin as it is now: copied, since it may change while the picture is drawn.
void takeSkin(const WorldPointer& world, const py::object& skin, const std::vector<contact::FingerOutput>& touches,
              PictureJob& job) {
  if (skin.is_none()) {
    engine::LivingSkin living(*world->world, {.strain = true, .fingers = std::max<std::size_t>(1, touches.size())});
    living.follow(touches);
    job.surface = living.surface();
    job.lift_mm = living.lift();
    return;
  }
  if (!py::isinstance<SkinHandle>(skin)) throw py::type_error("skin: a palpate.Skin or None");
  auto& given = skin.cast<SkinHandle&>();
  if (given.world()->world != world->world) throw py::value_error("skin: it is of another world");
  const Busy::Guard guard(given.busy(), "this Skin");
  job.surface = given.skin().surface();
  job.lift_mm = given.skin().lift();
}

int side(std::int64_t pixels, const char* what) {
  if (pixels < 1 || pixels > kLargestSide) {
    throw py::value_error(fmt::format("size: a {} of {} pixels is out of range: 1 to {}", what, pixels, kLargestSide));
  }
  return static_cast<int>(pixels);
}

view::TakenPicture waitFor(std::future<view::TakenPicture> picture) {
  return unlocked([&](Interrupts& interrupts) {
    while (picture.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready) interrupts.check();
    return picture.get();
  });
}

py::array_t<std::uint8_t> arrayOf(const view::Image& image) {
  py::array_t<std::uint8_t> array({image.height, image.width, 3});
  static_assert(sizeof(view::Pixel) == 3);
  std::copy_n(reinterpret_cast<const std::uint8_t*>(image.pixels.data()), image.pixels.size() * 3,
              array.mutable_data());
  return array;
}

using Drawn = std::tuple<PixelArray, std::vector<std::string>>;

Drawn draw(const WorldPointer& world, const py::object& skin, const py::object& touches,
           const std::pair<std::int64_t, std::int64_t>& size, int supersampling, const py::dict& options) {
  if (supersampling < 1 || supersampling > 4) throw py::value_error("supersampling: 1 to 4");
  const PictureOptions wanted = pictureOptions(*world->world, options);
  const std::vector<contact::FingerOutput> felt = touchesOf(touches);
  const auto job = std::make_shared<PictureJob>();
  job->world = world->world;
  job->size = {side(size.first, "width"), side(size.second, "height"), supersampling};
  const double aspect = view::eyePictureIn(wanted.view.stereo, job->size.width, job->size.height).aspect();
  job->settings = view::pictureSettings(*world->world, wanted.view, aspect);
  if (!wanted.labels) job->settings.labels = view::LabelSettings::none();
  job->settings.labels.title = wanted.title;
  job->fingers = marksFor(*world->world, felt, wanted.radius_mm);
  takeSkin(world, skin, felt, *job);
  const view::TakenPicture taken = waitFor(drawingThread().draw(job));
  return {PixelArray(arrayOf(taken.image)), taken.notes};
}

void savePng(const std::filesystem::path& file, const py::object& picture) {
  const py::array any = py::array::ensure(picture);
  if (!any || any.ndim() != 3 || any.shape(2) != 3 || any.dtype().kind() != 'u' || any.dtype().itemsize() != 1) {
    throw py::value_error("picture: an array (H, W, 3) of uint8 is wanted");
  }
  const auto bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(any);
  view::Image image(side(bytes.shape(1), "width"), side(bytes.shape(0), "height"));
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<std::uint8_t*>(image.pixels.data()));
  unlocked([&](Interrupts&) { view::writePng(file, image); });
}

}  // namespace

PYBIND11_MODULE(_view, module) {
  module.doc() = "Drawing without a display; use palpate.view.";
  py::module_::import("palpate._core");  // the types of worlds, skins and touches, and palpate.Error
  module.def("draw", draw, py::arg("world"), py::arg("skin"), py::arg("touches"), py::arg("size"),
             py::arg("supersampling"), py::arg("options"),
             "A picture (H, W, 3) of uint8 and notes about it; palpate.view.render has the words.");
  module.def("save", savePng, py::arg("file"), py::arg("picture"),
             "Writes an array (H, W, 3) of uint8 as a PNG file. Raises ValueError, Error.");
  module.def("_close", closeDrawing, "Ends the drawing thread; the next picture starts another.");
  py::module_::import("atexit").attr("register")(module.attr("_close"));
}

}  // namespace palpate::python
