// The forms of the deformation as bytes: part of contact_stream.h. One walk names every setting; one that is added to
// FormSettings and not here fails the test that looks at its size.
#include <fmt/format.h>

#include "palpate/base/byte_wire.h"
#include "palpate/base/error.h"
#include "palpate/engine/contact_stream.h"

namespace palpate::engine {

namespace {

constexpr std::string_view kFormsBegin = "PFM1";
static_assert(kFormsBegin.back() == kStreamVersion);

constexpr std::size_t kMaxTableSteps = 1'000'000;  // as tissue::ProfileCurve takes them
constexpr std::uint32_t kMaxKnots = 100'000;

template <class Wire, class Profile>
void walkProfile(Wire& wire, Profile& profile) {
  wire.word(profile.kind, tissue::ProfileKind::user);
  wire.word(profile.rim, tissue::ProfileRim::smooth);
  wire.count(profile.table_entries, std::size_t{2}, kMaxTableSteps);
  wire.word(profile.lookup, tissue::TableLookup::linear);
  wire.real(profile.two_gaussians.narrow);
  wire.real(profile.two_gaussians.wide);
  wire.real(profile.two_gaussians.wide_weight);
  wire.real(profile.power.width);
  wire.real(profile.power.exponent);
  wire.word(profile.interpolation, tissue::UserInterpolation::linear);
  auto knots = static_cast<std::uint32_t>(profile.knots.size());
  wire.count(knots, std::uint32_t{0}, kMaxKnots);
  if constexpr (Wire::kReads) profile.knots.resize(wire.has(std::uint64_t{16} * knots) ? knots : 0);
  for (auto& knot : profile.knots) {
    wire.real(knot.q);
    wire.real(knot.value);
  }
}

template <class Wire, class Common>
void walkCommon(Wire& wire, Common& common) {
  auto& tissue = common.tissue;
  for (auto* length : {&tissue.normal_cap_mm, &tissue.tangential_cap_mm, &tissue.f_adj, &tissue.normal_radius_mm,
                       &tissue.normal_radius_per_depth}) {
    wire.real(*length);
  }
  wire.word(common.normals, deform::Normals::incremental);
  wire.word(common.strain, true);
  wire.word(common.limit_shear, true);
  wire.count(common.max_contacts, std::size_t{0}, std::size_t{kMaxStreamedContacts});
}

template <class Wire, class Fidelity>
void walkFidelity(Wire& wire, Fidelity& fidelity) {
  for (int number = 1; number <= kErrata; ++number) {
    bool literal = fidelity.literal(erratumOf(number));
    wire.word(literal, true);
    if constexpr (Wire::kReads) fidelity.setLiteral(erratumOf(number), literal);
  }
}

template <class Wire, class Forms>
void walkForms(Wire& wire, Forms& forms) {
  wire.text(kFormsBegin);
  walkCommon(wire, forms.common);
  walkProfile(wire, forms.normal_profile);
  walkProfile(wire, forms.tangential_profile);
  wire.real(forms.radial.share);
  wire.real(forms.radial.width);
  wire.word(forms.search, deform::Search::octree);
  wire.word(forms.shape, deform::Shape::contour);
  wire.word(forms.region, deform::NormalRegion::scaled);
  wire.word(forms.boundary, deform::Boundary::two_mm);
  wire.word(forms.together, deform::Together::summed);
  wire.word(forms.strain_kind, deform::StrainKind::principal);
  walkFidelity(wire, forms.fidelity);
}

}  // namespace

std::string encodedForms(const deform::FormSettings& forms) {
  std::string bytes;
  WireWriter writer(bytes);
  walkForms(writer, forms);
  return bytes;
}

deform::FormSettings decodeForms(std::string_view bytes) {
  WireReader reader(bytes);
  deform::FormSettings forms;
  walkForms(reader, forms);
  reader.end();
  if (!reader.ok()) throw Error(fmt::format("forms: byte {}: {}", reader.position(), reader.cause()));
  return forms;
}

}  // namespace palpate::engine
