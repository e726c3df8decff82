# Headers alone; Debian's own file would name /usr/include, where the headers of another C library are.
add_library(CLI11::CLI11 INTERFACE IMPORTED)
set(CLI11_FOUND ON)
