# `./bootstrap package`: a Debian package of what `cmake --install` lays out, with man pages and completions.
find_program(HELP2MAN help2man)
find_program(PYTHON3 NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(TARGET wrinkle_cli AND HELP2MAN AND PYTHON3)
  set(pages ${CMAKE_CURRENT_BINARY_DIR}/pages)
  add_custom_target(
    wrinkle_pages
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
    COMMAND ${PYTHON3} ${CMAKE_CURRENT_LIST_DIR}/document.py $<TARGET_FILE:wrinkle_cli> ${pages}
    DEPENDS wrinkle_cli
    VERBATIM)
  install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL FILES_MATCHING PATTERN "*.1")
  install(FILES ${pages}/wrinkle.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME wrinkle
          OPTIONAL)
  install(FILES ${pages}/_wrinkle DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions OPTIONAL)
  install(FILES ${pages}/wrinkle.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d OPTIONAL)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the wrinkle project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bump mapping after the render, in OpenCL")
set(CPACK_PACKAGE_DESCRIPTION
    "Evaluates layers of bump mapping over the G-buffer of a finished frame: new normals, gradients, roughness and a lit picture. A program, a C++ library and OpenCL kernels."
)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ocl-icd-opencl-dev, opencl-clhpp-headers")
set(CPACK_STRIP_FILES ON)
include(CPack)
