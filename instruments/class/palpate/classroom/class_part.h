// A class over the network, as training asks for it (training/session/class_part.h).
#pragma once

#include "palpate/training/session/class_part.h"

namespace palpate::classroom {

training::ClassPart makeClassPart();

}  // namespace palpate::classroom
