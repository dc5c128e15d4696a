# cmake -DPROGRAM=file -DARGUMENT=word -DCODE=n -P expect_exit.cmake
# Passes if the program ends with exactly this exit code, so that a crash does not pass.
execute_process(COMMAND "${PROGRAM}" ${ARGUMENT} RESULT_VARIABLE code)
if(NOT code STREQUAL CODE)
  message(FATAL_ERROR "exit ${code}, expected ${CODE}")
endif()
