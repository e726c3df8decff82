#!/usr/bin/env bash
# Builds the program for a system: one file that needs nothing else there.
# usage: build.sh SYSTEM [FOLDER]     SYSTEM: linux-x86_64, linux-arm64, windows-x86_64 or wasm; FOLDER: where to build
# (build-SYSTEM). FOLDER/program/bin has the program; but for wasm, FOLDER/voxelcore-VERSION-SYSTEM.tar.gz, for Windows
# .zip, has it with the licences of all that is in it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_folder=$(cd "$here/../.." && pwd)
system=${1:?"give a system: linux-x86_64, linux-arm64, windows-x86_64 or wasm"}
# shellcheck source=toolchain.sh
source "$here/toolchain.sh"
mkdir -p "${2:-build-$system}"
build=$(cd "${2:-build-$system}" && pwd)
[ "$system" = wasm ] || true

bash "$here/libraries.sh" "$system" "$build/libraries"
# Of what libtiff and Blosc need of the others a linker that reads in order finds nothing before them.
"${configure[@]}" -S "$source_folder" -B "$build/program" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="${flags[*]} -isystem $build/libraries/include -ffile-prefix-map=$source_folder=." \
  -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -DCMAKE_EXE_LINKER_FLAGS="${link_flags[*]}" \
  -DCMAKE_CXX_STANDARD_LIBRARIES="-L$build/libraries/lib -llz4 -lzstd -ljpeg -lz" \
  -DCMAKE_FIND_ROOT_PATH="$build/libraries" -DCMAKE_PREFIX_PATH=/ -DCMAKE_MODULE_PATH="$module_path" \
  -DBoost_INCLUDE_DIR="$build/libraries/include" \
  -DBUILD_TESTING=OFF -DVOXELCORE_INSTALL=OFF -DVOXELCORE_ITK=OFF -DVOXELCORE_VTK=OFF -DVOXELCORE_TETGEN=OFF \
  -DVOXELCORE_PYTHON=OFF >"$build/configure.log" || { cat "$build/configure.log" >&2; exit 1; }
cmake --build "$build/program" --target voxelcore
