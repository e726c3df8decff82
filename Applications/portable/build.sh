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
[ "$system" = wasm ] || bash "$here/../install-packages.sh" portable

bash "$here/libraries.sh" "$system" "$build/libraries"
# A linker that reads in order finds here what libtiff and Blosc need of the others, and the cube root before that of
# the C library.
libraries="-L$build/libraries/lib -llz4 -lzstd -ljpeg -lz${foreign_math:+ -lcbrt}"
"${configure[@]}" -S "$source_folder" -B "$build/program" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="${flags[*]} -isystem $build/libraries/include -ffile-prefix-map=$source_folder=." \
  -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -DCMAKE_EXE_LINKER_FLAGS="${link_flags[*]}" \
  -DCMAKE_CXX_STANDARD_LIBRARIES="$libraries" \
  -DCMAKE_FIND_ROOT_PATH="$build/libraries" -DCMAKE_PREFIX_PATH=/ -DCMAKE_MODULE_PATH="$module_path" \
  -DBoost_INCLUDE_DIR="$build/libraries/include" \
  -DBUILD_TESTING=OFF -DVOXELCORE_INSTALL=OFF -DVOXELCORE_ITK=OFF -DVOXELCORE_VTK=OFF -DVOXELCORE_TETGEN=OFF \
  -DVOXELCORE_PYTHON=OFF >"$build/configure.log" || { cat "$build/configure.log" >&2; exit 1; }
cmake --build "$build/program" --target voxelcore
[ "$system" != wasm ] || exit 0

# The program and the licences of all that is in it, packed; the same sources give the same bits.
version=$(bash "$here/../release/version.sh")
name=voxelcore-$version-$system
epoch=${SOURCE_DATE_EPOCH:-315619200} # of 1980, where the times of a .zip begin
rm -rf "$build/$name" "$build/$name".*
mkdir -p "$build/$name"
cp "$build/program/bin/"voxelcore* "$source_folder/LICENSE" "$here/README.md" "$build/$name/"
bash "$here/contents.sh" "$build/$name" "$build/libraries" "${runtimes[@]}"
cd "$build"
find "$name" -exec touch -d "@$epoch" {} +
if [ "$system" = windows-x86_64 ]; then
  packed=$name.zip
  find "$name" -type f | LC_ALL=C sort | TZ=UTC zip -X -q -@ "$packed"
else
  packed=$name.tar.gz
  tar --sort=name --owner=0 --group=0 --numeric-owner -c "$name" | gzip -n -9 >"$packed"
fi
echo "$build/$packed: $(stat -c %s "$packed") bytes"
