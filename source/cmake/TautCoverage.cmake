# What the tests reach of the rooms in TAUT_COVERAGE; doc/results/coverage.md has the commands and the figures. The rest is
# compiled as ever, so that tests take no longer than they do.

# taut_count_coverage(<library>): the sources of these rooms count their lines and branches. -O1 keeps a branch of the
# machine for a branch of the source.
function(taut_count_coverage library)
  if(NOT TAUT_COVERAGE)
    return()
  endif()
  get_target_property(sources ${library} SOURCES)
  foreach(room ${TAUT_COVERAGE})
    set(of_room ${sources})
    list(FILTER of_room INCLUDE REGEX "source/${room}/")
    set_source_files_properties(${of_room} TARGET_DIRECTORY ${library} PROPERTIES COMPILE_OPTIONS "--coverage;-O1")
  endforeach()
  target_link_options(${library} PRIVATE --coverage)
endfunction()
