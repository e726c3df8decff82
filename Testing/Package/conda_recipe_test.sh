#!/usr/bin/env bash
# The conda recipe without conda: its build script builds and installs with this machine's libraries, and its test
# commands run on what was installed. Names of conda's packages are not tested.
# usage: conda_recipe_test.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")
recipe=$source/Applications/container/conda
work=$build/package-test/conda
fail() { echo "conda_recipe_test.sh: $1" >&2; exit 1; }
rm -rf "$work"
mkdir -p "$work"
# conda build stands in the sources, too.
trap 'rm -rf "$source/build-conda"' EXIT
cd "$source"
version=$(sed -n 's/^project(VoxelCore VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
grep -q "set version = \"$version\"" "$recipe/meta.yaml" || fail "meta.yaml is not of version $version"
SRC_DIR=$source PREFIX=$work/prefix PYTHON=/usr/bin/python3 SP_DIR=$work/prefix/lib/python3.11/site-packages \
  CPU_COUNT=2 CMAKE_ARGS=-DVOXELCORE_WERROR=ON bash "$recipe/build.sh" >"$work/build.log" 2>&1 ||
  { tail -n 30 "$work/build.log" >&2; fail "no build"; }
cd "$work"
export PATH=$work/prefix/bin:/usr/bin:/bin PYTHONPATH=$work/prefix/lib/python3.11/site-packages
/usr/bin/python3 -c "import voxelcore; assert voxelcore.__file__.startswith('$work/prefix'), voxelcore.__file__"
commands=$(sed -n '/^  commands:/,/^$/s/^    - //p' "$recipe/meta.yaml")
[ "$(wc -l <<<"$commands")" = 4 ] || fail "which test commands? $commands"
bash -euo pipefail -c "$commands" || fail "a test command fails"
echo "conda recipe: works"
