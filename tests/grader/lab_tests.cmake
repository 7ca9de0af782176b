# add_lab_tests(FOLDER NAME): the grader's tests of one lab, through CTest. The solution has full
# marks, at every seed; the stub has none and says "not implemented"; each mistake is caught and
# named; lab.json, stub, handout and tests agree.
function(add_lab_tests folder name)
  string(REGEX MATCH "^[0-9][0-9]" number "${folder}")
  set(lab lab${number})
  set(here "${PROJECT_SOURCE_DIR}/labs/${folder}")
  set(judge $<TARGET_FILE:${lab}_judge> --lab "${here}/lab.json")

  add_test(NAME ${lab}.consistency
           COMMAND ${judge} --stub "${here}/${name}.cpp" --handout "${here}/README.md")
  add_test(NAME ${lab}.stub COMMAND ${CMAKE_COMMAND} "-DJUDGE=${judge}" 
           "-DWORKER=$<TARGET_FILE:${lab}_worker>" -DEXPECT=not_implemented
           -P "${PROJECT_SOURCE_DIR}/tests/grader/expect.cmake" COMMAND_EXPAND_LISTS)
  set(fast ${lab}.consistency ${lab}.stub)
  if(TARGET ${lab}_worker_solution)
    add_test(NAME ${lab}.solution COMMAND ${judge} --worker $<TARGET_FILE:${lab}_worker_solution>)
    list(APPEND fast ${lab}.solution)
  endif()
  set_tests_properties(${fast} PROPERTIES LABELS fast TIMEOUT 120)
endfunction()
