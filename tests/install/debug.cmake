# Installs BUILD below FOLDER and a Debug build of SOURCE beside it: a Debug project then gets the libraries with
# assertions of both Taut and deal.II, any other project those without.
include(${CMAKE_CURRENT_LIST_DIR}/use_package.cmake)

file(REMOVE_RECURSE ${FOLDER}/moved)
file(MAKE_DIRECTORY ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/moved)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER}/debug -G ${GENERATOR} -D CMAKE_BUILD_TYPE=Debug -D TAUT_TESTS=OFF
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -D DEAL_II_DIR=${DEAL_II_DIR})
run(${CMAKE_COMMAND} --build ${FOLDER}/debug --target taut)
run(${CMAKE_COMMAND} --install ${FOLDER}/debug --prefix ${FOLDER}/moved)

use_package(. Debug libdeal.ii.g.so)
use_package(. default libdeal.ii.so)
use_package(with_deal_ii default libdeal.ii.g.so)
use_package(with_deal_ii Release libdeal.ii.so)
