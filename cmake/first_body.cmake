# Run by the build: PALPATE, a program, makes the default body and keeps it in SHARE, for every first run
# (engine/host/palpate/scene/body_store.cpp). WORK is for what it writes besides. Without it, a first run takes a second longer.
file(REMOVE_RECURSE ${SHARE}/palpate/bodies)
set(ENV{XDG_CACHE_HOME} ${SHARE})
unset(ENV{PALPATE_BODY_CACHE_MB})
execute_process(COMMAND ${PALPATE} simulate --seconds 0.001 --no-pictures --no-plot --overwrite --out ${WORK}
                OUTPUT_QUIET ERROR_VARIABLE words RESULT_VARIABLE failed)
if(failed)
  message(WARNING "the default body was not made: ${words}")
endif()
file(TOUCH ${WORK}.made)
