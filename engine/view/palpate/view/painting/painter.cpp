// The mode that the canvas can show -> eyes moved together where the parallax would tire -> one page of labels -> each
// eye drawn, the page over it -> both composed. The page is in the screen, so it is laid out once for both; only one
// with names, whose dots are on the skin, is laid out for each.
#include "palpate/view/painter.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "palpate/mesh/triangle_mesh.h"
#include "palpate/view/layers/drawing.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/stereo_composer.h"
#include "palpate/view/overlays/labels.h"
#include "palpate/view/overlays/lens.h"
#include "palpate/view/overlays/muscle_marks.h"
#include "palpate/view/support_shape.h"

namespace palpate::view {

namespace {

/// The current picture.
struct Job {
  const Frame& frame;
  const deform::DeformedSurface& surface;
  const PictureSettings& settings;
  const Canvas& canvas;
  const Painter::DrawOver& draw_over;
  StereoSettings stereo;
  EyePicture picture;
  Eyes eyes;
  std::vector<PadReading> pads = {};
  std::optional<CutAway> cut = {};
};

/// A rectangle of the page, points.
struct Part {
  Vec2f corner;  ///< upper left
  Vec2f size;
};

/// The page of one eye, points.
Vec2f wholePage(const EyePicture& picture, const Canvas& canvas) {
  return Vec2f(picture.seen_width, picture.seen_height) / static_cast<float>(canvas.pixels_per_point);
}

/// The part of it for labels; never empty.
Part labelledPart(const EyePicture& picture, const Canvas& canvas) {
  const auto& [left, top, right, below] = canvas.covered;
  const Vec2f size = wholePage(picture, canvas) - Vec2f(left + right, top + below);
  return {Vec2f(left, top), size.cwiseMax(Vec2f(1.0f, 1.0f))};
}

/// The part of a screen that a part of its picture shows.
Screen partOf(const Screen& screen, const Part& part, const Vec2f& whole) {
  const Vec3 right = screen.lower_right - screen.lower_left;
  const Vec3 down = screen.lower_left - screen.upper_left;
  const Vec2 from = part.corner.cwiseQuotient(whole).cast<double>();
  const Vec2 to = (part.corner + part.size).cwiseQuotient(whole).cast<double>();
  const auto at = [&](double x, double y) { return Vec3(screen.upper_left + x * right + y * down); };
  return {at(from.x(), to.y()), at(to.x(), to.y()), at(from.x(), from.y())};
}

}  // namespace

struct Painter::Impl {
  std::shared_ptr<const scene::World> world;
  Eigen::AlignedBox3d box;           // box of the body
  Eigen::AlignedBox3d with_support;  // with its support: all that is drawn
  Renderer renderer;
  StereoComposer composer;
  Drawing page;
  std::optional<Target> smaller;  // where the body has fewer pixels than the picture
  std::vector<BodyName> names;
  bool named_places = false, named_muscles = false;  // contents of `names`
  std::optional<PadReader> pads;                     // made when first shown, as names are
  std::optional<CutMaker> cutter;

  explicit Impl(std::shared_ptr<const scene::World> shown) : world(std::move(shown)), renderer(world) { measure(); }

  void measure() {
    with_support = box = mesh::boundingBox(world->body->skin);
    if (const auto slab = supportSlab(*world)) with_support.extend(slab->box());
  }

  void forgetNames() {
    names.clear();
    named_places = named_muscles = false;
  }

  /// The names of the look, made when first shown.
  std::span<const BodyName> namesFor(const Look& look) {
    const bool places = look.shows(Overlay::names);
    const bool muscles = look.shows(Overlay::muscles);
    if (named_places == places && named_muscles == muscles) return names;
    named_places = places;
    named_muscles = muscles;
    names = places ? bodyNames(*world) : std::vector<BodyName>();
    if (muscles) {
      for (BodyName& name : muscleNames(*world)) names.push_back(std::move(name));
    }
    return names;
  }

  /// Reads the tissue below the fingers for the look.
  void readBeneath(Job& job) {
    const Look& look = job.settings.look;
    if (!job.settings.labels.beneath) return;
    if (look.shows(Overlay::pressure)) {
      if (!pads) pads.emplace(*world);
      job.pads = pads->read(job.frame.fingers, job.frame.lift_mm);
    }
    if (look.shows(Overlay::cut)) {
      if (!cutter) cutter.emplace(*world);
      const auto deformed = [&](Index v) { return job.surface.placeAt(v); };
      job.cut = cutter->cut(job.frame.fingers, deformed);
    }
  }

  std::vector<std::string> notesOn(const Look& look) {
    std::vector<std::string> notes;
    const auto& landmarks = world->body->anatomy.landmarks;
    const auto is_place = [](const BodyName& name) { return name.kind != NameKind::muscle; };
    if (look.shows(Overlay::names) && std::ranges::none_of(namesFor(look), is_place))
      notes.emplace_back("this body has no named places");
    if (look.shows(Overlay::muscles) && !hasMuscles(landmarks)) notes.emplace_back(kNoMuscles);
    if (look.shows(Overlay::lumps) && world->lumps.empty()) notes.emplace_back("this body has no lumps");
    if (look.shows(Overlay::pressure) && pads && !pads->missing().empty()) notes.push_back(pads->missing());
    return notes;
  }

  void preparePage(const Job& job, const Vec3& eye) {
    page.begin(labelledPart(job.picture, job.canvas).size, job.canvas.pixels_per_point);
    Eyes eyes = job.eyes;
    eyes.screen = partOf(eyes.screen, labelledPart(job.picture, job.canvas), wholePage(job.picture, job.canvas));
    drawLabels(page,
               {*world, job.surface, job.frame, job.settings.look, job.settings.camera, eyes,
                namesFor(job.settings.look), eye, job.pads, job.cut ? &*job.cut : nullptr},
               job.settings.labels);
    page.end();
  }

  /// Draws the lens in a part of the framebuffer, the same for both eyes.
  void paintLens(const Job& job, const EyePicture& picture, const Frame& frame, const Frustum& whole) {
    const Part page_part = labelledPart(job.picture, job.canvas);
    const auto place = lensPlace(job.settings.look, frame.fingers, page_part.size);
    if (!place) return;
    const Vec2f pixels = Vec2f(picture.width, picture.height).cwiseQuotient(wholePage(job.picture, job.canvas));
    const Eigen::Vector2i corner = (page_part.corner + place->corner).cwiseProduct(pixels).cast<int>();
    const Eigen::Vector2i size = place->size.cwiseProduct(pixels).cast<int>();
    const int below = picture.height - corner.y() - size.y();
    Look look = job.settings.look;
    look.overlays.reset();  // made for the whole picture, they would hide the dent
    glViewport(corner.x(), below, size.x(), size.y());
    glScissor(corner.x(), below, size.x(), size.y());
    glEnable(GL_SCISSOR_TEST);
    const double aspect = static_cast<double>(place->size.x() / place->size.y());
    const Frustum beside = lensFrustum(frame.fingers, job.settings.camera, aspect);
    renderer.draw(frame, look, beside, size.x(), size.y(), &whole);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, picture.width, picture.height);
  }

  /// Draws the body with the pixels of `picture`.
  void paintBody(const Job& job, Eye eye, const EyePicture& picture) {
    const bool hands = job.settings.look.finger == FingerShape::hand && !job.frame.fingers.empty();
    const double room_mm = hands ? kRoomForHandsMm : kRoomMm;
    const Frustum frustum = makeFrustum(job.eyes, eye, computeClipRange(job.eyes, with_support, room_mm));
    Frame frame = job.frame;
    frame.pixels_per_point = job.canvas.pixels_per_point * picture.width / job.picture.width;
    renderer.draw(frame, job.settings.look, frustum, picture.width, picture.height);
    paintLens(job, picture, frame, frustum);
  }

  void paintSmallerBody(const Job& job) {
    const Canvas& canvas = job.canvas;
    const auto part = [&](int pixels) {
      return std::max(1, static_cast<int>(std::lround(canvas.body_share * pixels)));
    };
    EyePicture picture = job.picture;
    picture.width = part(picture.width);
    picture.height = part(picture.height);
    if (!smaller || smaller->width() != picture.width || smaller->height() != picture.height) {
      smaller.emplace(picture.width, picture.height);
    }
    smaller->bind();
    paintBody(job, Eye::left, picture);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, smaller->framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas.framebuffer);
    glBlitFramebuffer(0, 0, picture.width, picture.height, 0, 0, canvas.width, canvas.height, GL_COLOR_BUFFER_BIT,
                      GL_LINEAR);
  }

  /// Labels and panels.
  void paintPage(const Job& job) {
    page.present(job.picture.width, job.picture.height, labelledPart(job.picture, job.canvas).corner,
                 wholePage(job.picture, job.canvas));
    if (job.draw_over) job.draw_over(job.picture);
  }

  void paintEyes(const Job& job) {
    const Canvas& canvas = job.canvas;
    if (isStereo(job.stereo.mode)) {
      for (const Eye eye : {Eye::left, Eye::right}) {
        if (!namesFor(job.settings.look).empty()) preparePage(job, job.eyes.of(eye));
        composer.eye(eye, job.picture).bind();
        paintBody(job, eye, job.picture);
        paintPage(job);
      }
      composer.compose(job.stereo, canvas.framebuffer, canvas.width, canvas.height, canvas.supersampling);
    } else {
      const bool smaller_body = canvas.body_share < 1.0;
      if (smaller_body) paintSmallerBody(job);
      glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
      glViewport(0, 0, canvas.width, canvas.height);
      if (!smaller_body) paintBody(job, Eye::left, job.picture);
      paintPage(job);
    }
  }
};

Painter::Painter(std::shared_ptr<const scene::World> world) : impl_(std::make_unique<Impl>(std::move(world))) {}
Painter::~Painter() = default;

Renderer& Painter::renderer() { return impl_->renderer; }

void Painter::setWorld(std::shared_ptr<const scene::World> world) {
  impl_->renderer.setWorld(world);
  impl_->forgetNames();
  impl_->pads.reset();
  impl_->cutter.reset();
  impl_->world = std::move(world);
  impl_->measure();
}

Painted Painter::paint(const Frame& frame, const deform::DeformedSurface& surface, const PictureSettings& settings,
                       const Canvas& canvas, const DrawOver& draw_over) {
  Job job{.frame = frame,
          .surface = surface,
          .settings = settings,
          .canvas = canvas,
          .draw_over = draw_over,
          .stereo = settings.stereo,
          .picture = {},
          .eyes = {}};
  const UsableMode usable = usableMode(job.stereo.mode, canvas.quad_buffer);
  job.stereo.mode = usable.mode;
  job.picture = eyePictureIn(usable.mode, canvas.width, canvas.height);
  const ComfortableStereo calm = comfortable(settings.camera, job.stereo, job.picture.aspect(), impl_->box);
  job.stereo = calm.settings;
  job.eyes = placeEyes(settings.camera, job.stereo, job.picture.aspect());
  impl_->readBeneath(job);
  impl_->preparePage(job, job.eyes.middle);
  impl_->paintEyes(job);
  Painted painted{job.eyes, usable.mode, {}};
  for (const std::string& note : {usable.note, calm.note}) {
    if (!note.empty()) painted.notes.push_back(note);
  }
  for (std::string& note : impl_->notesOn(settings.look)) painted.notes.push_back(std::move(note));
  return painted;
}

}  // namespace palpate::view
