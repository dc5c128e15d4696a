# assay_add_plugin(NAME SOURCE...) makes the shared library NAME.so with one symbol: a detector that
# `assay --detector` loads. No library of Assay is linked to it. It needs only the headers of the plug-in
# interface from the installed package, so find_package(assay COMPONENTS plugin) is enough.
function(assay_add_plugin name)
  if(NOT ARGN)
    message(FATAL_ERROR "assay_add_plugin(${name}): no sources are given")
  endif()
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES PREFIX ""
    C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(CXX IN_LIST languages)
    target_compile_features(${name} PRIVATE cxx_std_17)
  endif()
  target_link_libraries(${name} PRIVATE assay::plugin)
endfunction()
