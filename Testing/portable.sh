#!/usr/bin/env bash
# Builds the modules up to Imaging, and their tests, without a call that only Linux knows, and runs the tests. With
# `clang` that compiler is asked for every narrowing, of 64 bits to 32 too, and each is an error.
# usage: portable.sh gcc|clang BUILD_DIR    exit 77: the compiler is not installed
set -euo pipefail

compiler=$1
build=$2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
modules="Base;Lattice;Complex;Shape;Delaunay;VoxelCore;Refinement;Skeleton;Verification;Certified"
modules+=";Labels;Masks;Formats;ItkReader;Imaging;Blocks;Meshes;Phantom;Thickness;Sheets;Roots"
options=()
grep -qF "MODULES: $modules" "$source/.github/workflows/build.yml" ||
  { echo "portable.sh: .github/workflows/build.yml builds other modules" >&2; exit 1; }
if [ "$compiler" = clang ]; then
  command -v clang++ >/dev/null || { echo "portable.sh: clang is not installed" >&2; exit 77; }
  options=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wconversion -Wno-sign-conversion -Wshorten-64-to-32")
fi
fail() {
  echo "portable.sh: $1" >&2
  exit 1
}

cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON -DVOXELCORE_WERROR=ON \
  -DVOXELCORE_PORTABLE=ON -DVOXELCORE_ITK=OFF -DVOXELCORE_VTK=OFF -DVOXELCORE_PYTHON=OFF -DVOXELCORE_INSTALL=OFF \
  -DVOXELCORE_MODULES="$modules" "${options[@]}" >"$build.log" 2>&1 ||
  { cat "$build.log" >&2; fail "cannot configure"; }
cmake --build "$build"

# The libraries ask the system for nothing but what the C and C++ libraries of every system have.
only='open|openat|close|read|write|lseek|fstat|stat|pipe|pipe2|fork|vfork|posix_spawn|waitpid|kill|prctl|flock|madvise'
only+='|mmap|posix_fadvise|fallocate|gethostname|getpid|sysconf|socketpair|send|dladdr|getrusage|setrlimit|mallopt'
for module in ${modules//;/ }; do
  library=$(ls "$build"/Modules/*/"$module/libVoxelCore$module.a")
  [ "$module" != Imaging ] || continue
  found=$(nm -u "$library" 2>/dev/null | awk '{ print $2 }' | grep -xE "($only)(64)?" | sort -u || true)
  [ -z "$found" ] || fail "$module calls $(echo $found)"
  ! grep -q '/proc/' "$library" || fail "$module names /proc"
done

# Left out: files of TIFF are not written here, not even by tests of every format; a killed process' files are not told
# from a living one's; what is read through ITK is refused; of long rows more is read than is needed.
left='^(TemporaryNames|OutputStream|Layers|Mirrors|Style)\.|Tiff|TIFF|Itk|Dicom'
left+='|^(VolumeWriters|WriteLabelVolume)\.EveryFormat|^WriteLabelVolume\.AFullDisk|^Crop\.OfLongRows'
left+='|^SystemCalls\.BetweenPieces'
ctest --test-dir "$build" -LE "heavy|sanitizer|package" -j "$(nproc)" --output-on-failure --no-tests=error \
  -E "$left" </dev/null
