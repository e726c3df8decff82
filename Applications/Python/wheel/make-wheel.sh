#!/usr/bin/env bash
# Makes a wheel for each Python: builds the extension, brings along what a Linux may lack, names the oldest C library it
# runs with.
# usage: make-wheel.sh FOLDER [PYTHON...]     needs no network but for Debian's packages
# Without PYTHON: for each version from 3.9 on that is on the path with its headers. pybind11 must know it: Debian 12's
# ends at 3.11.
# The same sources give the same bytes. SOURCE_DATE_EPOCH is kept where it is set.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: make-wheel.sh FOLDER [PYTHON...]" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
bash "$here/../install-packages.sh" wheel
[ $# -gt 0 ] || set -- /usr/bin/python3 python3.{9..20}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A copy, so that nothing of another build gets in, and paths are those of no machine.
mkdir "$work/source"
cp -r "$here/../../CMakeLists.txt" "$here/../../LICENSE" "$here/../../Modules" "$(dirname "$here")" "$work/source/"
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-315532800}
# The compiler's cache knows the sources again though this copy lies elsewhere each time; so does the wheel.
export CCACHE_BASEDIR=$work CCACHE_NOHASHDIR=1
export CFLAGS="${CFLAGS:-} -ffile-prefix-map=$work=." CXXFLAGS="${CXXFLAGS:-} -ffile-prefix-map=$work=."
made=()
for python in "$@"; do
  tag=$("$python" -c 'import os, sys, sysconfig
assert os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h"))
print(f"cp{sys.version_info[0]}{sys.version_info[1]}")' 2>/dev/null) || continue
  [[ " ${made[*]} " != *" $tag "* ]] || continue
  made+=("$tag")
  "$python" "$work/source/Applications/Python/wheel/backend.py" "$work"
  /usr/bin/python3 "$here/wheel/portable_wheel.py" "$work"/voxelcore-*-"$tag"-*.whl -o "$folder"
done
[ ${#made[@]} -gt 0 ] || { echo "make-wheel.sh: none of these is a Python with its headers: $*" >&2; exit 1; }
