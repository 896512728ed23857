// Where the commands of training find a class over the network.
#pragma once

#include "palpate/training/session/class_part.h"

namespace palpate::app {

/// By a program that has the network, before any command runs.
void installClassPart(const training::ClassPart& part);

/// The installed part. Without one, this process becomes the program of `palpate class`, which continues with the words
/// that were typed. Throws Error naming the missing package.
const training::ClassPart& classPart();

}  // namespace palpate::app
