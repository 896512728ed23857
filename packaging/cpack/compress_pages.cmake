# Run by CPack between installing and packing: Debian's man pages are compressed.
file(GLOB_RECURSE files ${CPACK_TEMPORARY_DIRECTORY}/*.1)
foreach(page ${files})
  if(page MATCHES "/man/man1/[^/]*$")
    execute_process(COMMAND gzip -9n ${page} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
