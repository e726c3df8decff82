#!/usr/bin/env bash
# A program built without VTK's rendering says in one line what is off, writes nothing for it, and does all else.
# usage: no_display_test.sh BUILD_DIR [CMAKE_OPTION...]
set -euo pipefail

build=$(realpath "$1")
shift
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/no-display
fail() {
  echo "no_display_test.sh: $1" >&2
  exit 1
}

mkdir -p "$scratch"
cmake -S "$source" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DVOXELCORE_WERROR=ON \
  -DVOXELCORE_DISPLAY=OFF "$@" >"$scratch/configure.log" 2>&1 ||
    { cat "$scratch/configure.log" >&2; fail "cannot be configured"; }
cmake --build "$scratch/build" --target voxelcore
program=$scratch/build/bin/voxelcore
! ldd "$program" | grep -E 'libvtkRendering|libX11|libGL' || fail "it is linked with rendering"

rm -rf "$scratch/work"
mkdir "$scratch/work"
cd "$scratch/work"
"$program" phantom torus --size 24 -o t.nrrd -q
"$program" core t.nrrd -o t.vtp --with-skeleton -q
refused() {
  local code=0
  "$@" >said 2>complaint || code=$?
  [ "$code" = 2 ] || fail "$* ended with $code"
  [ "$(wc -l <complaint)" = 1 ] && [ ! -s said ] || { cat said complaint >&2; fail "$* did not say one line"; }
  grep -q 'off in this build' complaint || { cat complaint >&2; fail "$* does not say why"; }
}
refused "$program" core t.nrrd -o page.vtp --html page.html
refused "$program" core t.nrrd -o scene.vtp --scene scene.mrml
refused "$program" batch t.nrrd -o cohort --html
refused "$program" render t.vtp -o t.png
[ "$(ls | sort | tr '\n' ' ')" = "complaint said t.nrrd t.vtp t_skeleton.vtp " ] || fail "files were left: $(ls)"
echo "without display: works"
