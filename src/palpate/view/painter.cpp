#include "palpate/view/painter.h"

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::view {

/// One picture on its way.
struct Painter::Job {
  const Frame& frame;
  const deform::DeformedSurface& surface;
  const PictureSettings& settings;
  const Canvas& canvas;
  const DrawOver& draw_over;
  StereoSettings stereo;
  EyePicture picture;
  Eyes eyes;
};

Painter::Painter(std::shared_ptr<const scene::World> world)
    : world_(std::move(world)), box_(mesh::boundingBox(world_->skin)), renderer_(world_) {}

Painted Painter::paint(const Frame& frame, const deform::DeformedSurface& surface, const PictureSettings& settings,
                       const Canvas& canvas, const DrawOver& draw_over) {
  Painted painted;
  Job job{frame, surface, settings, canvas, draw_over, settings.stereo, {}, {}};
  const UsableMode usable = usableMode(job.stereo.mode, canvas.quad_buffer);
  job.stereo.mode = usable.mode;
  job.picture = eyePictureIn(usable.mode, canvas.width, canvas.height);
  const ComfortableStereo calm = comfortable(settings.camera, job.stereo, job.picture.aspect(), box_);
  job.stereo = calm.settings;
  job.eyes = eyesOf(settings.camera, job.stereo, job.picture.aspect());
  for (const std::string& note : {usable.note, calm.note}) {
    if (!note.empty()) painted.notes.push_back(note);
  }
  preparePage(job);
  if (isStereo(usable.mode)) {
    for (const Eye eye : {Eye::left, Eye::right}) {
      composer_.eye(eye, job.picture).bind();
      paintEye(job, eye);
    }
    composer_.compose(job.stereo, canvas.framebuffer, canvas.width, canvas.height, canvas.supersampling);
  } else {
    glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
    glViewport(0, 0, canvas.width, canvas.height);
    paintEye(job, Eye::left);
  }
  painted.eyes = job.eyes;
  painted.mode = usable.mode;
  return painted;
}

void Painter::preparePage(const Job& job) {
  const double scale = job.canvas.pixels_per_point;
  page_.begin(Vec2f(job.picture.seen_width, job.picture.seen_height) / static_cast<float>(scale), scale);
  drawLabels(page_, {*world_, job.surface, job.frame, job.settings.look, job.settings.camera, job.eyes},
             job.settings.labels);
  page_.end();
}

void Painter::paintEye(const Job& job, Eye eye) {
  const Frustum frustum = frustumOf(job.eyes, eye, depthRangeOf(job.eyes, box_));
  Frame frame = job.frame;
  frame.pixels_per_point = job.canvas.pixels_per_point;
  renderer_.draw(frame, job.settings.look, frustum, job.picture.width, job.picture.height);
  page_.present(job.picture.width, job.picture.height);
  if (job.draw_over) job.draw_over(job.picture);
}

}  // namespace palpate::view
