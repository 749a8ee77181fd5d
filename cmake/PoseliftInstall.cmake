# cmake --install: the program, the libraries with their headers, the package
# files, the default models. tests/consumer proves the result.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The umbrella: everything a program links.
add_library(poselift_all INTERFACE)
add_library(poselift::poselift ALIAS poselift_all)
set_target_properties(poselift_all PROPERTIES EXPORT_NAME poselift)
target_link_libraries(poselift_all INTERFACE poselift::src poselift::calib poselift::lift)

install(TARGETS poselift_src poselift_calib poselift_lift poselift_all EXPORT poseliftTargets)
install(TARGETS poselift)
install(DIRECTORY src calib lift DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/poselift
  FILES_MATCHING PATTERN "*.h" PATTERN "eval" EXCLUDE PATTERN "testing" EXCLUDE)
if(TARGET poselift-label)
  install(TARGETS poselift-label)
  install(FILES samples/photo/kick.jpg DESTINATION ${CMAKE_INSTALL_DATADIR}/poselift/samples)
endif()
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/poselift OPTIONAL
  FILES_MATCHING PATTERN "*.pldict" PATTERN "*.plmotion")
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/poselift)
install(EXPORT poseliftTargets NAMESPACE poselift:: DESTINATION ${package_dir})
configure_package_config_file(cmake/poseliftConfig.cmake.in
  ${PROJECT_BINARY_DIR}/poseliftConfig.cmake INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/poseliftConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/poseliftConfig.cmake
  ${PROJECT_BINARY_DIR}/poseliftConfigVersion.cmake cmake/FindOpenCV.cmake
  DESTINATION ${package_dir})
