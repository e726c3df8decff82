#!/usr/bin/env bash
# Modules/Scans/ITK as a module of ITK: configured and built as an external module against Debian's ITK and what
# Package.install has installed; its tests in ITK's own form and its example pass. Debian's package leaves out the
# macros by which modules are built: they come from its source package, into a folder of this test.
# usage: itk_module_test.sh BUILD_DIR [CMAKE_OPTION...]    exit 77: it cannot be done here, with the reason
# VOXELCORE_DEBIAN_MIRROR: another mirror
set -euo pipefail

build=$(realpath "$1")
shift
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/itk-module
installed=$build/package-test/moved/second
mirror=${VOXELCORE_DEBIAN_MIRROR:-http://deb.debian.org/debian}
fail() {
  echo "itk_module_test.sh: $1" >&2
  exit 1
}
skip() {
  echo "itk_module_test.sh: $1" >&2
  exit 77
}
[ -d "$installed" ] || fail "the test 'install' has not run"
[ -e /usr/lib/cmake/ITK-5.2/ITKConfig.cmake ] || skip "Debian 12's libinsighttoolkit5-dev is not installed"

rm -rf "$scratch"
mkdir -p "$scratch/itk/lib/cmake"
# The source package has 283 MB, and is not downloaded again.
macros=$build/package-test/itk-macros
if [ ! -e "$macros/complete" ]; then
  rm -rf "$macros"
  mkdir -p "$macros"/{lists/partial,cache/archives/partial,source}
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror bookworm main" >"$macros/list"
  apt=(apt-get -q -o "Dir::Etc::SourceList=$macros/list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$macros/lists" -o "Dir::Cache=$macros/cache" -o APT::Sandbox::User=root)
  (cd "$macros" && "${apt[@]}" update && "${apt[@]}" source --download-only insighttoolkit5) \
    >"$scratch/apt.log" 2>&1 || skip "no source package of ITK: $(tail -n 1 "$scratch/apt.log")"
  tar -xf "$macros"/insighttoolkit5_*.orig.tar.* -C "$macros/source" --strip-components 1 --wildcards \
    --no-wildcards-match-slash '*/CMake/*' '*/Utilities/Maintenance/BuildHeaderTest.py' \
    '*/Utilities/Doxygen/mcdoc.py'
  rm -rf "$macros"/{insighttoolkit5_*,lists,cache}
  touch "$macros/complete"
fi

# An ITK_DIR that looks like a folder in which ITK was built.
itk=$scratch/itk/lib/cmake/ITK-5.2
cp -r "$macros/source/CMake" "$itk"
cp -r "$macros/source/Utilities" "$scratch/itk/lib/cmake"
cp -r /usr/lib/cmake/ITK-5.2/. "$itk"
ln -s /usr/include "$scratch/itk/include"
ln -s /usr/bin "$scratch/itk/bin"
mkdir -p "$itk/lib/cmake/ITK-5.2"
ln -s "$itk/Modules" "$itk/lib/cmake/ITK-5.2/Modules"
for library in /usr/lib/libITK*.so* /usr/lib/libitk*.so*; do
  [ ! -e "$library" ] || ln -s "$library" "$scratch/itk/lib/"
done

# ITK's own checks of style are downloaded; ours are those of the house.
cmake -S "$source/Modules/Scans/ITK" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DITK_DIR="$itk" \
  -DCMAKE_PREFIX_PATH="$installed" -DBUILD_TESTING=ON -DITK_USE_KWSTYLE=OFF -DITK_USE_CLANGFORMAT=OFF \
  -DITK_USE_CLANG_FORMAT=OFF "$@" >"$scratch/configure.log" 2>&1 ||
  { tail -n 30 "$scratch/configure.log" >&2; fail "ITK does not take it as a module"; }
cmake --build "$scratch/build" >"$scratch/build.log" 2>&1 ||
  { tail -n 30 "$scratch/build.log" >&2; fail "the module cannot be built"; }
ctest --test-dir "$scratch/build" --output-on-failure --no-tests=error
# Three of its own, and ITK's own that each class is in the module's group.
[ "$(ctest --test-dir "$scratch/build" -N | sed -n 's/^Total Tests: //p')" = 4 ] ||
  fail "these are not all of its tests"
[ -x "$scratch/build/VoxelCoreHeaderTest1" ] || [ -n "$(find "$scratch" -name VoxelCoreHeaderTest1 -type f)" ] ||
  fail "its headers were not compiled each by itself"

cmake -S "$source/Modules/Scans/ITK/examples" -B "$scratch/example" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DITK_DIR="$itk" -DCMAKE_PREFIX_PATH="$installed" "$@" >"$scratch/example.log" 2>&1 ||
  { tail -n 30 "$scratch/example.log" >&2; fail "a project does not find the module"; }
cmake --build "$scratch/example" >>"$scratch/example.log" 2>&1 ||
  { tail -n 30 "$scratch/example.log" >&2; fail "the example cannot be built"; }
"$build/bin/voxelcore" phantom torus --size 40 -o "$scratch/torus.mha" -q
said=$("$scratch/example/SkeletonPaths" "$scratch/torus.mha" "$scratch/paths.mha")
[ "$said" = "1 branches" ] || fail "a torus has one closed branch, but the example says: $said"
"$build/bin/voxelcore" info "$scratch/paths.mha" >/dev/null 2>&1 || fail "what the example writes is no image"
echo "module of ITK: works"
