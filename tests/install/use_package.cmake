# use_package(<project> <build type> <library>): configures, builds and runs a project with the package below
# FOLDER/moved. The only deal.II library that its program loads is the one named; only a Release project is without assert().
include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

function(use_package project type expected)
  set(build ${FOLDER}/build_${project}_${type})
  set(build_type "")
  if(NOT type STREQUAL "default")
    set(build_type -D CMAKE_BUILD_TYPE=${type})
  endif()
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/${project} -B ${build} -G ${GENERATOR} ${build_type}
    -D CMAKE_EXPORT_COMPILE_COMMANDS=ON -D CMAKE_PREFIX_PATH=${FOLDER}/moved "-D CMAKE_CXX_FLAGS=-Wall -Wextra -Werror" -D DEAL_II_DIR=${DEAL_II_DIR}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
  file(READ ${build}/compile_commands.json commands)
  if(NOT type STREQUAL "Release" AND commands MATCHES "NDEBUG")
    message(FATAL_ERROR "${build}: the package switches assert() off")
  endif()
  run(${CMAKE_COMMAND} --build ${build})
  execute_process(COMMAND ldd ${build}/weight_on_floor OUTPUT_VARIABLE libraries)
  string(REGEX MATCHALL "libdeal\\.ii(\\.g)?\\.so" found "${libraries}")
  list(REMOVE_DUPLICATES found)
  if(NOT found STREQUAL expected)
    message(FATAL_ERROR "${build}/weight_on_floor loads '${found}', not ${expected}")
  endif()
  run(${CMAKE_COMMAND} -E chdir ${build} ./weight_on_floor ${CMAKE_CURRENT_LIST_DIR}/weight_on_floor.prm)
endfunction()
