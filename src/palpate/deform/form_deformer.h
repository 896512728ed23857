// The deformation in every form of the dissertation: contacts in, deformed skin out, as Deformer does it in one form.
//
//   contacts ─ check, cap ─► frames ─ ring search ─► regions ─ couple ─► amplitudes ─ vertex by vertex ─► surface
//
// The general and slow one: scalar, in double, some 20 times the time of Deformer's kernels (docs/deformation.md), and
// still far below a frame for a fingertip. With default forms both give the same surface within 1e-4 mm.
// Based on: Ji, dissertation 2008, chapter 4.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpate/deform/form_frame.h"
#include "palpate/deform/normals.h"
#include "palpate/deform/ring_search.h"

namespace palpate::deform {

class FormDeformer {
 public:
  /// Allocates everything that apply needs. The skin must outlive the deformer. Throws Error for a profile that is none
  /// (ProfileCurve).
  explicit FormDeformer(const Skin& skin, const FormSettings& forms = {});
  FormDeformer(const Skin&& skin, const FormSettings& forms = {}) = delete;

  /// As Deformer::apply. Contacts carry their regions: formedRegions (forms.h) makes those of these forms.
  Report apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept;

  /// Triangles whose normals the last apply computed again; 0 unless Normals::incremental.
  Index changedTriangles() const noexcept { return changed_triangles_; }

 private:
  /// A contact's region in one block.
  struct Part {
    Index block;
    Index contact;
    std::uint64_t vertices;
  };

  void frameContacts(std::span<const Contact> contacts, Report& report) noexcept;
  void findRegions(Report& report) noexcept;
  void noteCoupling(std::size_t source) noexcept;
  double pressShare(const FormFrame& at, const FormFrame& from) const noexcept;
  double dragShare(const FormFrame& at, const FormFrame& from) const noexcept;
  void combine() noexcept;
  void solveTogether() noexcept;
  void collectBlocks() noexcept;
  void displace(DeformedSurface& surface, Report& report) noexcept;
  Index displaceBlock(std::span<const Part> parts, DeformedSurface& surface) noexcept;
  void displaceVertex(Index vertex, std::span<const Part> parts, DeformedSurface& surface) noexcept;
  void trackChanges(const DeformedSurface& surface) noexcept;
  void finishNormals(DeformedSurface& surface) noexcept;
  void finishStrain(DeformedSurface& surface) noexcept;
  template <class Visit>
  void forEachAffectedVertex(const Visit& visit) const;

  const Skin& skin_;
  FormSettings forms_;
  FormCurves curves_;
  RingSearch search_;
  std::optional<IncrementalNormals> incremental_;
  Index changed_triangles_ = 0;
  std::vector<FormFrame> frames_;
  std::vector<Part> parts_;  // after collectBlocks by block, then by contact
  std::vector<double> press_coupling_, drag_coupling_;
  std::vector<double> depths_, amplitudes_;
  std::vector<Vec3> drags_, shifts_;
  BlockSet moved_;     // blocks with vertices of a region
  BlockSet affected_;  // these, and with normals or strain from neighbours the blocks next to them
  BlockSet tracked_;   // blocks moved in the last apply: what incremental normals must bring back
};

}  // namespace palpate::deform
