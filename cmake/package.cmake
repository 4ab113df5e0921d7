# `cpack` makes a Debian package of what `cmake --install` installs, and where the Python package is
# built one of that; `make package` calls it.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL Unspecified)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME morsel)
if(TARGET morsel_python)
  list(APPEND CPACK_COMPONENTS_ALL dist_packages)
  set(CPACK_DEBIAN_DIST_PACKAGES_PACKAGE_NAME python3-morsel)
  set(CPACK_DEBIAN_DIST_PACKAGES_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_DIST_PACKAGES_DESCRIPTION
      "morsel for Python takes the point cloud of a solid object as a NumPy array and says which points
belong to which part. It keeps shapes in a database, finds those that look alike, and shows parts in
Jupyter. The package holds the library: it does not need the package morsel, nor mind its version.")
  # The module is for one minor version of Python.
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_DIST_PACKAGES_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}~), \
python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_DIST_PACKAGES_PACKAGE_CONTROL_EXTRA
      ${CMAKE_CURRENT_LIST_DIR}/python3-morsel/postinst
      ${CMAKE_CURRENT_LIST_DIR}/python3-morsel/prerm)
  set(CPACK_DEBIAN_DIST_PACKAGES_PACKAGE_CONTROL_STRICT_PERMISSION ON)
endif()
set(CPACK_PACKAGE_CONTACT "The morsel developers <morsel@localhost>")
set(CPACK_COMPONENT_UNSPECIFIED_DESCRIPTION
    "morsel takes the point cloud of a solid object, noisy or clean, and says which points belong to
which part. It keeps shapes in a database, finds those that look alike, and shows parts and
look-alikes in the browser. The package has the program, its viewer, the library and its headers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# A file system where nobody else may read would give such folders to the package.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
