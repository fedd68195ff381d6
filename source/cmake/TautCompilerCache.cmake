# A source file that sees deal.II costs up to 25 s; from ccache 0.1 s. Switch off with -DCMAKE_CXX_COMPILER_LAUNCHER="".
find_program(CCACHE_PROGRAM ccache)
mark_as_advanced(CCACHE_PROGRAM)
if(CCACHE_PROGRAM AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
