# carlo_be_patient(FOLDER): multiplies test timeouts by CARLO_PATIENCE where programs are emulated
# (QEMU is at least ten times slower). Excludes tests that a program lists at build time
# (renderer:...). Requires CMake 3.28 or later.
cmake_minimum_required(VERSION 3.28)

function(carlo_be_patient folder)
  get_property(tests DIRECTORY "${folder}" PROPERTY TESTS)
  foreach(test IN LISTS tests)
    get_test_property("${test}" TIMEOUT DIRECTORY "${folder}" seconds)
    if(seconds)
      math(EXPR seconds "${seconds} * ${CARLO_PATIENCE}")
      set_tests_properties("${test}" DIRECTORY "${folder}" PROPERTIES TIMEOUT ${seconds})
    endif()
  endforeach()
  get_property(parts DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(part IN LISTS parts)
    carlo_be_patient("${part}")
  endforeach()
endfunction()
