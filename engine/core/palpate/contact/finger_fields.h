// The numbers of FingerSettings, in the order and by the names of the interfaces for C and Python.
#pragma once

#include <array>

#include "palpate/base/fields.h"
#include "palpate/contact/finger_state.h"

namespace palpate::contact {

namespace detail {
template <auto... Path>
constexpr Field<FingerSettings> fingerField(std::string_view name, NumberRange range = {}) {
  return field<FingerSettings, Path...>(name, range);
}
}  // namespace detail

/// Ranges are those of the scene file's keys, so that no digits are lost and no fault is multiplied; what numbers must
/// be to each other, and those of relaxation, check() says.
inline constexpr std::array kFingerFields = {
    detail::fingerField<&FingerSettings::radius_mm>("radius_mm", {0.0, 1000.0}),
    detail::fingerField<&FingerSettings::stiffness_ratio>("stiffness_ratio", {0.0, 100.0}),
    detail::fingerField<&FingerSettings::mu_static>("mu_static", {0.0, 5.0}),
    detail::fingerField<&FingerSettings::mu_dynamic>("mu_dynamic", {0.0, 5.0}),
    detail::fingerField<&FingerSettings::max_depth_mm>("max_depth_mm", {0.0, 1e5, true}),
    detail::fingerField<&FingerSettings::tick_s>("tick_s", {1e-6, 1.0}),
    detail::fingerField<&FingerSettings::catch_up_mm_per_s>("catch_up_mm_per_s", {0.0, 1e6}),
    detail::fingerField<&FingerSettings::relaxation, &Relaxation::share>("relaxation_share"),
    detail::fingerField<&FingerSettings::relaxation, &Relaxation::time_s>("relaxation_time_s"),
    detail::fingerField<&FingerSettings::relaxation, &Relaxation::share_2>("relaxation_share_2"),
    detail::fingerField<&FingerSettings::relaxation, &Relaxation::time_2_s>("relaxation_time_2_s"),
    detail::fingerField<&FingerSettings::force_shading>("force_shading"),
};

}  // namespace palpate::contact
