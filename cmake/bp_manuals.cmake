# Man pages, made by pandoc of docs/NAME.1.md and compressed, and completion for bash, zsh and fish, printed by the tools themselves.
find_program(BP_PANDOC pandoc)
if(BP_PANDOC)
  message(STATUS "Man pages: ${BP_PANDOC}")
else()
  message(STATUS "Man pages: skipped, for pandoc was not found; docs/*.1.md hold the same texts")
endif()
string(TIMESTAMP bp_manual_date "%Y-%m-%d" UTC)  # SOURCE_DATE_EPOCH, if set

# bp_add_manual(tool): makes and installs the man page and the completion of a tool.
function(bp_add_manual tool)
  set(made)
  if(BP_PANDOC)
    set(text ${CMAKE_CURRENT_BINARY_DIR}/man/${tool}.1)
    set(page ${text}.gz)
    set(manual ${PROJECT_SOURCE_DIR}/docs/${tool}.1.md)
    set(filter ${PROJECT_SOURCE_DIR}/cmake/man.lua)
    add_custom_command(
      OUTPUT ${page}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/man
      COMMAND ${BP_PANDOC} -s -f markdown-smart -t man -L ${filter} -M docs=${CMAKE_INSTALL_FULL_DOCDIR}/docs -M date=${bp_manual_date} -M "footer=${PROJECT_NAME} ${PROJECT_VERSION}"
              -o ${text} ${manual}
      COMMAND gzip -9nf ${text}
      DEPENDS ${manual} ${filter}
      VERBATIM)
    install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
    list(APPEND made ${page})
  endif()
  if(NOT CMAKE_CROSSCOMPILING)
    set(folder_bash bash-completion/completions)
    set(folder_zsh zsh/site-functions)
    if(CMAKE_INSTALL_PREFIX STREQUAL "/usr" AND EXISTS /etc/debian_version)
      set(folder_zsh zsh/vendor-completions)  # the place of Debian's packages
    endif()
    set(folder_fish fish/vendor_completions.d)
    set(name_bash ${tool})
    set(name_zsh _${tool})
    set(name_fish ${tool}.fish)
    foreach(shell bash zsh fish)
      set(script ${CMAKE_CURRENT_BINARY_DIR}/completion/${shell}/${name_${shell}})
      add_custom_command(
        OUTPUT ${script}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/completion/${shell}
        COMMAND ${tool} --help ${shell} > ${script}
        DEPENDS ${tool})
      install(FILES ${script} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder_${shell}} COMPONENT tools)
      list(APPEND made ${script})
    endforeach()
  endif()
  add_custom_target(${tool}_manual ALL DEPENDS ${made})
endfunction()
