# A type has one definition. Two headers that define the same name are an error that neither compiler nor linker reports: programs that link
# both take the destructor of either.
#   cmake -DROOT=<repository> -P tests/arch/check_names.cmake
set(errors 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} "${ROOT}/lib/*.h" "${ROOT}/io/*.h" "${ROOT}/gpu/*.h" "${ROOT}/gpu/*.cuh" "${ROOT}/tools/*.h")
foreach(file ${files})
  file(STRINGS "${ROOT}/${file}" lines REGEX "^(struct|class|enum class|enum|union) [A-Za-z0-9_]+ .*{")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^(struct|class|enum class|enum|union) ([A-Za-z0-9_]+) .*" "\\2" name "${line}")
    if(DEFINED home_${name})
      message("${name}: defined in ${home_${name}} and in ${file}")
      math(EXPR errors "${errors} + 1")
    endif()
    set(home_${name} ${file})
  endforeach()
endforeach()
if(errors)
  message(FATAL_ERROR "${errors} types have two definitions")
endif()
