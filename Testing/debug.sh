#!/usr/bin/env bash
# Builds without optimization, with assertions and the library's checks, in a folder of its own. With targets it builds
# those; without, everything, and runs the tests that run by default. Non-zero when one fails.
# usage: debug.sh BUILD_DIR [TARGET...]
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$1
shift

# The objects also hold what odr.sh compares; programs here are linked without it. Line numbers (-g1) are for it, too.
cmake -S "$source" -B "$build" -G Ninja -DBUILD_TESTING=ON -DVOXELCORE_UNITY=OFF \
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O0 -g1" \
  -DCMAKE_CXX_FLAGS="-D_GLIBCXX_ASSERTIONS -flto -ffat-lto-objects" -DCMAKE_EXE_LINKER_FLAGS=-fno-lto \
  -DCMAKE_SHARED_LINKER_FLAGS=-fno-lto -DCMAKE_MODULE_LINKER_FLAGS=-fno-lto >"$build.log" 2>&1 ||
    { cat "$build.log" >&2; exit 1; }
if [ $# -gt 0 ]; then
  nice cmake --build "$build" --target "$@"
  exit
fi
nice cmake --build "$build"
ctest --test-dir "$build" -LE "heavy|sanitizer|browser|package|cluster|fuzz|web" -j "$(nproc)" --timeout 3600 \
  --output-on-failure --no-tests=error </dev/null
