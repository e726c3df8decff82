#!/usr/bin/env bash
# What conda build runs: variables are its own.
set -euo pipefail
read -r -a options <<<"${CMAKE_ARGS:-}"
cmake "${options[@]}" -S "$SRC_DIR" -B build-conda -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PREFIX" \
  -DCMAKE_INSTALL_PREFIX="$PREFIX" -DPython_EXECUTABLE="$PYTHON" \
  -DVOXELCORE_PYTHON_DIR="${SP_DIR#"$PREFIX"/}" \
  -DBUILD_TESTING=OFF -DVOXELCORE_TETGEN=OFF -DVOXELCORE_ITK=OFF -DVOXELCORE_DISPLAY=OFF
cmake --build build-conda --parallel "${CPU_COUNT:-2}"
cmake --install build-conda
