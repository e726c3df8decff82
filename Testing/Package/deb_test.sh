#!/usr/bin/env bash
# Makes the Debian packages, unpacks them into an empty root, and runs the JHU atlas with what lies there.
# usage: deb_test.sh BUILD_DIR with-tetgen|without-tetgen [CMAKE_OPTION...]    exit 77: something needed is missing
# without-tetgen builds the program anew, apart.
set -euo pipefail

build=$(realpath "$1")
variant=$2
shift 2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/deb-$variant
atlas=/usr/share/mricron/templates/JHU-WhiteMatter-labels-2mm.nii.gz
fail() {
  echo "deb_test.sh: $1" >&2
  exit 1
}
command -v dpkg-shlibdeps >/dev/null || { echo "deb_test.sh: dpkg-dev is not installed" >&2; exit 77; }
[ -r "$atlas" ] || { echo "deb_test.sh: mricron-data is not installed" >&2; exit 77; }

rm -rf "$scratch"
mkdir -p "$scratch/root"
suffix=-tetgen
if [ "$variant" = without-tetgen ]; then
  suffix=
  cmake -S "$source" -B "$build/package-test/no-tetgen" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
    -DVOXELCORE_TETGEN=OFF "$@" >"$scratch/configure.log"
  build=$build/package-test/no-tetgen
  cmake --build "$build"
fi
(cd "$scratch" && cpack --config "$build/CPackConfig.cmake" -B "$scratch/out" >"$scratch/cpack.log" 2>&1) ||
  { cat "$scratch/cpack.log" >&2; fail "cpack failed"; }

for name in voxelcore libvoxelcore-dev python3-voxelcore; do
  file=$(echo "$scratch"/out/"$name$suffix"_*.deb)
  [ -e "$file" ] || fail "no package $name$suffix"
  depends=$(dpkg-deb -f "$file" Depends)
  case "$name" in
    libvoxelcore-dev) needs="libvtk9-dev libtiff-dev" ;;
    *) needs="libvtk9.1 libtiff6 libgomp1 libc6" ;;
  esac
  for need in $needs; do
    grep -qE "(^|[ ,])$need" <<<"$depends" || fail "$name does not depend on $need: $depends"
  done
  [ "$(grep -c 'libtet1' <<<"$depends")" = "$([ -n "$suffix" ] && echo 1 || echo 0)" ] ||
    fail "$name and TetGen: $depends"
  described=$(dpkg-deb -f "$file" Description)
  grep -qxF "Description: $(head -n 1 <<<"$described")" "$source/Applications/debian/control" &&
    ! grep -q '^  ' <<<"$described" || fail "$name is described otherwise than in debian/control: $described"
  dpkg -x "$file" "$scratch/root"
  said=$scratch/root/usr/share/doc/$name$suffix/copyright
  [ "$(grep -c 'under the AGPL-3 as a whole' "$said")" = "$([ -n "$suffix" ] && echo 1 || echo 0)" ] &&
    grep -q '^License: Apache-2.0' "$said" || fail "$name does not say its licence"
done

root=$scratch/root/usr
run() { env -i PATH=/usr/bin:/bin HOME=/nonexistent "$@"; }
run "$root/bin/voxelcore" --version
[ "$(run "$root/bin/voxelcore" --version | grep -c AGPL)" = "$([ -n "$suffix" ] && echo 1 || echo 0)" ] ||
  fail "the program does not say its licence"
run "$root/bin/voxelcore" core "$atlas" -o "$scratch/jhu.vtp" --report "$scratch/jhu.json"
[ -s "$scratch/jhu.vtp" ] || fail "no surface of the atlas"
! grep -q '"passed": false' "$scratch/jhu.json" || fail "a certificate failed"
run "$build/bin/voxelcore" core "$atlas" -o "$scratch/build.vtp" -q
cmp "$scratch/jhu.vtp" "$scratch/build.vtp"
{ printf '# vtk DataFile Version 3.0\nscan\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 3 3\nSPACING 1 1 2\n'
  printf 'ORIGIN 0 0 0\nPOINT_DATA 27\nSCALARS labels short 1\nLOOKUP_TABLE default\n'
  printf '4 %.0s' {1..27}; } > "$scratch/image.vtk"
run "$root/bin/voxelcore" info "$scratch/image.vtk" | grep -q "ITK's VTKImageIO" || fail "no reading through ITK"
[ -s "$root/share/man/man1/voxelcore-core.1" ] || [ -s "$root/share/man/man1/voxelcore-core.1.gz" ] || fail "no manual"
[ -s "$root/share/bash-completion/completions/voxelcore" ] || fail "no completion"
run PYTHONPATH="$root/lib/python3/dist-packages" /usr/bin/python3 -c "
import numpy, voxelcore
print(voxelcore.core(numpy.ones((9, 9, 3), bool)))"
! find "$scratch/root" -name '*gtest*' -o -name '*Benchmark*' | grep . || fail "tests are in the package"
echo "deb $variant: works"
