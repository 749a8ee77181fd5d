# OpenCV by component. Debian keeps OpenCVConfig.cmake in libopencv-dev, which
# drags Qt and VTK; the component packages (libopencv-core-dev, ...) hold
# headers and libraries alone. Defines the targets opencv_<component>.
find_path(OpenCV_INCLUDE_DIR opencv2/core/version.hpp PATH_SUFFIXES opencv4)
if(OpenCV_INCLUDE_DIR)
  file(STRINGS ${OpenCV_INCLUDE_DIR}/opencv2/core/version.hpp version_lines
    REGEX "#define CV_VERSION_(MAJOR|MINOR|REVISION)")
  list(TRANSFORM version_lines REPLACE "[^0-9]+" "")
  list(JOIN version_lines "." OpenCV_VERSION)
endif()
foreach(component ${OpenCV_FIND_COMPONENTS})
  find_library(OpenCV_${component}_LIBRARY opencv_${component})
  if(OpenCV_${component}_LIBRARY)
    set(OpenCV_${component}_FOUND TRUE)
    if(NOT TARGET opencv_${component})
      add_library(opencv_${component} UNKNOWN IMPORTED)
      set_target_properties(opencv_${component} PROPERTIES
        IMPORTED_LOCATION ${OpenCV_${component}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR})
    endif()
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR
  VERSION_VAR OpenCV_VERSION HANDLE_COMPONENTS)
