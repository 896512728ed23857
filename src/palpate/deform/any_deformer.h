// One deformer for any forms: the fast one where it can do what is asked for, the general one otherwise.
#pragma once

#include <variant>

#include "palpate/deform/form_deformer.h"

namespace palpate::deform {

class AnyDeformer {
 public:
  /// Chosen by needsForms. The skin must outlive it. Throws Error for a profile that is none.
  AnyDeformer(const Skin& skin, const FormSettings& forms) : deformer_(chosen(skin, forms)) {}
  AnyDeformer(const Skin&& skin, const FormSettings& forms) = delete;

  /// As Deformer::apply.
  Report apply(std::span<const Contact> contacts, DeformedSurface& surface) noexcept {
    if (auto* fast = std::get_if<Deformer>(&deformer_)) return fast->apply(contacts, surface);
    return std::get_if<FormDeformer>(&deformer_)->apply(contacts, surface);
  }

  /// True if it is the fast one.
  bool isFast() const noexcept { return std::holds_alternative<Deformer>(deformer_); }

 private:
  using Choice = std::variant<Deformer, FormDeformer>;
  static Choice chosen(const Skin& skin, const FormSettings& forms) {
    if (needsForms(forms)) return Choice(std::in_place_type<FormDeformer>, skin, forms);
    return Choice(std::in_place_type<Deformer>, skin, forms.common);
  }

  Choice deformer_;
};

}  // namespace palpate::deform
