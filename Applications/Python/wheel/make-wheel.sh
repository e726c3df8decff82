#!/usr/bin/env bash
# Makes the wheel: builds the extension, brings along what a Linux may lack, names the oldest C library it runs with.
# usage: make-wheel.sh FOLDER     needs no network but for Debian's packages
# The same sources give the same bytes. SOURCE_DATE_EPOCH is kept where it is set.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: make-wheel.sh FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
bash "$here/../install-packages.sh" wheel

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A copy, as pip and scikit-build leave folders of their own where setup.py lies.
mkdir "$work/source"
cp -r "$here/../../CMakeLists.txt" "$here/../../LICENSE" "$here/../../Modules" "$(dirname "$here")" "$work/source/"
cp "$work/source/LICENSE" "$work/source/Applications/Python/"
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-315532800}
# The compiler's cache knows the sources again though this copy lies elsewhere each time; so does the wheel.
export CCACHE_BASEDIR=$work CCACHE_NOHASHDIR=1
export CFLAGS="${CFLAGS:-} -ffile-prefix-map=$work=." CXXFLAGS="${CXXFLAGS:-} -ffile-prefix-map=$work=."
/usr/bin/python3 -m pip wheel --no-build-isolation --no-deps --no-index --quiet \
  --wheel-dir "$work" "$work/source/Applications/Python"
/usr/bin/python3 "$here/wheel/portable_wheel.py" "$work"/voxelcore-*.whl -o "$folder"
