// Any bytes as calls of the C interface: nulls, structures of any size, numbers that are none, indices out of range,
// handles released in any order that is allowed. Each structure has a place on the heap of exactly its size, so that a
// byte written behind it is seen.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "palpate.h"

namespace {

void expect(bool kept) {
  if (!kept) __builtin_trap();
}

/// What the fuzzer says next; zeros where it has said everything.
class Requests {
 public:
  Requests(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool any() const { return size_ > 0; }

  template <class Number>
  Number next() {
    Number number{};
    const std::size_t bytes = std::min(size_, sizeof(number));
    std::memcpy(&number, data_, bytes);
    data_ += bytes;
    size_ -= bytes;
    return number;
  }
  std::size_t below(std::size_t end) { return next<std::uint8_t>() % end; }
  /// Not where everything was said.
  bool seldom() { return below(16) == 15; }

  /// A place on or near the sheet, and now and then what is no place.
  double coordinate() {
    switch (below(24)) {
      case 0:
        return std::numeric_limits<double>::quiet_NaN();
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return next<double>();
      default:
        return next<std::int16_t>() / 1000.0;
    }
  }
  std::string text() {
    std::string text(below(64), '\0');
    for (char& letter : text) letter = static_cast<char>(next<std::uint8_t>());
    return text;
  }
  std::size_t structureSize(std::size_t whole) {
    const std::size_t sizes[] = {
        whole, whole, whole, 0, 1, 8, 12, 16, 32, whole - 8, whole + 8, whole + 64, next<std::uint8_t>()};
    return sizes[below(std::size(sizes))];
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// A structure on the heap of as many bytes as it says.
template <class Struct>
class Given {
 public:
  explicit Given(Requests& requests) : Given(requests, requests.structureSize(sizeof(Struct))) {}
  Given(Requests& requests, std::size_t size) : size_(size), bytes_(std::malloc(std::max(size, sizeof(std::size_t)))) {
    std::memset(bytes_.get(), 0, std::max(size, sizeof(std::size_t)));
    for (std::size_t at = 0; at + 8 <= size && requests.seldom(); at += 8) {
      const auto word = requests.next<std::uint64_t>();
      std::memcpy(static_cast<char*>(bytes_.get()) + at, &word, sizeof word);
    }
    std::memcpy(bytes_.get(), &size, sizeof size);
    is_null_ = requests.seldom();
  }
  Struct* get() const { return is_null_ ? nullptr : static_cast<Struct*>(bytes_.get()); }
  bool has(std::size_t end) const { return !is_null_ && size_ % alignof(Struct) == 0 && size_ >= end; }
  Struct* operator->() const { return static_cast<Struct*>(bytes_.get()); }
  void expectSize() const { expect(std::memcmp(bytes_.get(), &size_, sizeof size_) == 0); }

 private:
  struct Free {
    void operator()(void* bytes) const { std::free(bytes); }
  };
  std::size_t size_;
  std::unique_ptr<void, Free> bytes_;
  bool is_null_ = false;
};

using Error = Given<palpate_error>;

/// The promise of everything that can fail.
void expectAnswer(int32_t code, const Error& error) {
  expect(code >= PALPATE_OK && code <= PALPATE_FAILED);
  error.expectSize();
  if (error.has(16)) expect(error->code == code && error->line >= 0);
  if (error.has(sizeof(palpate_error))) {
    expect(std::memchr(error->message, 0, sizeof error->message) != nullptr);
    expect((code == PALPATE_OK) == (error->message[0] == '\0'));
  }
}

template <class Handle>
void expectHandle(int32_t code, const Error& error, const Handle* handle) {
  expectAnswer(code, error);
  expect((code == PALPATE_OK) == (handle != nullptr));
}

/// Everything that the calls of one input have made.
struct Made {
  std::vector<palpate_world*> worlds = {};
  std::vector<palpate_finger*> fingers = {};
  std::vector<palpate_skin*> skins = {};
  palpate_session* session = nullptr;

  ~Made() {
    for (palpate_world* world : worlds) palpate_world_release(world);
    for (palpate_finger* finger : fingers) palpate_finger_release(finger);
    for (palpate_skin* skin : skins) palpate_skin_release(skin);
    palpate_session_close(session);
  }
};

template <class Handle>
Handle* oneOf(Requests& requests, const std::vector<Handle*>& handles) {
  return handles.empty() || requests.seldom() ? nullptr : handles[requests.below(handles.size())];
}

template <class Handle>
Handle* taken(Requests& requests, std::vector<Handle*>& handles) {
  if (handles.empty()) return nullptr;
  std::swap(handles[requests.below(handles.size())], handles.back());
  Handle* handle = handles.back();
  handles.pop_back();
  return handle;
}

/// A sheet of 3 x 3 vertices, seldom with something wrong in it.
void makeWorld(Requests& requests, Made& made) {
  const bool corrupted = requests.below(4) == 3;
  std::vector<double> positions;
  for (int i = 0; i < 9; ++i) {
    for (const double coordinate : {10.0 * (i % 3), 10.0 * static_cast<int>(i / 3), 0.0}) {
      positions.push_back(corrupted && requests.seldom() ? requests.coordinate() : coordinate);
    }
  }
  std::vector<std::int32_t> corners;
  for (const int a : {0, 1, 3, 4}) {
    for (const int corner : {a, a + 1, a + 4, a, a + 4, a + 3}) {
      corners.push_back(corrupted && requests.seldom() ? requests.next<std::int8_t>() : corner);
    }
  }
  const std::vector<double> stiffness(9, requests.seldom() ? requests.coordinate() : 0.5);
  const std::string scene = requests.seldom() ? requests.text() : "";
  const Given<palpate_arrays> arrays(requests);
  const auto put = [&](std::size_t offset, const auto& value) {
    if (arrays.has(offset + sizeof value))
      std::memcpy(reinterpret_cast<char*>(arrays.operator->()) + offset, &value, sizeof value);
  };
  const double* const no_positions = nullptr;
  const void* const none = nullptr;
  put(offsetof(palpate_arrays, positions_mm), requests.seldom() ? no_positions : positions.data());
  put(offsetof(palpate_arrays, positions_mm_f32), none);
  put(offsetof(palpate_arrays, vertices), std::size_t{9});
  put(offsetof(palpate_arrays, corners), corners.data());
  put(offsetof(palpate_arrays, corners_i64), none);
  put(offsetof(palpate_arrays, triangles),
      requests.seldom() ? std::numeric_limits<std::size_t>::max() : std::size_t{8});
  put(offsetof(palpate_arrays, stiffness_n_per_mm), stiffness.data());
  put(offsetof(palpate_arrays, scene_toml), scene.c_str());
  arrays.expectSize();
  const Error error(requests);
  palpate_world* world = nullptr;
  expectHandle(palpate_world_from_arrays(arrays.get(), &world, error.get()), error, world);
  if (world != nullptr) made.worlds.push_back(world);
}

/// From texts: those that would build a whole body are left out, they take a second.
void makeWorldFromText(Requests& requests, Made& made) {
  const Error error(requests);
  palpate_world* world = nullptr;
  const std::string text = requests.text();
  switch (requests.below(4)) {
    case 0:
      expectHandle(palpate_world_load(("/no/" + text).c_str(), &world, error.get()), error, world);
      break;
    case 1:
      expectHandle(palpate_world_torso(requests.below(100) + 1, &world, error.get()), error, world);
      break;
    case 2:
      expectHandle(palpate_world_parse(("body = 3\n" + text).c_str(), text.c_str(), &world, error.get()), error, world);
      break;
    default:
      expectHandle(palpate_world_rebuilt(oneOf(requests, made.worlds), text.c_str(), nullptr, &world, error.get()),
                   error, world);
  }
  if (world != nullptr) made.worlds.push_back(world);
}

void askWorld(Requests& requests, const Made& made) {
  const palpate_world* world = oneOf(requests, made.worlds);
  const Given<palpate_world_facts> facts(requests);
  expect((palpate_world_get_facts(world, facts.get()) == PALPATE_OK) == (world != nullptr && facts.has(8)));
  facts.expectSize();
  size_t count = 0;
  const uint32_t* map = palpate_world_map(world, requests.next<std::int8_t>(), requests.seldom() ? nullptr : &count);
  for (size_t i = 0; i < count; ++i) expect(map[i] == PALPATE_NONE || map[i] < 1000);
  const Given<palpate_place> place(requests);
  const Error error(requests);
  expectAnswer(
      palpate_world_place(world, requests.seldom() ? nullptr : requests.text().c_str(), place.get(), error.get()),
      error);
  palpate_world_landmark(world, requests.next<std::size_t>(), place.get());
  palpate_world_note(world, requests.next<std::uint8_t>());
  const Given<palpate_lump> lump(requests);
  expect(palpate_world_lump(world, requests.next<std::size_t>(), lump.get()) == PALPATE_ARGUMENT);  // a sheet has none
  lump.expectSize();
  const Given<palpate_finger_settings> settings(requests);
  palpate_world_finger_settings(world, requests.next<std::size_t>(), settings.get());
  settings.expectSize();
}

void makeFinger(Requests& requests, Made& made) {
  const Given<palpate_finger_settings> settings(requests);
  const Error error(requests);
  if (requests.below(4) != 0 && settings.has(8)) {
    std::size_t size = 0;
    std::memcpy(&size, settings.operator->(), sizeof size);
    palpate_finger_settings_init(settings.get(), size);
    settings.expectSize();
    if (settings.has(16)) settings->radius_mm = requests.seldom() ? requests.coordinate() : requests.below(3);
  }
  palpate_finger* finger = nullptr;
  expectHandle(palpate_finger_create(oneOf(requests, made.worlds), settings.get(), &finger, error.get()), error,
               finger);
  if (finger != nullptr) made.fingers.push_back(finger);
}

void step(Requests& requests, const Made& made) {
  palpate_finger* finger = oneOf(requests, made.fingers);
  const Given<palpate_touch> touch(requests);
  const double tip[3] = {requests.coordinate(), requests.coordinate(), requests.coordinate()};
  const int32_t code = palpate_finger_step(finger, tip, touch.get());
  touch.expectSize();
  expect((code == PALPATE_OK) == (finger != nullptr && touch.has(8)));
  if (code != PALPATE_OK || !touch.has(48)) return;
  for (const double force : touch->force_n) expect(std::isfinite(force));
  const bool is_place = std::isfinite(tip[0]) && std::isfinite(tip[1]) && std::isfinite(tip[2]);
  expect(is_place || touch->status == PALPATE_TIP_LOST);
}

/// A sheet's tissue has no layers, so what is asked for is refused, and nothing is written.
void askPressure(Requests& requests, const Made& made) {
  const std::size_t taxels = requests.seldom() ? requests.next<std::size_t>() : requests.below(18);
  const double pad_mm = requests.coordinate();
  const std::size_t room = taxels <= 16 ? taxels * taxels : 1;
  std::vector<float> kpa(std::max<std::size_t>(room, 1), 7.0f), shear(2 * kpa.size(), 7.0f);
  const int32_t code =
      palpate_finger_pressure(oneOf(requests, made.fingers), taxels, pad_mm, requests.seldom() ? nullptr : kpa.data(),
                              requests.seldom() ? nullptr : shear.data());
  expect(code == PALPATE_ARGUMENT || code == PALPATE_REFUSED);
  for (const float pressure : kpa) expect(pressure == 7.0f);
}

void rollout(Requests& requests, const Made& made) {
  const std::size_t count = requests.below(6);
  const std::size_t stride = requests.structureSize(sizeof(palpate_touch));
  std::vector<double> tips(3 * count);
  for (double& tip : tips) tip = requests.coordinate();
  const std::unique_ptr<char[]> touches(new char[count * stride + 1]);  // as malloc: aligned for any structure
  palpate_finger_rollout(oneOf(requests, made.fingers), requests.seldom() ? nullptr : tips.data(), count,
                         requests.seldom() ? nullptr : reinterpret_cast<palpate_touch*>(touches.get()), stride);
}

void makeSkin(Requests& requests, Made& made) {
  const Error error(requests);
  palpate_skin* skin = nullptr;
  const std::size_t fingers = requests.seldom() ? requests.next<std::size_t>() : requests.below(5);
  expectHandle(
      palpate_skin_create(oneOf(requests, made.worlds), fingers, requests.next<std::int8_t>(), &skin, error.get()),
      error, skin);
  if (skin != nullptr) made.skins.push_back(skin);
}

void apply(Requests& requests, const Made& made) {
  palpate_skin* skin = oneOf(requests, made.skins);
  Given<palpate_touch> touch(requests);
  palpate_finger* finger = oneOf(requests, made.fingers);
  const double tip[3] = {requests.coordinate(), requests.coordinate(), requests.coordinate()};
  if (!requests.seldom()) palpate_finger_step(finger, tip, touch.get());
  if (touch.has(48) && requests.below(3) == 0) {
    touch->touch = requests.next<std::int8_t>() % 4;
    touch->depth_mm = requests.coordinate();
  }
  std::size_t size = 0;
  std::memcpy(&size, touch.operator->(), sizeof size);
  palpate_skin_apply(skin, touch.get(), requests.seldom() ? 0 : 1, size);
  const size_t vertices = palpate_skin_vertices(skin);
  for (int axis = -1; axis < 4; ++axis) {
    const float* positions = palpate_skin_positions(skin, axis);
    for (size_t v = 0; positions != nullptr && v < vertices; ++v) expect(std::isfinite(positions[v]));
  }
  size_t count = 0;
  const uint32_t* changed = palpate_skin_changed(skin, &count);
  for (size_t i = 0; i < count; ++i) expect(changed[2 * i] < changed[2 * i + 1]);
}

void askSession(Requests& requests, Made& made) {
  const Error error(requests);
  if (made.session == nullptr) {
    const char* file = requests.seldom() ? nullptr : PALPATE_SOURCE_DIR "/tests/data/sessions/version_1/press.session";
    expectHandle(palpate_session_open(file, &made.session, error.get()), error, made.session);
    return;
  }
  const Given<palpate_session_facts> facts(requests);
  palpate_session_get_facts(made.session, facts.get());
  facts.expectSize();
  const Given<palpate_session_finger> finger(requests);
  palpate_session_get_finger(made.session, requests.next<std::uint8_t>(), finger.get());
  finger.expectSize();
  const std::size_t room = requests.below(9);
  const std::size_t stride = requests.structureSize(sizeof(palpate_sample));
  const std::size_t touch_stride = requests.structureSize(sizeof(palpate_touch));
  const std::unique_ptr<char[]> samples(new char[room * stride + 1]);
  const std::unique_ptr<char[]> touches(new char[room * touch_stride + 1]);
  size_t count = 0;
  expectAnswer(
      palpate_session_read(made.session, requests.next<std::uint8_t>(), requests.next<std::uint64_t>(),
                           requests.seldom() ? nullptr : reinterpret_cast<palpate_sample*>(samples.get()), stride,
                           requests.seldom() ? nullptr : reinterpret_cast<palpate_touch*>(touches.get()), touch_stride,
                           room, requests.seldom() ? nullptr : &count, error.get()),
      error);
  expect(count <= room);
}

void release(Requests& requests, Made& made) {
  switch (requests.below(6)) {
    case 0:
      palpate_world_release(taken(requests, made.worlds));
      break;
    case 1:
      palpate_finger_release(taken(requests, made.fingers));
      break;
    case 2:
      palpate_skin_release(taken(requests, made.skins));
      break;
    case 3: {
      palpate_world* world = oneOf(requests, made.worlds);
      palpate_world_retain(world);
      if (world != nullptr) made.worlds.push_back(world);
      break;
    }
    case 4:
      palpate_finger_lift(oneOf(requests, made.fingers));
      break;
    default:
      palpate_session_close(made.session);
      made.session = nullptr;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Requests requests(data, size);
  Made made;
  using Call = void (*)(Requests&, Made&);
  const Call calls[] = {
      [](Requests& w, Made& m) { makeWorld(w, m); },   [](Requests& w, Made& m) { makeWorldFromText(w, m); },
      [](Requests& w, Made& m) { askWorld(w, m); },    [](Requests& w, Made& m) { makeFinger(w, m); },
      [](Requests& w, Made& m) { step(w, m); },        [](Requests& w, Made& m) { rollout(w, m); },
      [](Requests& w, Made& m) { makeSkin(w, m); },    [](Requests& w, Made& m) { apply(w, m); },
      [](Requests& w, Made& m) { askSession(w, m); },  [](Requests& w, Made& m) { release(w, m); },
      [](Requests& w, Made& m) { askPressure(w, m); },
  };
  for (int i = 0; i < 64 && requests.any(); ++i) calls[requests.below(std::size(calls))](requests, made);
  return 0;
}
