# Read by ctest before it runs, with `folder`, `program`, `list` and `where` set: each suite of a test program is one test of
# ctest, named <folder>.<Suite>. A process a suite and not one a test: what its tests share, a body or a window, is made once.
if("${program}" IS_NEWER_THAN "${list}")
  execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE lines RESULT_VARIABLE failed WORKING_DIRECTORY "${where}")
  if(failed)
    add_test("${folder}.CannotBeListed" "${program}" --gtest_list_tests) # fails as it did here, for all to see
    return()
  endif()
  string(REGEX REPLACE "#[^\n]*" "" lines "${lines}") # values of parameters
  string(REPLACE ";" "," lines "${lines}")
  string(REPLACE "\n" ";" lines "${lines}")
  set(suites)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+)\\. *$")
      set(suite "${CMAKE_MATCH_1}")
      list(APPEND suites "${suite}")
      set(tests_of_${suite} 0)
    elseif(line MATCHES "^  [^ ]")
      math(EXPR tests_of_${suite} "${tests_of_${suite}} + 1")
    endif()
  endforeach()
  set(text)
  foreach(suite IN LISTS suites)
    # Suites of many tests begin first, so that none is left over for one core in the end.
    string(APPEND text "add_test(\"${folder}.${suite}\" \"${program}\" --gtest_brief=1 \"--gtest_filter=${suite}.*\")\n"
                       "set_tests_properties(\"${folder}.${suite}\" PROPERTIES WORKING_DIRECTORY \"${where}\" COST ${tests_of_${suite}})\n")
  endforeach()
  file(WRITE "${list}" "${text}")
endif()
include("${list}")
