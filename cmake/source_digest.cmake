# Writes a C++ file that defines bp::source_digest(): 16 hexadecimal digits that change whenever a source that decides
# bytes does. Run by the build whenever one changed: cmake -DROOT=... -DOUTPUT=... -P source_digest.cmake
file(GLOB_RECURSE sources LIST_DIRECTORIES false RELATIVE "${ROOT}" "${ROOT}/lib/*" "${ROOT}/io/*" "${ROOT}/gpu/*"
     "${ROOT}/tools/*")
list(FILTER sources EXCLUDE REGEX "^tools/(python|blender)/")  # they call what is made of the others
list(SORT sources)
set(all "")
foreach(source IN LISTS sources)
  file(SHA256 "${ROOT}/${source}" digest)
  string(APPEND all "${source} ${digest}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING "${digest}" 0 16 digest)
set(text "#include \"lib/store/source_digest.h\"\n\nstd::string_view bp::source_digest() {\n  return \"${digest}\";\n}\n")
set(before "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT before STREQUAL text)
  file(WRITE "${OUTPUT}" "${text}")
endif()
