# Sources are compiled in batches, which share what the headers of deal.II cost. A change then compiles a whole batch:
# for daily work on Taut itself, turn it off.
option(TAUT_UNITY "Compile sources in batches" ON)

# taut_compile_in_batches(<target> <number>): up to so many sources of one folder in one batch. Sources whose coverage
# is counted have flags of their own.
function(taut_compile_in_batches target size)
  if(NOT TAUT_UNITY OR TAUT_COVERAGE)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    if(NOT DEFINED ${folder}_count)
      set(${folder}_count 0)
    endif()
    math(EXPR batch "${${folder}_count} / ${size}")
    math(EXPR ${folder}_count "${${folder}_count} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${folder}_${batch}")
  endforeach()
endfunction()
