# Writes OUT, a header with the commit of SOURCE. A header that has this commit already is not
# changed.
execute_process(COMMAND git rev-parse HEAD WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
execute_process(COMMAND git diff --quiet HEAD WORKING_DIRECTORY ${SOURCE}
  RESULT_VARIABLE changed OUTPUT_QUIET ERROR_QUIET)
if(commit AND NOT changed EQUAL 0)
  string(APPEND commit "-dirty")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define ASSAY_COMMIT \"${commit}\"\n")
