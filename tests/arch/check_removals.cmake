# What is read is never lost: files get their final names, and lose them, in io/files/final_names.cpp only, which asks io/files/kept_files.h.
# The other files named here touch nothing but what this process made: unfinished and scratch files, folders.
#   cmake -DROOT=<repository> -P tests/arch/check_removals.cmake
cmake_policy(SET CMP0057 NEW)
set(allowed io/files/final_names.cpp io/files/file.cpp io/files/partial_outputs.cpp io/files/made_folders.cpp io/tiles/tileset_folder.cpp)
set(names "(rename|renameat2?|unlink|unlinkat|link|remove|remove_all)")
set(calls "((^|[^A-Za-z0-9_>])::|fs::|filesystem::|std::)${names}\\(")
set(errors 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} "${ROOT}/lib/*.cpp" "${ROOT}/io/*.cpp" "${ROOT}/gpu/*.cu" "${ROOT}/tools/*.cpp"
     "${ROOT}/lib/*.h" "${ROOT}/io/*.h" "${ROOT}/tools/*.h")
foreach(file ${files})
  if(file IN_LIST allowed)
    continue()
  endif()
  file(STRINGS "${ROOT}/${file}" lines REGEX "${calls}")
  foreach(line ${lines})
    if(line MATCHES "std::remove\\([a-z_.]+begin")  # the algorithm
      continue()
    endif()
    message("${file}: '${line}': use place_file() or remove_file() of io/files/final_names.h")
    math(EXPR errors "${errors} + 1")
  endforeach()
endforeach()
if(errors)
  message(FATAL_ERROR "${errors} places rename or remove files by themselves")
endif()
