# One thread: ../include/omp.h stands for OpenMP, whose pragmas are passed over.
add_library(OpenMP::OpenMP_CXX INTERFACE IMPORTED)
target_include_directories(OpenMP::OpenMP_CXX INTERFACE "${CMAKE_CURRENT_LIST_DIR}/../include")
target_compile_options(OpenMP::OpenMP_CXX INTERFACE -Wno-unknown-pragmas)
set(OpenMP_FOUND ON)
