# cmake -DJUDGE= -DLAB= -DWORKER= -DMISTAKE= -DPAGE= -P expect_page.cmake
# Judges a worker with a typical mistake and looks for the words on its page that name it.
set(exercise_uniform_angle 7.3)
set(words_uniform_angle "theta itself is uniform" "Directions at each angle to the axis")
set(exercise_cosine_pdf_missing_pi 7.4)
set(words_cosine_pdf_missing_pi "the cosine integrates to pi" "each is 3.1416 .pi. times what is expected")

file(REMOVE "${PAGE}")
execute_process(COMMAND "${JUDGE}" --lab "${LAB}" --worker "${WORKER}" --failure-page "${PAGE}"
                        --exercise ${exercise_${MISTAKE}} --seed 3
                OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT EXISTS "${PAGE}")
  message(FATAL_ERROR "the judge wrote no page:\n${output}")
endif()
if(NOT output MATCHES "The page with the pictures: [^\n]*${MISTAKE}.html\n$")
  message(FATAL_ERROR "the last line does not tell where the page is:\n${output}")
endif()
file(READ "${PAGE}" page)
foreach(words IN LISTS words_${MISTAKE} ITEMS "<svg" "./carlo hint ${exercise_${MISTAKE}}")
  if(NOT page MATCHES "${words}")
    message(FATAL_ERROR "the page does not say \"${words}\"")
  endif()
endforeach()
