# One interface target carries the language level, the warnings and the floating-point rules of every target.
add_library(bp_compile_options INTERFACE)
target_compile_features(bp_compile_options INTERFACE cxx_std_20)
target_include_directories(bp_compile_options INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                                        "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
target_compile_definitions(bp_compile_options INTERFACE BP_VERSION="${PROJECT_VERSION}")

# Same bytes from every build: no contraction of a*b+c, no reassociation. Exact predicates depend on it.
target_compile_options(bp_compile_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
# Warnings are ours, not those of who uses an installed copy.
target_compile_options(
  bp_compile_options
  INTERFACE "$<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wnon-virtual-dtor;-Woverloaded-virtual>>")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False for "text" + std::string (GCC bug 105651).
  target_compile_options(bp_compile_options INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>>)
endif()
if(BP_WERROR)
  target_compile_options(bp_compile_options INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Werror>>)
endif()

if(BP_FUZZ)  # coverage for the fuzzers of tests/fuzz, and sanitizers everywhere; watching comparisons would halve their speed
  target_compile_options(bp_compile_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                                                      -fsanitize-coverage=inline-8bit-counters,pc-table)
  target_link_options(bp_compile_options INTERFACE -fsanitize=address,undefined)
endif()

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# Releases are hardened as Debian asks: checked copies, guarded stacks, tables of the loader that nobody can write.
string(APPEND CMAKE_CXX_FLAGS_RELEASE " -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2 -fstack-protector-strong")
foreach(kind EXE SHARED)
  string(APPEND CMAKE_${kind}_LINKER_FLAGS_RELEASE " -Wl,-z,relro -Wl,-z,now")
endforeach()
set(CMAKE_CXX_EXTENSIONS ON)  # __int128 is an extension; -Wpedantic stays on, uses are marked __extension__
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Rooms as one are for builds from nothing, where a cache only costs.
find_program(BP_CCACHE ccache)
if(BP_CCACHE AND NOT BP_UNITY AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${BP_CCACHE}")
  set(CMAKE_CUDA_COMPILER_LAUNCHER "${BP_CCACHE}")
endif()

# bp_shareable(target): its objects may go into libbp.so, and export nothing there by themselves.
function(bp_shareable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()
