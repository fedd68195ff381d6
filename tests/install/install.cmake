# Installs BUILD into a folder below FOLDER, moves it, and from there uses it: the program runs a scene, and the projects
# beside this file find the package and are built and run, with each build type that a user may choose.
include(${CMAKE_CURRENT_LIST_DIR}/use_package.cmake)

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/staged)
file(RENAME ${FOLDER}/staged ${FOLDER}/moved)

run(${FOLDER}/moved/bin/taut ${FOLDER}/moved/share/taut/prm/oscillator_with_stop.prm)
foreach(file LICENSE README.md doc/tutorial.md doc/figures/en50318_2002_250.png tests/install/CMakeLists.txt)
  if(NOT EXISTS ${FOLDER}/moved/share/doc/taut/${file})
    message(FATAL_ERROR "share/doc/taut/${file} is not installed")
  endif()
endforeach()

foreach(type default Debug Release)
  use_package(. ${type} libdeal.ii.so)
endforeach()
foreach(type default Release)
  use_package(with_deal_ii ${type} libdeal.ii.so)
endforeach()

# Programs that bring their own bodies, in Debug and Release: each compares its result with a method of its own.
foreach(type Debug Release)
  set(build ${FOLDER}/build_library_${type})
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/library -B ${build} -G ${GENERATOR} -D CMAKE_BUILD_TYPE=${type}
    -D CMAKE_PREFIX_PATH=${FOLDER}/moved "-D CMAKE_CXX_FLAGS=-Wall -Wextra -Werror" -D DEAL_II_DIR=${DEAL_II_DIR}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
  run(${CMAKE_COMMAND} --build ${build})
  foreach(program controlled_mass plate membrane)
    run(${CMAKE_COMMAND} -E chdir ${build} ./${program})
  endforeach()
endforeach()
run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/plugin.py --program ${FOLDER}/moved/bin/taut --mpiexec ${MPIEXEC}
  --prm ${CMAKE_CURRENT_LIST_DIR}/library/plate.prm --build ${FOLDER}/build_library_Release)

# The same generator in a library that the installed program loads; without it the name is not known.
set(library build_._default/libweight.so)
run(${FOLDER}/moved/bin/taut ${CMAKE_CURRENT_LIST_DIR}/weight_on_floor.prm --overwrite
  --set "Additional shared libraries=${library}" --set "Weight on floor/Mass=2")
file(STRINGS ${FOLDER}/results/links.csv lines)
list(GET lines -1 last)
if(NOT last MATCHES "^0.1,31.7[23]")
  message(FATAL_ERROR "the floor carries 31.732 N at 0.1 s, less the error of the scheme, not: ${last}")
endif()
foreach(library "" build/libnowhere.so)
  execute_process(COMMAND ${FOLDER}/moved/bin/taut ${CMAKE_CURRENT_LIST_DIR}/weight_on_floor.prm --overwrite
    --set "Additional shared libraries=${library}" WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE code ERROR_VARIABLE message)
  if(NOT code EQUAL 1 OR NOT message MATCHES "no such generator|cannot load 'build/libnowhere.so'")
    message(FATAL_ERROR "with the library '${library}': ${code}, ${message}")
  endif()
endforeach()
