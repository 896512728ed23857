# The two circles of tests (tests/circles.tsv), for CMake while it configures and for ctest before it runs.
# ctest knows no minimum version of CMake: no policy may be needed here, such as that of IN_LIST.

# palpate_read_circles(<file> <variable>): the names of what is in the second circle; `folder.*` is a whole program.
function(palpate_read_circles file variable)
  file(STRINGS ${file} rows ENCODING UTF-8)
  set(second)
  foreach(row IN LISTS rows)
    if(row MATCHES "^([^#\t]+)\tsecond\t")
      list(APPEND second "${CMAKE_MATCH_1}")
    endif()
  endforeach()
  set(${variable} "${second}" PARENT_SCOPE)
endfunction()

# palpate_is_in_second_circle(<folder.Suite> <names> <variable>)
function(palpate_is_in_second_circle suite names variable)
  string(REGEX REPLACE "[.].*$" ".*" program "${suite}")
  set(${variable} OFF PARENT_SCOPE)
  list(FIND names "${suite}" suite_at)
  list(FIND names "${program}" program_at)
  if(suite_at GREATER -1 OR program_at GREATER -1)
    set(${variable} ON PARENT_SCOPE)
  endif()
endfunction()
