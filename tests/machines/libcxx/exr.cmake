# carlo::exr where LLVM's standard library meets an OpenImageIO built with GCC's (exr_boundary.h).
set(here "${PROJECT_SOURCE_DIR}/tests/machines/libcxx")
add_library(carlo_exr_there MODULE "${here}/exr_there.cpp" exr.cpp exr_header.cpp exr_window.cpp primaries.cpp
            ../support/atomic_file.cpp)
set_target_properties(carlo_exr_there PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON UNITY_BUILD OFF)
# After CMAKE_CXX_FLAGS, and so decisive.
target_compile_options(carlo_exr_there PRIVATE -stdlib=libstdc++ -DFMT_HEADER_ONLY)
target_link_options(carlo_exr_there PRIVATE -stdlib=libstdc++ -Wl,-Bsymbolic)
target_include_directories(carlo_exr_there PRIVATE "${PROJECT_SOURCE_DIR}/common" "${here}")
target_link_libraries(carlo_exr_there PRIVATE OpenImageIO::OpenImageIO glm::glm)

carlo_library(exr UNHURRIED SOURCES "${here}/exr_here.cpp" DEPENDS carlo::image)
target_compile_definitions(common_exr PRIVATE CARLO_EXR_LIBRARY="$<TARGET_FILE:carlo_exr_there>")
target_include_directories(common_exr PRIVATE "${here}")
target_link_libraries(common_exr PRIVATE ${CMAKE_DL_LIBS})
add_dependencies(common_exr carlo_exr_there)
