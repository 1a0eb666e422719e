# Distribution packages (Debian 12, Ubuntu 24.04); the scripts of samples/ and tests/ install them.
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(assimp REQUIRED)
find_package(pugixml REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(Freetype REQUIRED)
find_package(JPEG REQUIRED)
find_path(BP_STB_INCLUDE stb_image.h PATH_SUFFIXES stb REQUIRED)  # headers only

# zstd, xxHash, WebP and Draco ship pkg-config files everywhere, CMake packages only here and there.
find_package(PkgConfig REQUIRED)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(webp REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(draco REQUIRED IMPORTED_TARGET draco)

# bplod --crs needs it; without it that option is refused. 9.1 tells which operation it chose.
pkg_check_modules(proj IMPORTED_TARGET proj>=9.1)
set(BP_HAVE_PROJ ${proj_FOUND})
if(BP_HAVE_PROJ)
  message(STATUS "bplod --crs: PROJ ${proj_VERSION}")
else()
  message(STATUS "bplod --crs: skipped, for PROJ 9.1 was not found (libproj-dev)")
endif()

# bpview alone needs it. Debian's package has it as a library.
pkg_check_modules(httplib IMPORTED_TARGET cpp-httplib)
if(httplib_FOUND)
  message(STATUS "bpview: cpp-httplib ${httplib_VERSION}")
else()
  message(STATUS "bpview: skipped, for cpp-httplib was not found (libcpp-httplib-dev)")
endif()
find_program(BP_NPM npm)
find_program(BP_NODE node)

if(BP_TESTS)
  find_package(OpenMesh REQUIRED)  # a second opinion on meshes
  find_package(Catch2 REQUIRED)  # 2.13 (Debian 12) or 3 (Ubuntu 24.04); tests/catch.h hides the difference
endif()
