# Debian packages: `cpack` in a build folder makes one of each component of `cmake --install`. .ci/packages makes them, and tries
# them in a fresh Debian. A build that is configured for the prefix /usr has the folders of Debian.
set(BP_PACKAGER "Maintainers of bounding proxies <maintainers@bounding-proxies.invalid>" CACHE STRING "Who publishes packages, with an address")
set(BP_HOMEPAGE "" CACHE STRING "Where users find the project: a URL, for the packages")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME bounding-proxies)
set(CPACK_PACKAGE_CONTACT "${BP_PACKAGER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL tools lib dev python doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${BP_HOMEPAGE}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(bp_deb_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(bp_debian ${PROJECT_BINARY_DIR}/debian)

# Debian's form of the changelog, and who holds rights in what the programs contain.
find_package(Python3 COMPONENTS Interpreter)
set(bp_changelog ${bp_debian}/changelog.Debian)
add_custom_command(
  OUTPUT ${bp_changelog}.gz
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/debian/changelog.py ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${bp_deb_version} ${BP_PACKAGER} > ${bp_changelog}
  COMMAND gzip -9nf ${bp_changelog}
  DEPENDS ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/cmake/debian/changelog.py
  VERBATIM)
add_custom_target(bp_debian_changelog ALL DEPENDS ${bp_changelog}.gz)
file(READ ${PROJECT_SOURCE_DIR}/cmake/debian/copyright bp_copyright)
if(BP_HAVE_CUDA)
  file(READ ${PROJECT_SOURCE_DIR}/cmake/debian/copyright.cuda bp_copyright_cuda)
  string(APPEND bp_copyright "\n${bp_copyright_cuda}")
endif()
file(GENERATE OUTPUT ${bp_debian}/copyright CONTENT "${bp_copyright}")

# bp_package(component package section summary text): the texts of a package, and the files that Debian asks for. The latter lie in
# packages only.
macro(bp_package component package section summary text)
  string(TOUPPER ${component} bp_upper)
  set(CPACK_DEBIAN_${bp_upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${bp_upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${bp_upper}_DESCRIPTION "${summary}\n${text}")
  install(FILES ${bp_changelog}.gz ${bp_debian}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  set(bp_overrides ${PROJECT_SOURCE_DIR}/cmake/debian/${package}.lintian-overrides)
  if(EXISTS ${bp_overrides})
    install(FILES ${bp_overrides} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${package} COMPONENT ${component}
            EXCLUDE_FROM_ALL)
  endif()
endmacro()
set(bp_about "A proxy is watertight, encloses its scene, and has few faces. It serves as
body for collisions, as occluder, as cage, or as level of detail.

This package has")
bp_package(tools bounding-proxies graphics "coarse meshes that strictly enclose huge 3D scenes" "${bp_about} the tools: bplod, bpvox, bpscale, bpclose, bpmesh,
bpcheck, bpinfo, bpdeform and, in the browser, bpview.")
bp_package(lib libbp0 libs "bounding proxies of 3D scenes: C library" "${bp_about} the library.")
bp_package(dev libbp-dev libdevel "bounding proxies of 3D scenes: headers" "${bp_about} the headers for C and C++, and files for pkg-config
and CMake.")
bp_package(python python3-bounding-proxies python "bounding proxies of 3D scenes: Python module" "${bp_about} the module bounding_proxies, for NumPy arrays, files,
and the meshes of trimesh, Open3D and meshio.")
bp_package(doc bounding-proxies-doc doc "coarse meshes that enclose huge 3D scenes: guides" "${bp_about} guides, definitions, formats, and samples.")

# What they need. Dependencies of programs follow from the libraries that these load.
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "fonts-dejavu-core")  # labels of pictures
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "bounding-proxies-doc, python3-bounding-proxies, xdg-utils")
set(CPACK_DEBIAN_LIB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIB_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # who links libbp needs this version of it, or a later one
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libbp0 (= ${bp_deb_version})")
# The module calls experimental functions by their names, so it goes with the library of its minor version only.
math(EXPR bp_next_minor "${PROJECT_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "libbp0 (>= ${PROJECT_VERSION}), libbp0 (<< ${PROJECT_VERSION_MAJOR}.${bp_next_minor}~), python3:any (>= 3.9~), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
include(CPack)
