# What `cmake --install` lays out: the library, the command, public headers, kernels and the CMake package, whose users
# need OpenCL and nothing else that the library was built with.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wrinkle)
set(kernel_dir ${CMAKE_INSTALL_DATADIR}/wrinkle/kernels)

# Until 1.0 a minor version may break the ABI.
set_target_properties(wrinkle PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION
                                                                    ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS wrinkle EXPORT wrinkle)
install(DIRECTORY wrinkle DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/
  DESTINATION ${kernel_dir}
  FILES_MATCHING
  PATTERN "*.cl"
  PATTERN "*.clh"
  PATTERN "*.h"
  PATTERN "*.json"
  PATTERN "README.md")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(TARGET wrinkle_cli)
  install(TARGETS wrinkle_cli)
endif()

install(EXPORT wrinkle NAMESPACE wrinkle:: DESTINATION ${package_dir} FILE wrinkleTargets.cmake)
configure_package_config_file(wrinkleConfig.cmake.in ${PROJECT_BINARY_DIR}/wrinkleConfig.cmake
                              INSTALL_DESTINATION ${package_dir} PATH_VARS kernel_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wrinkleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wrinkleConfig.cmake ${PROJECT_BINARY_DIR}/wrinkleConfigVersion.cmake
        DESTINATION ${package_dir})
