# Installs BUILD into a folder below FOLDER, moves it, and from there uses it twice: the program runs a scene, and the
# project beside this file finds the package, is built and run.
include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/staged)
file(RENAME ${FOLDER}/staged ${FOLDER}/moved)

run(${FOLDER}/moved/bin/taut ${FOLDER}/moved/share/taut/prm/oscillator_with_stop.prm)

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${FOLDER}/build -G ${GENERATOR}
  -D CMAKE_PREFIX_PATH=${FOLDER}/moved -D "CMAKE_CXX_FLAGS=-Wall -Wextra -Werror"
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/weight_on_floor ${CMAKE_CURRENT_LIST_DIR}/weight_on_floor.prm)

# The same generator in a library that the installed program loads; without it the name is not known.
run(${FOLDER}/moved/bin/taut ${CMAKE_CURRENT_LIST_DIR}/weight_on_floor.prm --overwrite
  --set "Additional shared libraries=build/libweight.so" --set "Weight on floor/Mass=2")
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
