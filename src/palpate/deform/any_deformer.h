// The name of Deformer from before it did every form.
#pragma once

#include "palpate/deform/deformer.h"

namespace palpate::deform {

using AnyDeformer = Deformer;

}  // namespace palpate::deform
