# Writes phare_commit.h anew when the commit is another: cmake -DSOURCE=… -DOUT=… -P write_commit.cmake. Only commit.cpp
# includes it, so the compiler cache keeps everything else.
set(commit unknown)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --exclude=* OUTPUT_VARIABLE said ERROR_QUIET RESULT_VARIABLE failed
  OUTPUT_STRIP_TRAILING_WHITESPACE)
if(said AND "${failed}" STREQUAL "0")
  set(commit ${said})
else()
  file(STRINGS ${SOURCE}/config/base/commit.txt said LIMIT_COUNT 1)
  if(said MATCHES "^[0-9a-f]+$")
    set(commit ${said})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#define PHARE_COMMIT \"${commit}\"\n")
