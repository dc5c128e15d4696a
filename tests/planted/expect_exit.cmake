# cmake -DPROGRAM=file -DARGUMENT=word -DCODE=n -P expect_exit.cmake
# Passes when the program ends with that very exit code: a crash is no finding.
execute_process(COMMAND "${PROGRAM}" ${ARGUMENT} RESULT_VARIABLE code)
if(NOT code STREQUAL CODE)
  message(FATAL_ERROR "exit ${code}, expected ${CODE}")
endif()
