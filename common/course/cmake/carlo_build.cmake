# How every target is compiled. Targets link `carlo::build` (all code) and `carlo::strict`
# (warnings: our code, never a student's file).

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
# The grader links submissions in a sandbox with the build's own command. From CMake 3.27 on (Debian
# 13 has 3.31) that command writes a list of linked files into a folder that does not exist there.
set(CMAKE_LINK_DEPENDS_USE_LINKER OFF)

option(CARLO_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(CARLO_FUZZ "Let libFuzzer see what an input reaches (clang)" OFF)
# Warnings are errors for those who develop the suite. A student's or autograder's compiler may be
# newer than any we tried and warn of more; there they stay warnings.
set(in_development OFF)
if(EXISTS "${PROJECT_SOURCE_DIR}/.ci/run")
  set(in_development ON)
endif()
option(CARLO_WERROR "Treat warnings in Carlo's own code as errors" ${in_development})

find_program(CARLO_CCACHE ccache)
if(CARLO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # With the base folder, the cache finds what was compiled in any other tree. It makes the paths in
  # the compiler's messages relative, so it is not used for a student's files (CARLO_OWN_LAUNCHER).
  # Dependencies come from the compiler, and comments count (CCACHE_DEPEND): a precompiled header
  # checks its sources byte by byte, and one that the cache took for equal although a comment
  # differs would not match them. It is also faster, since no file is preprocessed twice. The
  # namespace separates entries that were stored under other rules.
  set(CMAKE_CXX_COMPILER_LAUNCHER env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}"
      CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1 CCACHE_PCH_EXTSUM=1
      CCACHE_NAMESPACE=carlo-depend "${CARLO_CCACHE}")
  set(CARLO_OWN_LAUNCHER "${CARLO_CCACHE}")
endif()

# Sets up the compiler cache for a precompiled header that other targets reuse (REUSE_FROM).
function(carlo_header_for_all target)
  if(CARLO_OWN_LAUNCHER)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${PROJECT_SOURCE_DIR}/common/course/cmake/compile_header.sh;${CARLO_CCACHE};${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# Files that a student edits, and files compiled once per instruction set, are never joined. OFF
# shows whether each file includes all that it uses (tests/nightly.sh, apart).
option(CARLO_UNITY "Compile the files of a target together" ON)
set(CMAKE_UNITY_BUILD ${CARLO_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 24)

add_library(carlo_build INTERFACE)
add_library(carlo::build ALIAS carlo_build)
target_compile_features(carlo_build INTERFACE cxx_std_20)
# No -ffast-math, and no silent contraction to FMA: the same source gives the same bits.
target_compile_options(carlo_build INTERFACE -ffp-contract=off -fno-math-errno)
# LLVM's standard library has std::jthread, which labs use, from version 20 on; before, it is
# experimental.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("#include <version>
#if defined(_LIBCPP_VERSION) && !defined(__cpp_lib_jthread)
#error
#endif
int main() {}" carlo_has_jthread)
if(NOT carlo_has_jthread)
  target_compile_options(carlo_build INTERFACE -fexperimental-library)
  target_link_options(carlo_build INTERFACE -fexperimental-library)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # The oldest machine we support has SSE4.2; faster kernels are chosen at run time.
  target_compile_options(carlo_build INTERFACE -march=x86-64-v2)
endif()
if(CARLO_SANITIZE)
  target_compile_options(carlo_build INTERFACE -fsanitize=address,undefined
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(carlo_build INTERFACE -fsanitize=address,undefined)
endif()
if(CARLO_FUZZ)
  target_compile_options(carlo_build INTERFACE -fsanitize=fuzzer-no-link
                         "-fsanitize-coverage-ignorelist=${PROJECT_SOURCE_DIR}/tests/fuzz/unseen.txt")
endif()

add_library(carlo_strict INTERFACE)
add_library(carlo::strict ALIAS carlo_strict)
target_compile_options(carlo_strict INTERFACE -Wall -Wextra -Wpedantic -Wconversion
                       $<$<BOOL:${CARLO_WERROR}>:-Werror>)
# In files that are compiled together, a local name may shadow a name of another file.
if(NOT CARLO_UNITY)
  target_compile_options(carlo_strict INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A class in a .cpp may hold another class local to that file; GCC mistakes it here for one of a
  # header.
  target_compile_options(carlo_strict INTERFACE -Wshadow=local -Wno-subobject-linkage)
endif()
if(CARLO_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC's manual: "tends to result in false positives" with sanitizers; it reports some in <regex>.
  target_compile_options(carlo_strict INTERFACE -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC changed its ABI for vectors of 32 bytes in version 4.6; that does not concern us.
  target_compile_options(carlo_strict INTERFACE -Wno-psabi)
endif()

# For code that mostly waits (most judges, tools, their tests): compiles faster than with -O1, and
# in half the time under sanitizers. Not for fuzzing, which calls these millions of times.
add_library(carlo_unhurried INTERFACE)
add_library(carlo::unhurried ALIAS carlo_unhurried)
# For code that a verdict waits for, because it computes as much as the code that it judges.
add_library(carlo_grading INTERFACE)
add_library(carlo::grading ALIAS carlo_grading)
if(NOT CARLO_FUZZ)
  target_compile_options(carlo_unhurried INTERFACE $<$<CONFIG:Release>:-Og> $<$<CONFIG:Debug>:-O0>)
  target_compile_options(carlo_grading INTERFACE $<$<CONFIG:Release>:-O1> $<$<CONFIG:Debug>:-O0>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CARLO_SANITIZE)
  # GCC's manual: this warning has false positives at -Og, which analyses less. Clang and the
  # sanitizer builds look for the same errors.
  target_compile_options(carlo_unhurried INTERFACE -Wno-maybe-uninitialized)
endif()

# carlo_library(NAME [IN folder] [UNHURRIED] SOURCES a.cpp ... DEPENDS carlo::x lib ... [PRIVATE_DEPENDS lib ...])
# One library for one folder of common/, known as carlo::NAME. Without SOURCES it is header-only. Without
# the folder, which a student's tree may lack, there is none.
function(carlo_library name)
  cmake_parse_arguments(ARG "UNHURRIED" "IN" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target common_${name})
  if(ARG_IN)
    if(NOT EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_IN}")
      return()
    endif()
    list(TRANSFORM ARG_SOURCES PREPEND "${ARG_IN}/")
  endif()
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/common")
    target_link_libraries(${target} PUBLIC carlo::build ${ARG_DEPENDS}
                          PRIVATE carlo::strict ${ARG_PRIVATE_DEPENDS})
    if(ARG_UNHURRIED)
      target_link_libraries(${target} PRIVATE carlo::unhurried)
    endif()
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE "${PROJECT_SOURCE_DIR}/common")
    target_link_libraries(${target} INTERFACE carlo::build ${ARG_DEPENDS})
  endif()
  add_library(carlo::${name} ALIAS ${target})
endfunction()

# carlo_embed(TARGET a.css b.js ...): embeds these files, as they are at build time, for the target's pages.
# a.css becomes std::string_view carlo::web::a_css(), to be declared where it is used.
function(carlo_embed target)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${target}_web_files.cpp")
  list(JOIN ARGN "," files)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DFILES=${files}"
            -P "${PROJECT_SOURCE_DIR}/common/course/cmake/embed.cmake"
    DEPENDS ${ARGN} "${PROJECT_SOURCE_DIR}/common/course/cmake/embed.cmake"
    COMMENT "Embedding the files of ${target}'s pages" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
