# Builds SOURCE with the sanitizers for addresses (which finds leaks, too) and undefined behaviour below FOLDER, and runs
# there the unit tests, the extreme scenes, the program on a scene with a moving contact, 5000 parameter files changed at
# random, and 10000 sequences of calls of a program. Whatever the sanitizers report ends a program with an error. No
# library below Taut leaks in these runs, so nothing is suppressed.
set(programs complementarity_tests fe_cubic_hermite_tests bad_input_tests library_tests extreme_scenes)
set(ENV{ASAN_OPTIONS} detect_leaks=1:detect_stack_use_after_return=1:strict_string_checks=1)
set(ENV{UBSAN_OPTIONS} print_stacktrace=1)

include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

file(MAKE_DIRECTORY ${FOLDER})
# -g1 puts lines into the reports.
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/build -G ${GENERATOR} -D TAUT_SANITIZE=address,undefined
  -D CMAKE_CXX_FLAGS=-g1 -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -D DEAL_II_DIR=${DEAL_II_DIR})
run(${CMAKE_COMMAND} --build ${FOLDER}/build --parallel ${JOBS} --target taut-program fuzz_parameters fuzz_library
  ${programs})

foreach(program ${programs})
  file(GLOB_RECURSE path ${FOLDER}/build/tests/${program})
  run(${path})
endforeach()
run(${FOLDER}/build/taut ${SOURCE}/prm/en50318_2002_250.prm --set Time.End=0.2 --set Statistics.Window= --set Output.Folder=results --overwrite)
# The sanitizer's shadow memory needs more address space than the test allows; each file has longer, too.
run(${FOLDER}/build/tests/fuzz/fuzz_parameters --corpus ${SOURCE}/prm --seed 7 --count 5000 --memory 0 --seconds 200)
run(${FOLDER}/build/tests/fuzz/fuzz_library --seed 3 --count 10000)
