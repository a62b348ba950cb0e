# cmake -DROOT=... -DHEADER=... -P write_commit.cmake: a header with MANZANA_COMMIT, rewritten when that changes. With
# changes against the commit their hash is part of the name, so that no two states share one.
set(commit "unknown")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${ROOT} rev-parse --short=12 HEAD OUTPUT_VARIABLE head ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
  # A copy without history inside some other repository has a prefix there.
  execute_process(COMMAND ${GIT} -C ${ROOT} rev-parse --show-prefix OUTPUT_VARIABLE prefix ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed AND prefix STREQUAL "")
    set(commit "${head}")
    execute_process(COMMAND ${GIT} -C ${ROOT} diff HEAD OUTPUT_VARIABLE changes ERROR_QUIET)
    if(NOT changes STREQUAL "")
      string(SHA1 hash "${changes}")
      string(SUBSTRING "${hash}" 0 8 hash)
      string(APPEND commit "-dirty-${hash}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}.new" CONTENT "#define MANZANA_COMMIT \"${commit}\"\n")
file(COPY_FILE "${HEADER}.new" "${HEADER}" ONLY_IF_DIFFERENT)
