# Warnings are errors for our own targets only, and the root is the one include path.
function(poselift_configure target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-qual -Wformat=2
    -Wno-missing-field-initializers -Werror)
endfunction()

function(poselift_library name)
  add_library(poselift_${name} STATIC ${ARGN})
  add_library(poselift::${name} ALIAS poselift_${name})
  set_target_properties(poselift_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(poselift_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/poselift>)
  target_compile_features(poselift_${name} PUBLIC cxx_std_20)
  poselift_configure(poselift_${name})
endfunction()
