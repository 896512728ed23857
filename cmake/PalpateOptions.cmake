# Compiler settings shared by every target of this project, as an interface target that is never exported.
add_library(palpate_options INTERFACE)
# Bit-identical forces: a fused multiply-add rounds once instead of twice, which breaks both reproducibility and the exact
# predicates (docs/contact.md). Never -ffast-math, never -march=native in a released build.
target_compile_options(palpate_options INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
if(PALPATE_SANITIZE)
  target_compile_options(palpate_options INTERFACE -fsanitize=${PALPATE_SANITIZE} -fno-omit-frame-pointer
                                                   -fno-sanitize-recover=undefined)
  target_link_options(palpate_options INTERFACE -fsanitize=${PALPATE_SANITIZE})
endif()
