# Who may include whom: the folders are the architecture, and this table is their law.
#   cmake -DROOT=<repository> -P tests/arch/check_includes.cmake
# Each folder may include itself and what is listed. Longest matching folder counts.
set(rules
  "lib/core:"
  "lib/exact:lib/core"
  "lib/store:lib/core"
  "lib/geometry:lib/core lib/exact lib/store"
  "lib/image:lib/core"
  "lib/check:lib/core lib/exact lib/geometry lib/grid lib/volume lib/voxel lib/closing"
  "lib/grid:lib/core lib/store"
  "lib/volume:lib/core lib/grid"
  "lib/voxel:lib/core lib/grid"
  "lib/closing:lib/core lib/grid"
  "lib/device:lib/core lib/grid lib/voxel lib/closing"
  "lib/device/cpu:lib/core lib/grid lib/voxel lib/closing lib/device"
  "lib/mesh:lib/core lib/exact lib/grid"
  "lib/atlas:lib/core lib/mesh"
  "lib/enclosed:lib/core lib/exact lib/grid lib/mesh"
  "lib/surface:lib/core lib/store lib/grid lib/volume lib/mesh"
  "lib/simplify:lib/core lib/mesh lib/enclosed lib/surface"
  "lib/tighten:lib/core lib/exact lib/mesh lib/enclosed lib/simplify lib/hulls"
  "lib/quads:lib/core lib/exact lib/mesh lib/enclosed lib/simplify lib/tighten"
  "lib/fit:lib/core lib/geometry lib/mesh lib/simplify"
  "lib/hulls:lib/core lib/exact lib/mesh"
  "lib/pass:lib/core lib/exact lib/store lib/geometry lib/grid lib/volume lib/voxel lib/closing lib/device lib/device/cpu lib/mesh lib/enclosed lib/surface lib/simplify lib/tighten lib/quads lib/fit lib/hulls lib/atlas"
  "lib/levels:lib/core lib/exact lib/store lib/geometry lib/grid lib/volume lib/closing lib/device lib/surface lib/pass lib/check"
  "io/files:lib/core"
  "io/store:lib io/files"
  "io/stream:lib io/files io/store"
  "io/scene:lib io/files io/stream io/image"
  "io/gltf:lib io/files io/scene"
  "io/mesh:lib io/files io/gltf"
  "io/tiles:lib io/files io/scene io/gltf"
  "io/image:lib/core lib/image io/files"
  "gpu:lib"
  "tools:lib io gpu"
  "samples:lib io tools/cli tools/run tools/notes"
  "tests:lib io gpu tools samples")
# Foreign headers and the only places that know them.
# Tests may ask them for a second opinion: the reference reader is written from the format document alone.
set(foreign
  "assimp/:^io/"
  "zstd:^(io|tests)/"
  "png.h:^(io|tests)/"
  "jpeglib.h:^io/image/"
  "webp/:^(io/image|tests)/"
  "freetype:^io/image/label_font\\.cpp$"
  "ft2build:^io/image/label_font\\.cpp$"
  "OpenMesh/:^tests/"
  "meshoptimizer:^(tests/bench/.*\\.cpp|io/gltf/meshopt_codec\\.cpp)$"
  "tbb/:^lib/core/parallel\\.(h|cpp)$"
  "oneapi/:^lib/core/parallel\\.(h|cpp)$"
  "cuda:^(gpu/|tests/)"
  "cub/:^gpu/"
  "catch2/:^tests/(catch\\.h|main\\.cpp)$")

set(errors 0)
function(complain text)
  message("${text}")
  math(EXPR n "${errors} + 1")
  set(errors ${n} PARENT_SCOPE)
endfunction()

set(checked 0)
foreach(folder lib io gpu tools samples tests)
  file(GLOB_RECURSE files RELATIVE ${ROOT} "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp" "${ROOT}/${folder}/*.cu"
       "${ROOT}/${folder}/*.cuh")
  foreach(file ${files})
    set(own "")
    foreach(rule ${rules})
      string(REGEX MATCH "^([^:]*):(.*)$" _ "${rule}")
      set(where "${CMAKE_MATCH_1}")
      set(what "${CMAKE_MATCH_2}")
      string(FIND "${file}" "${where}/" at)
      if(at EQUAL 0)
        set(own "${where}")
        string(REPLACE " " ";" allowed "${where} ${what}")
      endif()
    endforeach()
    if(own STREQUAL "")
      complain("${file}: its folder has no rule in tests/arch/check_includes.cmake")
      continue()
    endif()
    file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    foreach(line ${lines})
      math(EXPR checked "${checked} + 1")
      string(REGEX MATCH "include[ \t]*([<\"])([^>\"]*)[>\"]" _ "${line}")
      set(quote "${CMAKE_MATCH_1}")
      set(header "${CMAKE_MATCH_2}")
      if(quote STREQUAL "\"")
        if(header MATCHES "^gpu/" AND NOT IS_DIRECTORY "${ROOT}/gpu")
          continue()  # a copy without the GPU backend
        endif()
        if(NOT EXISTS "${ROOT}/${header}")
          complain("${file}: \"${header}\" is not a path from the root of the repository")
          continue()
        endif()
        set(found FALSE)
        foreach(where ${allowed})
          string(FIND "${header}" "${where}/" at)
          if(at EQUAL 0)
            set(found TRUE)
          endif()
        endforeach()
        if(NOT found)
          complain("${file}: must not include ${header}; ${own} may include ${allowed}")
        endif()
        if(header MATCHES "/detail/")
          string(REGEX REPLACE "/detail/.*" "" home "${header}")
          string(FIND "${file}" "${home}/" at)
          if(NOT at EQUAL 0 AND NOT file MATCHES "^tests/")
            complain("${file}: ${header} is private to ${home}")
          endif()
        endif()
      else()
        foreach(rule ${foreign})
          string(REGEX MATCH "^([^:]*):(.*)$" _ "${rule}")
          set(prefix "${CMAKE_MATCH_1}")
          set(where "${CMAKE_MATCH_2}")
          string(FIND "${header}" "${prefix}" at)
          if(at EQUAL 0 AND NOT file MATCHES "${where}")
            complain("${file}: must not include <${header}>; only files that match ${where} may")
          endif()
        endforeach()
      endif()
    endforeach()
  endforeach()
endforeach()
if(checked LESS 100)
  complain("only ${checked} includes were found under ${ROOT}; is it the repository?")
endif()
if(errors GREATER 0)
  message(FATAL_ERROR "${errors} includes break the rules")
endif()
message("${checked} includes follow the rules")
