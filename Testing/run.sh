#!/usr/bin/env bash
# Installs what is missing, builds everything with warnings as errors, runs the tests. Non-zero when one fails.
# usage: run.sh [--heavy]    --heavy also runs the long tests, and all tests once more under sanitizers
# VOXELCORE_BUILD_DIR: where to build (build/). VOXELCORE_TEST_DATA: folder of foreign scans; tests that need it are
# skipped without it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

groups=(build python test)
leave_out=(-LE "heavy|sanitizer|browser|package|cluster|fuzz|web")
case "${1:-}" in
  "") ;;
  --heavy)
    leave_out=()
    groups+=(sanitizer analysis package browser web)
    ;;
  *) echo "run.sh: unknown option '$1'; there is --heavy" >&2; exit 2 ;;
esac

bash Applications/install-packages.sh "${groups[@]}"

build=${VOXELCORE_BUILD_DIR:-build}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON -DVOXELCORE_WERROR=ON
cmake --build "$build"
ctest --test-dir "$build" "${leave_out[@]}" -j "$(nproc)" --output-on-failure --no-tests=error </dev/null
