# Run by the build: writes OUTPUT, a C++ file that names the sources below ROOT which make built-in bodies by what is in them.
# A kept body (engine/host/palpate/scene/body_store.cpp) is used only by a program whose makers have the same name.
set(core ${ROOT}/core/palpate)
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${core}/base/* ${core}/mesh/* ${core}/body/* ${core}/scene/body_parts.* ${core}/scene/ready_body.*
     ${core}/scene/beneath/* ${core}/tissue/force_law.h ${core}/tissue/narrow_bone.h)
list(SORT sources)
set(contents)
foreach(source IN LISTS sources)
  file(SHA256 ${ROOT}/${source} content)
  string(APPEND contents "${source} ${content}\n")
endforeach()
string(SHA256 makers "${contents}")
# The compiler as well: all of them promise the same body, and each is to keep that promise by itself.
file(WRITE ${OUTPUT} "#include <Eigen/Core>
#include <string_view>

#define PALPATE_TEXT_OF(x) #x
#define PALPATE_TEXT(x) PALPATE_TEXT_OF(x)

namespace palpate::scene {

std::string_view bodyMakers();

std::string_view bodyMakers() {
  return \"${makers}, Eigen \" PALPATE_TEXT(EIGEN_WORLD_VERSION) \".\" PALPATE_TEXT(EIGEN_MAJOR_VERSION) \".\" PALPATE_TEXT(
      EIGEN_MINOR_VERSION)
#ifdef __VERSION__
      \", \" __VERSION__
#endif
#ifdef __OPTIMIZE__
      \", optimised\"
#endif
      ;
}

}  // namespace palpate::scene
")
