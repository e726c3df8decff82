# The compiler's own; CMake's file would look for its library, which lies beside the compiler.
add_library(OpenMP::OpenMP_CXX INTERFACE IMPORTED)
target_compile_options(OpenMP::OpenMP_CXX INTERFACE -fopenmp)
target_link_options(OpenMP::OpenMP_CXX INTERFACE -fopenmp)
set(OpenMP_FOUND ON)
