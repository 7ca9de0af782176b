# add_lab(FOLDER NAME [DEPENDS carlo::x ...] [EXPERIMENTS carlo::y ...]): everything a lab is built
# from; only the experiments link the libraries after EXPERIMENTS.
#
# An implementation is one object library compiled from the student's files, from the solution's, or
# from the solution's with one change: a typical mistake, or a variant that is as right. The files are
# labs/FOLDER/NAME.cpp alone or, for a lab in steps, labs/FOLDER/steps/*.cpp; the solution's have the
# same names. labs/FOLDER/given/ holds what a lab gives to students and to probes. Each
# implementation is linked with
#   - the lab's experiments (labs/FOLDER/*.cpp except NAME.cpp)  -> lab01, lab01_solution
#   - the lab's probes (tests/FOLDER/probes*.cpp)  -> lab01_worker, lab01_worker_solution,
#                                                     lab01_worker_mistake_<name>,
#                                                     lab01_worker_variant_<name>
# Code to be judged is compiled again, with the library's own checks: an index outside a vector or a
# span ends the program. And an uninitialised local variable holds a huge number (NaN with clang), not
# the 0 that happens to be on a fresh stack. The experiments, which are timed, run without these.
# The judge, lab01_judge, is compiled from tests/FOLDER/checks*.cpp and contains no implementation.
# Parts that a tree does not have (solutions/, tests/) are left out.

# Sets RESULT to the files of an implementation in BASE (labs/FOLDER or solutions/FOLDER); empty if
# there are none.
function(carlo_lab_sources result base name)
  file(GLOB steps CONFIGURE_DEPENDS "${base}/steps/*.cpp")
  if(NOT steps AND EXISTS "${base}/${name}.cpp")
    set(steps "${base}/${name}.cpp")
  endif()
  set(${result} "${steps}" PARENT_SCOPE)
endfunction()

# Sets RESULT to the target name that a lab building on lab NUMBER links: the solution if the tree
# has it, so that a broken earlier lab breaks no later one; the student's own code otherwise, or if
# MY_LABS lists the number.
set(MY_LABS "" CACHE STRING "Earlier labs of which your own code is used, such as \"06;07\"")
function(carlo_earlier_lab result number)
  if(TARGET lab${number}_code_solution AND NOT number IN_LIST MY_LABS)
    set(${result} lab${number}_code_solution PARENT_SCOPE)
  else()
    set(${result} lab${number}_code PARENT_SCOPE)
  endif()
endfunction()

# Adds one implementation: the object library TARGET from the files SOURCES (a list in one
# argument). Our own code gets strict warnings, but does not pass them on to a student's later lab
# that links it.
function(carlo_lab_implementation target folder sources)
  set(uses ${ARGN})
  add_library(${target} OBJECT ${sources})
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/labs/${folder}"
                             "${PROJECT_SOURCE_DIR}/common")
  if(carlo::strict IN_LIST uses)
    list(REMOVE_ITEM uses carlo::strict)
    target_link_libraries(${target} PRIVATE carlo::strict)
  endif()
  target_link_libraries(${target} PUBLIC carlo::build carlo::missing_return ${uses})
  if(NOT CARLO_SANITIZE)
    # A function that ends without returning its value reports the line
    # (common/course/guide/missing_return.cpp).
    target_compile_options(${target} PRIVATE -fsanitize=return)
  endif()
endfunction()

# The same for a worker.
function(carlo_lab_judged_implementation target folder sources)
  carlo_lab_implementation(${target} ${folder} "${sources}" ${ARGN})
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  target_compile_options(${target} PRIVATE -ftrivial-auto-var-init=pattern)
  if(CARLO_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Both together make GCC report uninitialised values in fmt. The same code is compiled for the
    # lab's own program without the pattern and with this warning.
    target_compile_options(${target} PRIVATE -Wno-uninitialized)
  endif()
endfunction()

# Compiles PREFIX_PART from SOURCES once, to be linked with every implementation.
function(carlo_lab_part target folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(${target} OBJECT ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/labs/${folder}"
                             "${PROJECT_SOURCE_DIR}/common")
  target_link_libraries(${target} PUBLIC carlo::build ${ARG_DEPENDS} PRIVATE carlo::strict)
endfunction()

# Links one part and one implementation into an executable.
function(carlo_lab_program target part implementation)
  add_executable(${target})
  target_link_libraries(${target} PRIVATE ${part} ${implementation} carlo::build)
endfunction()

# Well over a hundred small programs: one build type is enough.
option(CARLO_MISTAKES "Build the labs' typical mistakes and variants and test how each is judged" ON)

# The mistakes of a lab (KIND "mistake") or its variants ("variant"), in the global property
# lab01_mistakes or lab01_variants: a list of lines as tests/grader/mistakes.awk lists them, from
# tests/FOLDER/mistakes/*.txt and tests/FOLDER/variants.txt. CMake runs again if the list changes, not
# after other changes of a table.
function(carlo_lab_mistaken lab folder kind)
  set(at "${PROJECT_SOURCE_DIR}/tests/${folder}/${kind}s")
  file(GLOB tables CONFIGURE_DEPENDS "${at}.txt" "${at}/*.txt")
  set(lines "")
  if(tables)
    set(reader "${PROJECT_SOURCE_DIR}/tests/grader/mistakes.awk")
    set(list "${CMAKE_BINARY_DIR}/bin/${lab}_${kind}s.tsv")
    file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
    execute_process(COMMAND "${reader}" list "${list}" ${tables} RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
      message(FATAL_ERROR "tests/${folder}: its ${kind}s cannot be read")
    endif()
    add_custom_command(OUTPUT "${list}" COMMAND "${reader}" list "${list}" ${tables}
                       DEPENDS "${reader}" ${tables} COMMENT "Listing the ${kind}s of lab ${folder}" VERBATIM)
    # A target of its own: its dependencies are built before its files, here before CMake runs.
    add_custom_target(${lab}_${kind}s_listed DEPENDS "${list}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${list}")
    file(STRINGS "${list}" lines ENCODING UTF-8)
  endif()
  set_property(GLOBAL PROPERTY ${lab}_${kind}s "${lines}")
endfunction()

# One step of the build for each table: it writes those solutions with mistakes that have changed. It
# fails if a change no longer fits the solution.
function(carlo_lab_put_mistakes folder kind lines)
  set(reader "${PROJECT_SOURCE_DIR}/tests/grader/mistakes.awk")
  set(themes "")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([^\t]+)\t([^\t]+)\t([^\t]+)" line "${line}")
    cmake_path(GET CMAKE_MATCH_3 STEM theme)
    list(APPEND themes ${theme})
    set(table_${theme} "${CMAKE_MATCH_3}")
    string(REPLACE "solutions/${folder}/" "${CMAKE_MATCH_2}/" file "${CMAKE_MATCH_1}")
    list(APPEND files_${theme} "${CMAKE_CURRENT_BINARY_DIR}/${kind}s/${folder}/${file}")
    list(APPEND solutions_${theme} "${PROJECT_SOURCE_DIR}/${CMAKE_MATCH_1}")
  endforeach()
  list(REMOVE_DUPLICATES themes)
  foreach(theme IN LISTS themes)
    list(REMOVE_DUPLICATES solutions_${theme})
    add_custom_command(
      OUTPUT ${files_${theme}}
      COMMAND "${reader}" put_all "${CMAKE_CURRENT_BINARY_DIR}/${kind}s/${folder}" "${table_${theme}}"
      DEPENDS "${reader}" "${table_${theme}}" ${solutions_${theme}}
      COMMENT "Putting ${kind}s into lab ${folder}: ${theme}" VERBATIM)
  endforeach()
endfunction()

# Precompiles the headers that the files `sources` of an implementation include, once for all
# similar files.
function(carlo_lab_headers_once target name sources)
  set(headers "<${name}.h>")
  foreach(source IN LISTS sources)
    file(STRINGS "${source}" lines REGEX "^#include ")
    list(TRANSFORM lines REPLACE "^#include [<\"]([^>\"]*)[>\"].*" "<\\1>")
    list(APPEND headers ${lines})
  endforeach()
  list(REMOVE_DUPLICATES headers)
  target_precompile_headers(${target} PRIVATE ${headers})
  carlo_header_for_all(${target})
endfunction()

# The worker of one mistake or variant, lab01_worker_KIND_<name>. The other files of a lab in steps come
# from the archive `others`, of which the linker leaves out the file that is there already.
function(carlo_lab_mistaken_worker lab folder kind line others)
  string(REGEX MATCH "^solutions/${folder}/([^\t]+)\t([^\t]+)" line "${line}")
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${kind}s/${folder}/${CMAKE_MATCH_2}/${CMAKE_MATCH_1}")
  set(worker ${lab}_worker_${kind}_${CMAKE_MATCH_2})
  carlo_lab_judged_implementation(${worker}_code ${folder} "${file}" ${ARGN})
  target_precompile_headers(${worker}_code REUSE_FROM ${lab}_worker_code_solution)
  target_compile_options(${worker}_code PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  # Hundreds of files: -O1, except in lab 2, where exercise 2.5 judges speed. GCC 13 and later refuse, below
  # -O2, the header that was precompiled at -O3.
  if(NOT lab STREQUAL "lab02")
    set(level -O1)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
      set(level -O2)
    endif()
    target_compile_options(${worker}_code PRIVATE $<$<CONFIG:Release>:${level}>)
  endif()
  carlo_lab_program(${worker} ${lab}_probes ${worker}_code)
  target_link_libraries(${worker} PRIVATE ${others})
  if(CARLO_GOLD)
    # Not mold 1.10, although it is a little faster: about one link in several thousand never ended,
    # in its allocator, and one program in about 500 could not start.
    target_link_options(${worker} PRIVATE -fuse-ld=gold)
  endif()
  add_dependencies(${lab}_${kind}s ${worker})
endfunction()

# The workers of all mistakes and variants of a lab, and the targets lab01_mistakes and lab01_variants
# for all of a kind.
function(carlo_lab_mistaken_workers lab folder name)
  foreach(kind IN ITEMS mistake variant)
    add_custom_target(${lab}_${kind}s)
    carlo_lab_mistaken(${lab} ${folder} ${kind})
    get_property(${kind}s GLOBAL PROPERTY ${lab}_${kind}s)
  endforeach()
  if(NOT mistakes AND NOT variants)
    return()
  endif()
  find_program(CARLO_GOLD ld.gold)
  carlo_lab_sources(solution "${PROJECT_SOURCE_DIR}/solutions/${folder}" ${name})
  carlo_lab_headers_once(${lab}_worker_code_solution ${name} "${solution}")
  set(others "")
  if(EXISTS "${PROJECT_SOURCE_DIR}/solutions/${folder}/steps")
    set(others ${lab}_worker_archive_solution)
    add_library(${others} STATIC $<TARGET_OBJECTS:${lab}_worker_code_solution>)
  endif()
  foreach(kind IN ITEMS mistake variant)
    carlo_lab_put_mistakes(${folder} ${kind} "${${kind}s}")
    foreach(line IN LISTS ${kind}s)
      carlo_lab_mistaken_worker(${lab} ${folder} ${kind} "${line}" "${others}" ${ARGN})
    endforeach()
  endforeach()
endfunction()

function(add_lab folder name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;EXPERIMENTS" ${ARGN})
  string(REGEX MATCH "^[0-9][0-9]" number "${folder}")
  set(lab lab${number})
  set(here "${PROJECT_SOURCE_DIR}/labs/${folder}")
  set(tests "${PROJECT_SOURCE_DIR}/tests/${folder}")
  carlo_lab_sources(student "${here}" ${name})
  carlo_lab_sources(solution "${PROJECT_SOURCE_DIR}/solutions/${folder}" ${name})
  set(uses carlo::random carlo::stats ${ARG_DEPENDS})
  file(GLOB given CONFIGURE_DEPENDS "${here}/given/*.cpp")
  if(given)
    add_library(${lab}_given STATIC ${given})
    target_include_directories(${lab}_given PUBLIC "${here}")
    target_link_libraries(${lab}_given PUBLIC carlo::build ${uses} PRIVATE carlo::strict)
    list(APPEND uses ${lab}_given)
  endif()

  # A student's file gets the warnings but builds despite them; ours does not. Parameters of
  # unwritten exercises are unused.
  carlo_lab_implementation(${lab}_code ${folder} "${student}" ${uses})
  set(students_warnings -Wall -Wextra -Wpedantic -Wno-unused-parameter)
  target_compile_options(${lab}_code PRIVATE ${students_warnings})
  set_target_properties(${lab}_code PROPERTIES CXX_COMPILER_LAUNCHER "${CARLO_OWN_LAUNCHER}")
  set(implementations "${lab}_code")
  if(solution)
    carlo_lab_implementation(${lab}_code_solution ${folder} "${solution}" ${uses} carlo::strict)
    list(APPEND implementations ${lab}_code_solution)
  endif()

  file(GLOB experiments CONFIGURE_DEPENDS "${here}/*.cpp")
  list(REMOVE_ITEM experiments ${student})
  if(experiments)
    carlo_lab_part(${lab}_experiments ${folder} SOURCES ${experiments}
                   DEPENDS ${uses} ${ARG_EXPERIMENTS} carlo::cli carlo::course carlo::stats
                           carlo::report)
    # The last that a student waits for: in two files where there are many, for two processors.
    set_target_properties(${lab}_experiments PROPERTIES UNITY_BUILD_BATCH_SIZE 8)
    file(GLOB web_files CONFIGURE_DEPENDS "${here}/*.css")
    if(web_files)
      carlo_embed(${lab}_experiments ${web_files})
    endif()
    foreach(code IN LISTS implementations)
      string(REPLACE "_code" "" program "${code}")
      carlo_lab_program(${program} ${lab}_experiments ${code})
    endforeach()
  endif()

  file(GLOB probes CONFIGURE_DEPENDS "${tests}/probes*.cpp")
  if(probes)
    carlo_lab_part(${lab}_probes ${folder} SOURCES ${probes}
                   DEPENDS ${uses} carlo::grader_worker)
    # Lab 1's programs compute little, and everybody's first verdict waits for their compilation.
    if(number STREQUAL "01")
      target_link_libraries(${lab}_probes PRIVATE carlo::unhurried)
    endif()
    carlo_lab_judged_implementation(${lab}_worker_code ${folder} "${student}" ${uses})
    target_compile_options(${lab}_worker_code PRIVATE ${students_warnings})
    set_target_properties(${lab}_worker_code PROPERTIES
                          CXX_COMPILER_LAUNCHER "${CARLO_OWN_LAUNCHER}")
    carlo_lab_program(${lab}_worker ${lab}_probes ${lab}_worker_code)
    if(solution)
      carlo_lab_judged_implementation(${lab}_worker_code_solution ${folder} "${solution}" ${uses}
                                      carlo::strict)
      carlo_lab_program(${lab}_worker_solution ${lab}_probes ${lab}_worker_code_solution)
    endif()
    if(solution AND CARLO_MISTAKES)
      carlo_lab_mistaken_workers(${lab} ${folder} ${name} ${uses})
    endif()
  endif()

  file(GLOB checks CONFIGURE_DEPENDS "${tests}/checks*.cpp")
  if(checks)
    add_executable(${lab}_judge ${checks})
    # The judges of these labs compute expected values from millions of samples of their own.
    set(pace carlo::unhurried)
    if(lab MATCHES "^lab0[2578]$")
      set(pace carlo::grading)
    endif()
    target_link_libraries(${lab}_judge PRIVATE carlo::grader_judge ${pace} carlo::strict)
    # These time a loop of their own, with which an exercise is compared: as fast as it would be in the
    # worker. Otherwise code that is slower by that much would pass.
    set(timing ${checks})
    list(FILTER timing INCLUDE REGEX "/checks_fast\\.cpp$")
    if(timing)
      set_source_files_properties(${timing} TARGET_DIRECTORY ${lab}_judge
                                  PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
    endif()
  endif()
endfunction()
