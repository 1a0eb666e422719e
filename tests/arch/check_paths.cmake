# No tracked file names a place of one machine: home directories, build folders, mounts.
#   cmake -DROOT=<repository> -P tests/arch/check_paths.cmake
find_program(GIT git)
if(NOT GIT OR NOT EXISTS "${ROOT}/.git")
  message("SKIPPED: needs git and a checkout")
  return()
endif()
execute_process(COMMAND ${GIT} grep -nIE "(^|[^A-Za-z0-9_.\\$}])/(work|home|Users|root|mnt|build)/[A-Za-z0-9_.]" -- .
                WORKING_DIRECTORY "${ROOT}" OUTPUT_VARIABLE found RESULT_VARIABLE status)
if(status EQUAL 0)
  message(FATAL_ERROR "paths of one machine:\n${found}")
elseif(NOT status EQUAL 1)
  message(FATAL_ERROR "git grep failed: ${status}")
endif()
