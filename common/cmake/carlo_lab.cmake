# add_lab(FOLDER NAME [DEPENDS carlo::x ...]): everything a lab is built from.
#
# An implementation is one object library compiled from one file: the student's labs/FOLDER/NAME.cpp,
# the solution, or the solution with one typical mistake patched in. Each is linked with
#   - the lab's experiments (labs/FOLDER/*.cpp but for NAME.cpp)  -> lab01, lab01_solution
#   - the lab's probes (tests/FOLDER/probes*.cpp)  -> lab01_worker, lab01_worker_solution,
#                                                     lab01_worker_mistake_<patch>
# What is judged is compiled once more, with the library's own checks: an index outside of a vector
# or a span ends the program. The experiments, which are timed, run without them.
# The judge, lab01_judge, is compiled from tests/FOLDER/checks*.cpp and holds none of them.
# Parts that a tree does not have (solutions/, tests/) are left out.

# One implementation: the object library TARGET from the one file SOURCE.
function(carlo_lab_implementation target folder source)
  add_library(${target} OBJECT "${source}")
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/labs/${folder}"
                             "${PROJECT_SOURCE_DIR}/common")
  target_link_libraries(${target} PUBLIC carlo::build carlo::course ${ARGN})
endfunction()

# The same for a worker.
function(carlo_lab_judged_implementation target folder source)
  carlo_lab_implementation(${target} ${folder} "${source}" ${ARGN})
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
endfunction()

# Compiled once, linked with every implementation: PREFIX_PART from SOURCES.
function(carlo_lab_part target folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(${target} OBJECT ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/labs/${folder}"
                             "${PROJECT_SOURCE_DIR}/common")
  target_link_libraries(${target} PUBLIC carlo::build ${ARG_DEPENDS} PRIVATE carlo::strict)
endfunction()

# An executable of one part and one implementation.
function(carlo_lab_program target part implementation)
  add_executable(${target})
  target_link_libraries(${target} PRIVATE ${part} ${implementation} carlo::build)
endfunction()

# Well over a hundred small programs: one build type is enough for them.
option(CARLO_MISTAKES "Build the labs' typical mistakes and test that each is caught" ON)

# The workers of the typical mistakes: tests/FOLDER/mistakes/*.patch, each applied to the solution.
# A patch that no longer applies fails the build.
function(carlo_lab_mistakes lab folder name)
  find_program(CARLO_PATCH patch)
  file(GLOB patches CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/${folder}/mistakes/*.patch")
  if(patches AND NOT CARLO_PATCH)
    message(FATAL_ERROR "patch was not found: ${carlo_hint} patch")
  endif()
  set(solution "${PROJECT_SOURCE_DIR}/solutions/${folder}/${name}.cpp")
  foreach(patch IN LISTS patches)
    get_filename_component(mistake "${patch}" NAME_WE)
    set(patched "${CMAKE_CURRENT_BINARY_DIR}/mistakes/${folder}/${mistake}/${name}.cpp")
    get_filename_component(patched_folder "${patched}" DIRECTORY)
    add_custom_command(
      OUTPUT "${patched}"
      COMMAND ${CMAKE_COMMAND} -E make_directory "${patched_folder}"
      COMMAND "${CARLO_PATCH}" --quiet --fuzz=0 --no-backup-if-mismatch --reject-file=-
              "--output=${patched}" "${solution}" "${patch}"
      DEPENDS "${solution}" "${patch}"
      COMMENT "Putting mistake ${mistake} into lab ${folder}" VERBATIM)
    set(worker ${lab}_worker_mistake_${mistake})
    carlo_lab_judged_implementation(${worker}_code ${folder} "${patched}" ${ARGN})
    carlo_lab_program(${worker} ${lab}_probes ${worker}_code)
    list(APPEND workers ${worker})
  endforeach()
  add_custom_target(${lab}_mistakes DEPENDS ${workers})
endfunction()

function(add_lab folder name)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  string(REGEX MATCH "^[0-9][0-9]" number "${folder}")
  set(lab lab${number})
  set(here "${PROJECT_SOURCE_DIR}/labs/${folder}")
  set(tests "${PROJECT_SOURCE_DIR}/tests/${folder}")
  set(solution "${PROJECT_SOURCE_DIR}/solutions/${folder}/${name}.cpp")
  set(uses carlo::random carlo::stats ${ARG_DEPENDS})

  # A student's file gets the warnings but is built all the same; ours is not. Parameters of exercises
  # that are not done yet are unused by nature.
  carlo_lab_implementation(${lab}_code ${folder} "${here}/${name}.cpp" ${uses})
  set(students_warnings -Wall -Wextra -Wpedantic -Wno-unused-parameter)
  target_compile_options(${lab}_code PRIVATE ${students_warnings})
  set(implementations "${lab}_code")
  if(EXISTS "${solution}")
    carlo_lab_implementation(${lab}_code_solution ${folder} "${solution}" ${uses} carlo::strict)
    list(APPEND implementations ${lab}_code_solution)
  endif()

  file(GLOB experiments CONFIGURE_DEPENDS "${here}/*.cpp")
  list(REMOVE_ITEM experiments "${here}/${name}.cpp")
  if(experiments)
    carlo_lab_part(${lab}_experiments ${folder} SOURCES ${experiments}
                   DEPENDS ${uses} carlo::cli carlo::course carlo::stats carlo::report
                           CLI11::CLI11 nlohmann_json::nlohmann_json)
    foreach(code IN LISTS implementations)
      string(REPLACE "_code" "" program "${code}")
      carlo_lab_program(${program} ${lab}_experiments ${code})
    endforeach()
  endif()

  file(GLOB probes CONFIGURE_DEPENDS "${tests}/probes*.cpp")
  if(probes)
    carlo_lab_part(${lab}_probes ${folder} SOURCES ${probes}
                   DEPENDS ${uses} carlo::grader_worker)
    carlo_lab_judged_implementation(${lab}_worker_code ${folder} "${here}/${name}.cpp" ${uses})
    target_compile_options(${lab}_worker_code PRIVATE ${students_warnings})
    carlo_lab_program(${lab}_worker ${lab}_probes ${lab}_worker_code)
    if(EXISTS "${solution}")
      carlo_lab_judged_implementation(${lab}_worker_code_solution ${folder} "${solution}" ${uses}
                                      carlo::strict)
      carlo_lab_program(${lab}_worker_solution ${lab}_probes ${lab}_worker_code_solution)
    endif()
    if(EXISTS "${solution}" AND CARLO_MISTAKES)
      carlo_lab_mistakes(${lab} ${folder} ${name} ${uses})
    endif()
  endif()

  file(GLOB checks CONFIGURE_DEPENDS "${tests}/checks*.cpp")
  if(checks)
    add_executable(${lab}_judge ${checks})
    target_link_libraries(${lab}_judge PRIVATE carlo::grader_judge carlo::strict)
  endif()
endfunction()
