# Who may include whom: the folders are the architecture, and this table is their law.
#   cmake -DROOT=<repository> -P tests/arch/check_includes.cmake
cmake_policy(SET CMP0054 NEW)
cmake_policy(SET CMP0057 NEW)
# Each room may include itself and the rooms that are listed; TREE/* is every room below. A file belongs to the longest
# room that matches. A permission that nobody uses is an error, too.
set(rules
  "lib/core:"
  "lib/exact:lib/core"
  "lib/store:"
  "lib/image:lib/core"
  "lib/geometry:lib/core lib/exact lib/store"
  "lib/deform:lib/core lib/geometry"
  "lib/grid:lib/core lib/store"
  "lib/volume:lib/core lib/grid lib/closing"
  "lib/voxel:lib/core lib/grid"
  "lib/closing:lib/core lib/grid"
  "lib/place:lib/core"
  "lib/tileset:lib/core lib/grid lib/volume lib/place"
  "lib/check:lib/core lib/exact lib/geometry lib/grid lib/volume lib/voxel lib/closing lib/tileset"
  "lib/device:lib/core lib/deform lib/grid lib/closing"
  "lib/device/cpu:lib/closing lib/device"
  "lib/mesh:lib/core lib/exact lib/grid"
  "lib/atlas:lib/core lib/mesh"
  "lib/enclosed:lib/core lib/exact lib/geometry lib/grid lib/volume lib/mesh"
  "lib/surface:lib/core lib/store lib/grid lib/volume lib/mesh"
  "lib/simplify:lib/core lib/geometry lib/mesh lib/enclosed lib/surface"
  "lib/hulls:lib/core lib/exact lib/geometry lib/mesh"
  "lib/tighten:lib/core lib/exact lib/mesh lib/enclosed lib/simplify lib/hulls"
  "lib/quads:lib/core lib/exact lib/grid lib/mesh lib/enclosed lib/surface lib/simplify lib/tighten"
  "lib/fit:lib/core lib/geometry lib/mesh lib/enclosed lib/simplify"
  "lib/pass:lib/core lib/store lib/grid lib/surface"
  "lib/pass/voxelize:lib/core lib/store lib/grid lib/volume lib/voxel lib/pass"
  "lib/pass/close:lib/core lib/grid lib/volume lib/device lib/pass"
  "lib/pass/mesh:lib/core lib/exact lib/store lib/geometry lib/grid lib/volume lib/voxel lib/device lib/mesh lib/enclosed lib/surface lib/simplify lib/hulls lib/tighten lib/quads lib/fit lib/pass lib/pass/voxelize"
  "lib/pass/color:lib/core lib/store lib/grid lib/volume lib/voxel lib/mesh lib/pass"
  "lib/pass/bake:lib/core lib/store lib/geometry lib/mesh lib/atlas lib/image"
  "lib/pass/leaf:lib/core lib/image lib/geometry lib/mesh lib/tileset lib/pass/bake"
  "lib/pass/hide:lib/core lib/grid lib/volume lib/pass/close lib/pass/mesh"
  "lib/pass/measure:lib/core lib/geometry lib/grid lib/volume lib/pass"
  "lib/live:lib/core lib/geometry lib/grid lib/volume lib/device lib/pass/close lib/pass/measure"
  "lib/levels:lib/core lib/store lib/geometry lib/grid lib/volume lib/closing lib/device lib/mesh lib/enclosed lib/simplify lib/surface lib/hulls lib/quads lib/pass lib/pass/voxelize lib/pass/close lib/pass/measure lib/pass/mesh lib/pass/color lib/pass/hide"
  "io/files:lib/core"
  "io/store:lib/core lib/store lib/grid io/files"
  "io/stream:lib/core lib/store lib/grid io/files io/store"
  "io/scene:lib/core lib/exact lib/place io/files io/stream io/image"
  "io/gltf:lib/core lib/grid io/files io/scene"
  "io/deform:lib/core lib/store lib/deform io/files io/store io/stream"
  "io/mesh:lib/core lib/mesh lib/atlas lib/quads lib/pass/leaf io/files io/gltf"
  "io/place:lib/core lib/place io/scene"
  "io/tiles:lib/core lib/grid lib/tileset io/files io/scene io/gltf"
  "io/image:lib/core lib/image io/files"
  "gpu:lib/deform lib/grid lib/closing lib/device"
  "tools/cli:lib/* io/files io/scene"
  "tools/run:lib/* io/files io/scene io/mesh gpu tools/cli"
  "tools/cli/options:lib/* tools/cli tools/run"
  "tools/notes:lib/* io/files io/scene tools/cli"
  "tools/pipe:lib/* io/* tools/cli tools/cli/options tools/run tools/notes"
  "tools/api:lib/* io/* tools/cli tools/cli/options tools/run tools/notes tools/mesh tools/pipe tools/lod"
  "tools/place:lib/* io/* tools/cli"
  "tools/check:lib/* io/* tools/cli tools/cli/options tools/run tools/place"
  "tools/deform:lib/* io/* tools/cli tools/run"
  "tools/info:lib/* io/* tools/cli tools/cli/options tools/run tools/notes tools/pipe tools/place"
  "tools/lod:lib/* io/* tools/cli tools/cli/options tools/run tools/notes tools/place"
  "tools/mesh:lib/* io/* tools/cli tools/cli/options tools/run tools/notes"
  "tools/view:lib/* io/* tools/cli tools/cli/options tools/run"
  "tools:lib/* io/* tools/*"
  "samples:lib/* io/* tools/cli"
  "tests:lib/* io/* gpu tools/* samples")
# Foreign headers and the only places that know them.
# Tests may ask them for a second opinion: the reference reader is written from the format document alone.
set(foreign
  "assimp/:^io/"
  "pugixml:^io/scene/detail/exact/collada_xml\\.h$"
  "zstd:^(io|tests)/"
  "xxhash:^(lib/store/content_hash\\.cpp$|io/|tests/)"
  "png.h:^(io|tests)/"
  "jpeglib.h:^io/image/"
  "webp/:^(io/image|tests)/"
  "freetype:^io/image/label_font\\.cpp$"
  "ft2build:^io/image/label_font\\.cpp$"
  "OpenMesh/:^tests/"
  "meshoptimizer:^(tests/bench/.*\\.cpp|tests/support/simplified\\.h|io/gltf/meshopt_codec\\.cpp)$"
  "tbb/:^lib/core/parallel\\.(h|cpp)$"
  "oneapi/:^lib/core/parallel\\.(h|cpp)$"
  "proj.h:^io/place/crs_map\\.cpp$"
  "httplib:^tools/view/(server\\.cpp|connections\\.(h|cpp))$"
  "cuda:^(gpu/|tests/)"
  "cub/:^gpu/"
  "catch2/:^tests/(catch\\.h|main\\.cpp)$")

set(errors 0)
function(complain text)
  message("${text}")
  math(EXPR n "${errors} + 1")
  set(errors ${n} PARENT_SCOPE)
endfunction()

foreach(rule ${rules})
  string(REGEX MATCH "^([^:]*):(.*)$" _ "${rule}")
  list(APPEND rooms "${CMAKE_MATCH_1}")
  string(REPLACE " " ";" "may_${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
endforeach()

# The longest room that holds `file`; empty: none.
function(find_room file out)
  set(found "")
  set(most 0)
  foreach(room ${rooms})
    string(FIND "${file}" "${room}/" at)
    string(LENGTH "${room}" length)
    if(at EQUAL 0 AND length GREATER most)
      set(found "${room}")
      set(most ${length})
    endif()
  endforeach()
  set(${out} "${found}" PARENT_SCOPE)
endfunction()

set(checked 0)
foreach(folder lib io gpu tools samples tests)
  file(GLOB_RECURSE files RELATIVE ${ROOT} "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp" "${ROOT}/${folder}/*.cu"
       "${ROOT}/${folder}/*.cuh")
  foreach(file ${files})
    find_room("${file}" own)
    if(own STREQUAL "")
      complain("${file}: its folder has no rule in tests/arch/check_includes.cmake")
      continue()
    endif()
    file(STRINGS "${ROOT}/${file}" once REGEX "^#pragma once$")
    if(file MATCHES "\\.(h|cuh)$" AND once STREQUAL "")
      complain("${file}: has no #pragma once")
    endif()
    file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    string(REGEX REPLACE "\\.cpp$" ".h" header_of_own "${file}")
    if(NOT header_of_own STREQUAL file AND EXISTS "${ROOT}/${header_of_own}")
      string(REGEX REPLACE ";.*" "" first "${lines}")  # so that it proves its header (tests/arch/CMakeLists.txt)
      if(NOT first STREQUAL "#include \"${header_of_own}\"")
        complain("${file}: does not include ${header_of_own} before all others")
      endif()
    endif()
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
        find_room("${header}" room)
        if(NOT room STREQUAL own)
          string(REGEX REPLACE "/.*" "/*" tree "${header}")
          if("${room}" IN_LIST "may_${own}")
            set(use "${own}:${room}")
          elseif("${tree}" IN_LIST "may_${own}")
            set(use "${own}:${tree}")
          else()
            complain("${file}: must not include ${header}; ${own} may include ${may_${own}}")
            continue()
          endif()
          if(NOT use IN_LIST used)
            list(APPEND used "${use}")
          endif()
        endif()
        if(header MATCHES "/detail/")
          string(REGEX REPLACE "/detail/.*" "" home "${header}")
          string(FIND "${file}" "${home}/" at)
          if(NOT at EQUAL 0 AND NOT file MATCHES "^tests/")
            complain("${file}: ${header} is private to ${home}")
          endif()
          if(file MATCHES "\\.h$" AND NOT file MATCHES "^tests/|/detail/")
            complain("${file}: a public header must not include ${header}, which is private")
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
foreach(own ${rooms})
  foreach(room ${may_${own}})
    if(NOT "${own}:${room}" IN_LIST used AND IS_DIRECTORY "${ROOT}/gpu")
      complain("${own} may include ${room}, and does not: take that out of the rules")
    endif()
  endforeach()
endforeach()
if(checked LESS 100)
  complain("only ${checked} includes were found under ${ROOT}; is it the repository?")
endif()
if(errors GREATER 0)
  message(FATAL_ERROR "${errors} includes break the rules")
endif()
message("${checked} includes follow the rules")
