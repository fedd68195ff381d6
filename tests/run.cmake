# run(<command>...): the command in FOLDER; an exit code other than 0 ends the script.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "ended with ${code}: ${ARGN}")
  endif()
endfunction()
