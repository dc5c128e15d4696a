# cmake -DFAULT=file -DROOT=folder -DOUTPUT=file -P plant.cmake
# Copies the source file that the fault names, with the line `-` of the fault replaced by its line
# `+`. Fails unless the source has that line exactly once: the fault must then be adapted.
file(READ "${FAULT}" fault)

# Reads the next line of the fault, which has to start with `beginning`; `variable` gets the rest.
function(take_line beginning variable)
  string(FIND "${fault}" "${beginning}" begin)
  string(FIND "${fault}" "\n" end)
  if(NOT begin EQUAL 0 OR end LESS 0)
    message(FATAL_ERROR "${FAULT}: a line `${beginning}...` was expected")
  endif()
  string(LENGTH "${beginning}" begin)
  math(EXPR length "${end} - ${begin}")
  math(EXPR next "${end} + 1")
  string(SUBSTRING "${fault}" ${begin} ${length} line)
  string(SUBSTRING "${fault}" ${next} -1 rest)
  set(${variable} "${line}" PARENT_SCOPE)
  set(fault "${rest}" PARENT_SCOPE)
endfunction()

take_line("about: " about)
take_line("file: " name)
take_line("-" right)
take_line("+" wrong)

file(READ "${ROOT}/${name}" source)
string(FIND "${source}" "\n${right}\n" first)
string(FIND "${source}" "\n${right}\n" last REVERSE)
if(first LESS 0 OR NOT first EQUAL last)
  message(FATAL_ERROR "${FAULT}: not exactly once in ${name}: ${right}")
endif()
string(SUBSTRING "${source}" 0 ${first} before)
string(LENGTH "\n${right}\n" length)
math(EXPR next "${first} + ${length}")
string(SUBSTRING "${source}" ${next} -1 after)
file(WRITE "${OUTPUT}" "${before}\n${wrong}\n${after}")
