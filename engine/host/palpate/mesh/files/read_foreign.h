// Mesh files of foreign formats. Programs call installHost (scene/host.h), which installs their reader too.
#pragma once

namespace palpate::mesh {

/// Not defined in a build without assimp.
void installForeignReader();

}  // namespace palpate::mesh
