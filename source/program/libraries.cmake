# cmake -D LIBRARY=<file> -D OUTPUT=<header> -P libraries.cmake: the names of the libraries that a library brings, those
# that need no other first. Only libraries from the folder of libc count: the loader finds them by their names alone.
execute_process(COMMAND ldd ${LIBRARY} OUTPUT_VARIABLE found)
set(lines "")
if(found MATCHES "=> (/[^ ]*)/libc\\.so")
  string(REGEX MATCHALL "[^ \t\n]+ => ${CMAKE_MATCH_1}/[^/ \n]+ " lines "${found}")
endif()
list(REVERSE lines)
list(TRANSFORM lines REPLACE "^([^ ]+) .*" "    \"\\1\",\n")
list(JOIN lines "" names)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "// Made by source/program/libraries.cmake.
namespace taut
{
  constexpr const char *libraries[] = {
@names@    \"libc.so.6\"};
} // namespace taut
")
