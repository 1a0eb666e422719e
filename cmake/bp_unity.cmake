# The sources of a room are compiled as one, so that headers are read once for all of them. Names without linkage must be
# unique in a room. Sources with options of their own stay apart.

# bp_unite(targets...): for targets that have all of their sources.
function(bp_unite)
  foreach(target ${ARGN})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # it takes sources that are included for headers
    endif()
    get_target_property(home ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    foreach(source ${sources})
      file(REAL_PATH ${source} file BASE_DIRECTORY ${home})
      file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${file})
      if(NOT room MATCHES "^(lib|io|tools|samples|tests)/")
        continue()  # made by the build
      endif()
      string(REGEX REPLACE "(/detail)?/[^/]*$" "" room ${room})
      string(REPLACE "/" "_" room ${room})
      set_source_files_properties(${file} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${room})
    endforeach()
  endforeach()
endfunction()

bp_unite(bp_lib bp_io bp_cli bp_tool_common bp_plant_lib)
foreach(tool bpcheck bpdeform bpinfo bplod bpmesh bpscale)
  bp_unite(${tool}_parts)
endforeach()
if(TARGET bpview_parts)
  bp_unite(bpview_parts)
endif()
if(BP_TESTS)
  bp_unite(bp_tests bp_emulated_gpu_tests)
endif()
