// The module palpate._view: pictures of a world without a window or a display, as arrays. palpate/view.py is its face.
//
//   World, Skin, touches, options ─► PictureJob (copies what may change) ─► DrawingThread ─► (H, W, 3) uint8
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "arrays.h"
#include "dicts.h"
#include "drawing_thread.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/scene/host.h"
#include "palpate/scene/world.h"
#include "palpate/view/picture.h"
#include "palpate/view/scene_view.h"
#include "skin_handle.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

// The words of Python's `render` as view settings: a table of keys, each with its setting.

/// Options of the dict other than the view settings.
struct PictureOptions {
  scene::ViewSettings view;
  std::string title;
  bool labels = true;
  std::optional<double> radius_mm;  ///< radius of the fingers; none: the scene's
};

std::string text(py::handle value, const char* key) {
  if (!py::isinstance<py::str>(value)) throw py::type_error(fmt::format("{}: expected a string", key));
  return value.cast<std::string>();
}

template <class Value>
Value word(py::handle value, const char* key) {
  const std::string name = text(value, key);
  if (const auto found = valueNamed<Value>(name)) return *found;
  throw py::value_error(std::string(key) + ": " + unknownName("word", name, "", wordList<Value>()));
}

double number(py::handle value, const char* key, double least, double most) {
  const double given = py::float_(py::reinterpret_borrow<py::object>(value));
  if (given >= least && given <= most) return given;
  throw py::value_error(fmt::format("{} = {:g} is out of range: {:g} to {:g}", key, given, least, most));
}

bool truth(py::handle value) { return py::bool_(py::reinterpret_borrow<py::object>(value)); }

/// One name or several.
std::vector<scene::Overlay> overlays(py::handle value, const char* key) {
  if (py::isinstance<py::str>(value)) return {word<scene::Overlay>(value, key)};
  std::vector<scene::Overlay> all;
  for (const py::handle one : py::reinterpret_borrow<py::object>(value)) all.push_back(word<scene::Overlay>(one, key));
  return all;
}

Vec2 range(py::handle value, const char* key) {
  const auto ends = asFloats(value, key);
  if (ends.ndim() != 1 || ends.size() != 2 || !(ends.at(0) < ends.at(1))) {
    throw py::value_error(std::string(key) + ": expected two increasing numbers");
  }
  return {ends.at(0), ends.at(1)};
}

struct Option {
  const char* key;
  void (*set)(PictureOptions& options, const scene::World& world, py::handle value, const char* key);
};

constexpr std::array kOptions = {
    Option{"side",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.side = word<scene::StandardView>(v, key); }},
    Option{"yaw_deg",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.yaw_deg = number(v, key, -180, 180); }},
    Option{"pitch_deg",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.pitch_deg = number(v, key, -89, 89); }},
    Option{"zoom", [](auto& o, const auto&, py::handle v, auto* key) { o.view.zoom = number(v, key, 0.01, 1000); }},
    Option{"distance_mm",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.distance_mm = number(v, key, 0, 1e6); }},
    Option{"look_at",
           [](auto& o, const auto& world, py::handle v, auto*) { o.view.look_at_mm = placeOn(world, v).point; }},
    Option{"colours",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.colours = word<scene::Colouring>(v, key); }},
    Option{"show", [](auto& o, const auto&, py::handle v, auto* key) { o.view.show = overlays(v, key); }},
    Option{"shading",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.shading = word<scene::Shading>(v, key); }},
    Option{"opacity", [](auto& o, const auto&, py::handle v, auto* key) { o.view.opacity = number(v, key, 0, 1); }},
    Option{"skin_tone", [](auto& o, const auto&, py::handle v, auto* key) { o.view.skin_tone = number(v, key, 1, 6); }},
    Option{"dent_contrast",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.dent_contrast = number(v, key, 0, 10); }},
    Option{"lens", [](auto& o, const auto&, py::handle v, auto*) { o.view.lens = truth(v); }},
    Option{"finger",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.finger = word<scene::FingerShape>(v, key); }},
    Option{"stereo",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.stereo = word<scene::StereoMode>(v, key); }},
    Option{"stiffness_range",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.stiffness_range_n_per_mm = range(v, key); }},
    Option{"scalar", [](auto& o, const auto&, py::handle v, auto* key) { o.view.scalar = text(v, key); }},
    Option{"white_background", [](auto& o, const auto&, py::handle v, auto*) { o.view.white_background = truth(v); }},
    Option{"labels", [](auto& o, const auto&, py::handle v, auto*) { o.labels = truth(v); }},
    Option{"title", [](auto& o, const auto&, py::handle v, auto* key) { o.title = text(v, key); }},
    Option{"radius_mm", [](auto& o, const auto&, py::handle v, auto* key) { o.radius_mm = number(v, key, 0, 1000); }},
};

/// Keys with None are as the world's scene has them. Throws ValueError or TypeError naming the key.
PictureOptions pictureOptions(const scene::World& world, const py::dict& options) {
  PictureOptions all;
  all.view = world.scene.view;
  for (const auto& [key, value] : options) {
    const auto name = key.cast<std::string>();
    const auto option =
        std::find_if(kOptions.begin(), kOptions.end(), [&](const Option& one) { return one.key == name; });
    if (option == kOptions.end()) {
      std::vector<std::string> known;
      for (const Option& one : kOptions) known.emplace_back(one.key);
      throw py::value_error(unknownName("option", name, "", known));
    }
    if (!value.is_none()) option->set(all, world, value, option->key);
  }
  return all;
}

constexpr double kFingertipMm = 8.0;  // a point finger is drawn as a fingertip
constexpr int kLargestSide = 16384;

/// Freed not at exit but by `close`: waiting for a driver at the interpreter's end may hang.
std::unique_ptr<DrawingThread>& sharedDrawingThread() {
  static auto* thread = new std::unique_ptr<DrawingThread>();
  return *thread;
}

DrawingThread& drawingThread() {
  auto& thread = sharedDrawingThread();
  if (thread && thread->isOfAnotherProcess()) {
    throw std::runtime_error(
        "palpate.view: this process was forked from one that had drawn, and OpenGL does not survive that; start it "
        "again (multiprocessing's \"spawn\"), or draw nothing before the fork");
  }
  if (!thread) thread = std::make_unique<DrawingThread>();
  return *thread;
}

/// With the interpreter's lock. The child of a fork leaves alone what is not its own.
void closeDrawing() {
  auto& thread = sharedDrawingThread();
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
    mark.pad = view::fingerPad(world.scene, i);
    marks.push_back(mark);
  }
  return marks;
}

/// The present skin: copied, since it may change while the picture is drawn.
void captureSkin(const WorldPointer& world, const py::object& skin, const std::vector<contact::FingerOutput>& touches,
                 PictureJob& job) {
  if (skin.is_none()) {
    engine::LivingSkin living(*world->world, {.strain = true, .fingers = std::max<std::size_t>(1, touches.size())});
    living.follow(touches);
    job.surface = living.surface();
    job.lift_mm = living.lift();
    return;
  }
  if (!py::isinstance<SkinHandle>(skin)) throw py::type_error("skin: expected a palpate.Skin or None");
  auto& given = skin.cast<SkinHandle&>();
  if (given.world()->world != world->world) throw py::value_error("skin: it belongs to another world");
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

py::array_t<std::uint8_t> copyPixels(const view::Image& image) {
  py::array_t<std::uint8_t> array({image.height, image.width, 3});
  static_assert(sizeof(view::Pixel) == 3);
  std::copy_n(reinterpret_cast<const std::uint8_t*>(image.pixels.data()), image.pixels.size() * 3,
              array.mutable_data());
  return array;
}

using Drawn = std::tuple<PixelArray, std::vector<std::string>>;

Drawn draw(const WorldPointer& world, const py::object& skin, const py::object& touches,
           const std::pair<std::int64_t, std::int64_t>& size, int supersampling, const py::dict& options) {
  if (supersampling < 1 || supersampling > 4) throw py::value_error("supersampling: must be 1 to 4");
  const PictureOptions wanted = pictureOptions(*world->world, options);
  const std::vector<contact::FingerOutput> felt = asTouches(touches);
  const auto job = std::make_shared<PictureJob>();
  job->world = world->world;
  job->size = {side(size.first, "width"), side(size.second, "height"), supersampling};
  const double aspect = view::eyePictureIn(wanted.view.stereo, job->size.width, job->size.height).aspect();
  job->settings = view::pictureSettings(*world->world, wanted.view, aspect);
  if (!wanted.labels) job->settings.labels = view::LabelSettings::none();
  job->settings.labels.title = wanted.title;
  job->fingers = marksFor(*world->world, felt, wanted.radius_mm);
  captureSkin(world, skin, felt, *job);
  const view::TakenPicture taken = waitFor(drawingThread().draw(job));
  return {PixelArray(copyPixels(taken.image)), taken.notes};
}

void savePng(const std::filesystem::path& file, const py::object& picture) {
  const py::array any = py::array::ensure(picture);
  if (!any || any.ndim() != 3 || any.shape(2) != 3 || any.dtype().kind() != 'u' || any.dtype().itemsize() != 1) {
    throw py::value_error("picture: expected an array (H, W, 3) of uint8");
  }
  const auto bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(any);
  view::Image image(side(bytes.shape(1), "width"), side(bytes.shape(0), "height"));
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<std::uint8_t*>(image.pixels.data()));
  unlocked([&](Interrupts&) { view::writePng(file, image); });
}

}  // namespace

PYBIND11_MODULE(_view, module) {
  installHost();
  module.doc() = "Drawing without a display; use palpate.view.";
  py::module_::import("palpate._core");  // the types of worlds, skins and touches, and palpate.Error
  module.def("draw", draw, py::arg("world"), py::arg("skin"), py::arg("touches"), py::arg("size"),
             py::arg("supersampling"), py::arg("options"),
             "A picture (H, W, 3) of uint8 and notes about it; palpate.view.render has the words.");
  module.def("save", savePng, py::arg("file"), py::arg("picture"),
             "Writes an array (H, W, 3) of uint8 as a PNG file. Raises ValueError, Error.");
  module.def("_close", closeDrawing, "Ends the drawing thread; the next picture starts a new one.");
  py::module_::import("atexit").attr("register")(module.attr("_close"));
}

}  // namespace palpate::python
