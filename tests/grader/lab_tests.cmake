# add_lab_tests(FOLDER NAME): adds the grader's tests of one lab. The solution has full marks at
# many seeds, and so has each variant of it; the stub has no points and says "not implemented"; each
# mistake is caught and named; probes' results have names for replay; lab.json, stub, handout, hints
# and tests agree.

# Labs whose mistakes are all named alone, and shall stay so. Elsewhere "alone" behind a mistake's
# diagnosis asks for it (mistakes.awk).
set(labs_with_lone_diagnoses lab01 lab02 lab05)

# Adds one test judged by expect.cmake. CONFIGURATIONS thorough: only with ctest -C thorough.
function(add_expectation name lab worker)
  cmake_parse_arguments(ARG "" "CONFIGURATIONS" "" ${ARGN})
  set(when "")
  if(ARG_CONFIGURATIONS)
    set(when CONFIGURATIONS ${ARG_CONFIGURATIONS})
  endif()
  add_test(NAME ${name} ${when}
           COMMAND ${CMAKE_COMMAND} -DJUDGE=$<TARGET_FILE:${lab}_judge> -DLAB=${${lab}_json}
                   -DWORKER=$<TARGET_FILE:${worker}>
                   -DJSON=${CMAKE_CURRENT_BINARY_DIR}/${name}.json -DPATIENCE=${CARLO_PATIENCE} ${ARG_UNPARSED_ARGUMENTS}
                   -P ${PROJECT_SOURCE_DIR}/tests/grader/expect.cmake)
endfunction()

# Adds a worker that forges some answers, tests/FOLDER/forged.cpp linked with the solution: the
# judge detects them by its own computation, so that exercises have these points.
function(add_forgery folder name points)
  string(REGEX MATCH "^[0-9][0-9]" number "${folder}")
  set(lab lab${number})
  set(solution "${PROJECT_SOURCE_DIR}/solutions/${folder}/${name}.cpp")
  if(NOT TARGET ${lab}_worker_solution OR NOT EXISTS "${solution}")
    return()
  endif()
  set(forged "${PROJECT_SOURCE_DIR}/tests/${folder}/forged.cpp")
  carlo_lab_judged_implementation(${lab}_forged_code ${folder} "${solution};${forged}"
                                  carlo::random carlo::stats grader_protocol carlo::strict)
  carlo_lab_program(${lab}_worker_forged ${lab}_probes ${lab}_forged_code)
  add_expectation(${lab}.forged_answers ${lab} ${lab}_worker_forged -DPOINTS=${points})
  set_tests_properties(${lab}.forged_answers PROPERTIES LABELS fast TIMEOUT 600)
endfunction()

# The mistakes and the variants of a lab, of which carlo_lab.cmake has made workers.
function(add_mistake_tests lab)
  get_property(mistakes GLOBAL PROPERTY ${lab}_mistakes)
  foreach(line IN LISTS mistakes)
    string(REGEX MATCH "^[^\t]+\t([^\t]+)\t[^\t]+\t([^\t]+)\t([^\t]+)(\talone)?" line "${line}")
    set(name "${CMAKE_MATCH_1}")
    set(expected -DEXERCISE=${CMAKE_MATCH_2} -DDIAGNOSIS=${CMAKE_MATCH_3})
    if(CMAKE_MATCH_4 OR lab IN_LIST labs_with_lone_diagnoses)
      list(APPEND expected -DALONE=ON)
    endif()
    add_expectation(${lab}.mistake.${name} ${lab} ${lab}_worker_mistake_${name} ${expected})
    set_tests_properties(${lab}.mistake.${name} PROPERTIES TIMEOUT 600)
  endforeach()
  get_property(variants GLOBAL PROPERTY ${lab}_variants)
  foreach(line IN LISTS variants)
    string(REGEX REPLACE "^[^\t]+\t([^\t]+)\t.*" "\\1" name "${line}")
    add_expectation(${lab}.variant.${name} ${lab} ${lab}_worker_variant_${name} -DSEEDS=3)
    set_tests_properties(${lab}.variant.${name} PROPERTIES TIMEOUT 600)
  endforeach()
endfunction()

function(add_lab_tests folder name)
  string(REGEX MATCH "^[0-9][0-9]" number "${folder}")
  set(lab lab${number})
  set(here "${PROJECT_SOURCE_DIR}/labs/${folder}")
  set(${lab}_json "${here}/lab.json")
  if(NOT TARGET ${lab}_judge)
    return()
  endif()

  if(TARGET ${lab}_worker_solution AND EXISTS "${PROJECT_SOURCE_DIR}/solutions/CMakeLists.txt")
    # The file in labs/ is the stub only where nobody works on the exercises: in the whole suite. A
    # student's tree may hold the solutions of earlier labs.
    carlo_lab_sources(stub "${here}" ${name})
    add_test(NAME ${lab}.consistency
             COMMAND ${lab}_judge --lab "${here}/lab.json" --stub ${stub}
                     --handout "${here}/README.md")
    add_expectation(${lab}.stub ${lab} ${lab}_worker)
    set(questions "${CMAKE_CURRENT_BINARY_DIR}/${lab}.questions.json")
    # Sanitizer builds run without the sandbox, which they are not meant to check.
    set(fence "")
    if(CARLO_SANITIZE)
      set(fence --sandbox limits)
    endif()
    add_test(NAME ${lab}.solution COMMAND ${lab}_judge --lab "${here}/lab.json"
             --worker $<TARGET_FILE:${lab}_worker_solution> --probes "${questions}"
             ${fence})
    add_test(NAME ${lab}.names
             COMMAND ${CMAKE_COMMAND} -DWORKER=$<TARGET_FILE:${lab}_worker_solution>
                     "-DQUESTIONS=${questions}" -P ${PROJECT_SOURCE_DIR}/tests/grader/names.cmake)
    set_tests_properties(${lab}.solution PROPERTIES FIXTURES_SETUP ${lab}_questions)
    set_tests_properties(${lab}.names PROPERTIES FIXTURES_REQUIRED ${lab}_questions)
    # The public seed (above) and two others at every landing, more nightly (tests/nightly.sh).
    add_expectation(${lab}.seeds ${lab} ${lab}_worker_solution -DSEEDS=2)
    add_expectation(${lab}.seeds.many ${lab} ${lab}_worker_solution -DFIRST=3 -DSEEDS=40
                    CONFIGURATIONS thorough)
    set_tests_properties(${lab}.consistency ${lab}.stub ${lab}.solution ${lab}.names
                         PROPERTIES LABELS fast TIMEOUT 600)
    set_tests_properties(${lab}.solution PROPERTIES LABELS "fast;memory")
    memory_tests_need(${lab}_judge ${lab}_worker_solution)
    first_tests(TESTS ${lab}.consistency ${lab}.stub ${lab}.solution ${lab}.names
                PROGRAMS ${lab}_judge ${lab}_worker ${lab}_worker_solution)
    set_tests_properties(${lab}.seeds PROPERTIES TIMEOUT 600)
    set_tests_properties(${lab}.seeds.many PROPERTIES TIMEOUT 3600)
  endif()
  add_mistake_tests(${lab})
  # Tests of what a lab gives its students.
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/CMakeLists.txt")
    add_subdirectory(${folder})
    get_property(own DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  endif()
  # Builds everything for ./carlo test N --solutions.
  add_custom_target(${lab}_tests)
  foreach(needed IN ITEMS ${lab}_judge ${lab}_worker ${lab}_worker_solution ${lab}_mistakes ${lab}_variants
                          ${own})
    if(TARGET ${needed})
      add_dependencies(${lab}_tests ${needed})
    endif()
  endforeach()
endfunction()
