# Installs the library, its headers and package files, the program, its man page and completions.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# 0.x releases may break the binary interface at each minor version.
set_target_properties(morsel PROPERTIES VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS morsel EXPORT morselTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/morsel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")

# The program finds the library wherever the whole tree is put.
if(TARGET morsel_cli)
  file(RELATIVE_PATH lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(morsel_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${lib_from_bin}")
  install(TARGETS morsel_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/morsel)
install(EXPORT morselTargets NAMESPACE morsel:: DESTINATION ${package_dir})
configure_package_config_file(cmake/morselConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/morselConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/morselConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/morselConfig.cmake
        ${PROJECT_BINARY_DIR}/morselConfigVersion.cmake DESTINATION ${package_dir})

# morsel_install_if_present(DESTINATION FILE [RENAME NAME]): FILE relative to the project.
function(morsel_install_if_present destination file)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${file})
    install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${destination} ${ARGN})
  endif()
endfunction()
foreach(document LICENSE README.md CHANGELOG.md CITATION.cff docs/copyright)
  morsel_install_if_present(${CMAKE_INSTALL_DOCDIR} ${document})
endforeach()
morsel_install_if_present(${CMAKE_INSTALL_MANDIR}/man1 docs/man/morsel.1)
morsel_install_if_present(${CMAKE_INSTALL_DATADIR}/bash-completion/completions
                          completions/morsel.bash RENAME morsel)
morsel_install_if_present(${CMAKE_INSTALL_DATADIR}/zsh/site-functions completions/_morsel)
morsel_install_if_present(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
                          completions/morsel.fish)
