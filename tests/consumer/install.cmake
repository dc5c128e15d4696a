# cmake -DBUILD=folder -DPREFIX=folder -P install.cmake
# Installs the detector into an empty folder: nothing of an earlier build is found there.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}
                COMMAND_ERROR_IS_FATAL ANY)
