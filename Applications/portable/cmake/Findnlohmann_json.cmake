# Headers alone, as of FindCLI11.cmake.
add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
set(nlohmann_json_FOUND ON)
