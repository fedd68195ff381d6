# Installs BUILD into a folder below FOLDER, moves it, and from there uses it twice: the program runs a scene, and the
# project beside this file finds the package, is built and run.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "ended with ${code}: ${ARGN}")
  endif()
endfunction()

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
