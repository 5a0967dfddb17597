# Configure the `tsan` preset and build what of it has threads of its own; run from the top of the tree.
foreach(step "--preset;tsan" "--build;--preset;tsan;--target;fake_fairlead;test_session;--;-j;2")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "cmake ${step} failed: ${status}")
  endif()
endforeach()
