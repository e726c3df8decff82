# ../include/openssl/evp.h stands for libcrypto.
find_library(VOXELCORE_LIBMD md REQUIRED)
add_library(OpenSSL::Crypto INTERFACE IMPORTED)
target_include_directories(OpenSSL::Crypto INTERFACE "${CMAKE_CURRENT_LIST_DIR}/../include")
target_link_libraries(OpenSSL::Crypto INTERFACE "${VOXELCORE_LIBMD}")
set(OpenSSL_FOUND ON)
