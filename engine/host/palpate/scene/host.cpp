#include "palpate/scene/host.h"

#include "palpate/base/host_environment.h"
#include "palpate/mesh/files/read_foreign.h"
#include "palpate/scene/detail/user_stores.h"

namespace palpate {

void installHost() {
  [[maybe_unused]] static const bool installed = [] {
    installHostEnvironment();
#ifdef PALPATE_ASSIMP
    mesh::installForeignReader();
#endif
    scene::setBodyStore(scene::userBodyStore());
    scene::setLumpStore(scene::userLumpStore());
    return true;
  }();
}

}  // namespace palpate
