# palpate.h as it was and as it will be: made from the one that is, so that they follow it.
#   cmake -DHEADER=palpate.h -DOUT=folder -P versions.cmake     writes folder/shorter/palpate.h, folder/longer/palpate.h
file(READ ${HEADER} now)
set(shorter "${now}")
set(longer "${now}")

# Bodies are taken as bracketed text: semicolons are CMake's separator.
function(change text from to)
  string(FIND "${${text}}" "${from}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "palpate.h has no '${from}': engine/bindings/c/tests/versions.cmake must follow it")
  endif()
  string(REPLACE "${from}" "${to}" changed "${${text}}")
  set(${text} "${changed}" PARENT_SCOPE)
endfunction()

# Takes everything from the structure's own `first` up to its end.
function(cut text first end)
  string(FIND "${${text}}" "${end}" to)
  string(SUBSTRING "${${text}}" 0 ${to} until)
  string(FIND "${until}" "${first}" from REVERSE)
  if(to EQUAL -1 OR from EQUAL -1)
    message(FATAL_ERROR "palpate.h has no '${first}' before '${end}': engine/bindings/c/tests/versions.cmake must follow it")
  endif()
  string(SUBSTRING "${${text}}" 0 ${from} before)
  string(SUBSTRING "${${text}}" ${to} -1 after)
  set(${text} "${before}${after}" PARENT_SCOPE)
endfunction()

cut(shorter "  double tissue_mm;" "} palpate_touch;")
cut(shorter "  int32_t force_shading;" "} palpate_finger_settings;")
change(shorter "char message[512];" "char message[64];")
cut(shorter "  const char* scene_toml;" "} palpate_arrays;")

change(longer "} palpate_touch;" "  double added[40];\n} palpate_touch;\n#define PALPATE_TEST_HAS_MORE_TOUCH")
change(longer "} palpate_finger_settings;" "  double added[2];\n} palpate_finger_settings;\n#define PALPATE_TEST_HAS_MORE_SETTINGS")
change(longer "} palpate_error;" "  int64_t added;\n} palpate_error;")
change(longer "} palpate_arrays;" "  const void* added;\n} palpate_arrays;")

file(WRITE ${OUT}/shorter/palpate.h "${shorter}")
file(WRITE ${OUT}/longer/palpate.h "${longer}")
