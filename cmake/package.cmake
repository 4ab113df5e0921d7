# `cpack` makes a Debian package of what `cmake --install` installs; `make package` calls it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The morsel developers <morsel@localhost>")
set(CPACK_PACKAGE_DESCRIPTION
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
