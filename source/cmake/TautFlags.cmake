# Compiler flags of every Taut target.
#
# The deal.II macro appends the flags that Debian built deal.II with, "-g -O2" among them, after those of the
# target, and the last optimisation flag wins. Which warnings it asks for changes with its version. They are emptied
# here, before the macro runs, so that what compile_commands.json shows is exactly what is written below.
set(DEAL_II_WARNING_FLAGS "")
set(DEAL_II_CXX_FLAGS "")
set(DEAL_II_CXX_FLAGS_DEBUG "")
set(DEAL_II_CXX_FLAGS_RELEASE "")

set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")

function(taut_setup_target target)
  deal_ii_setup_target(${target})
  taut_set_flags(${target})
endfunction()

# Of a target without deal.II.
function(taut_set_flags target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -fopenmp-simd)
  if(TAUT_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
  if(TAUT_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(TAUT_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${TAUT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(TAUT_WERROR)
      # The compiler takes the checks of the sanitizers inside Boost for uses of what is not initialised.
      target_compile_options(${target} PRIVATE -Wno-error=maybe-uninitialized)
    endif()
    # PUBLIC: a program outside that uses the library must load the sanitizer's runtime before anything else.
    target_link_options(${target} PUBLIC -fsanitize=${TAUT_SANITIZE})
  endif()
endfunction()
