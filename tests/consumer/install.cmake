# cmake -DBUILD=folder -DPREFIX=folder -P install.cmake
# Installs the detector into an empty folder, in which there is nothing of an earlier build.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}
                COMMAND_ERROR_IS_FATAL ANY)
