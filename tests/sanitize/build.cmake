# Configure and build the `asan` preset; run from the top of the tree.
foreach(step "--preset;asan" "--build;--preset;asan;--;-j;2")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "cmake ${step} failed: ${status}")
  endif()
endforeach()
