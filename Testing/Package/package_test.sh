#!/usr/bin/env bash
# Installs a build, moves the tree elsewhere, and builds and runs projects that use it; or builds such a project with
# VoxelCore's sources inside it.
# usage: package_test.sh install|find_package|add_subdirectory|FetchContent BUILD_DIR [CMAKE_OPTION...]
set -euo pipefail

how=$1
build=$(realpath "$2")
shift 2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/$how
moved=$build/package-test/moved

fail() {
  echo "package_test.sh: $1" >&2
  exit 1
}
configure() {
  cmake -S "$source/Testing/Package/consumer" -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHOW="$how" \
    -DVOXELCORE_SOURCE="$source" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" "${@:2}" >"$1.log" 2>&1 ||
    { cat "$1.log" >&2; fail "a project that uses VoxelCore by $how cannot be configured"; }
}
scan_into() {
  "$build/bin/voxelcore" phantom torus --size 40 -o "$1/torus.nrrd" --force -q
}

rm -rf "$scratch"
mkdir -p "$scratch"
case "$how" in
  install)
    rm -rf "$moved"
    cmake --install "$build" --prefix "$scratch/first" >"$scratch.log"
    mkdir -p "$moved"
    mv "$scratch/first" "$moved/second"
    "$moved/second/bin/voxelcore" --version | head -1 | grep -qE '^voxelcore [0-9]+\.[0-9]+\.[0-9]+$' ||
      fail "the installed program does not say its version"
    # What is read through ITK, a program beside it reads, found from where the tree was moved to.
    if [ -x "$build/libexec/voxelcore/voxelcore-itk-reader" ]; then
      { printf '# vtk DataFile Version 3.0\nscan\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 3 3\nSPACING 1 1 2\n'
        printf 'ORIGIN 0 0 0\nPOINT_DATA 27\nSCALARS labels short 1\nLOOKUP_TABLE default\n'
        printf '4 %.0s' {1..27}; } > "$scratch/image.vtk"
      "$moved/second/bin/voxelcore" info "$scratch/image.vtk" | grep -q "ITK's VTKImageIO" ||
        fail "the installed program does not read through ITK"
    fi
    if grep -rlE "$source|$build" "$moved/second" --include='*.cmake' --include='*.h' --include='*.hxx'; then
      fail "these installed files name the folder they were built in"
    fi
    # Public headers and nothing else: what lies in an include folder.
    diff <(cd "$moved/second/include" && find . -type f | sort) \
      <(cd "$source/Modules" && for d in */*/include; do (cd "$d" && find . -type f); done | sort) ||
      fail "the installed headers are not the public ones"
    ;;
  find_package)
    [ -d "$moved/second" ] || fail "the test 'install' has not run"
    options=(-DCMAKE_PREFIX_PATH="$moved/second")
    # The mathematics alone needs no other library. Headers need C++20, and their targets ask for it: also in a project
    # that is one of C++17, as many that use ITK are.
    configure "$scratch/core" "${options[@]}" -DCMAKE_CXX_STANDARD=17 -DPARTS=Core -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON \
      -DCMAKE_DISABLE_FIND_PACKAGE_TIFF=ON -DCMAKE_DISABLE_FIND_PACKAGE_ITK=ON
    cmake --build "$scratch/core"
    "$scratch/core/UsesCore"
    if ldd "$scratch/core/UsesCore" | grep -E 'libvtk|libITK|libtiff|libpng'; then
      fail "Core brings these libraries along"
    fi
    parts="Imaging;Models;Jobs;VTK"
    [ -z "$(find "$moved/second" -name VoxelCore-ITK.cmake)" ] || parts+=";ITK"
    configure "$scratch/all" "${options[@]}" -DPARTS="$parts"
    cmake --build "$scratch/all"
    # Without a word about how and what, as its first lines say.
    cmake -S "$source/Testing/Package/consumer" -B "$scratch/plain" -DCMAKE_PREFIX_PATH="$moved/second" \
      >"$scratch/plain.log" 2>&1 || { cat "$scratch/plain.log" >&2; fail "the example's own line does not configure"; }
    # The guide's projects, as they stand there.
    page=$source/Applications/manual/guide/cpp.md
    for kind in mine itk; do
      mkdir "$scratch/$kind"
      sed -n '/^    cmake_minimum_required/,/^$/s/^    //p' "$page" >"$scratch/$kind/CMakeLists.txt"
    done
    grep -qx 'project(mine CXX)' "$scratch/mine/CMakeLists.txt" || fail "the guide's project needs more than C++"
    sed -n '/^    #include "voxelcore\/Certified/,/^    }$/s/^    //p' "$page" >"$scratch/mine/mine.cxx"
    sed -n '/^    #include "itk/,/^    }$/s/^    //p' "$page" >"$scratch/itk/mine.cxx"
    sed -i 's/Core Imaging Models/ITK Models/; s/VoxelCore::Core VoxelCore::Imaging/VoxelCore::ITK/' \
      "$scratch/itk/CMakeLists.txt"
    [[ $parts == *ITK* ]] || rm -r "$scratch/itk"
    for kind in "$scratch"/{mine,itk}/; do
      [ -d "$kind" ] || continue
      cmake -S "$kind" -B "$kind/build" -G Ninja -DCMAKE_PREFIX_PATH="$moved/second"
      cmake --build "$kind/build"
    done
    scan_into "$scratch"
    "$scratch/all/UsesFiles" "$scratch/torus.nrrd" "$scratch/files.vtp"
    "$scratch/all/UsesJobs" "$scratch/torus.nrrd" "$scratch/jobs.vtp"
    "$build/bin/voxelcore" core "$scratch/torus.nrrd" --lambda 1.5vox -o "$scratch/program.vtp" -q
    cmp "$scratch/jobs.vtp" "$scratch/program.vtp"
    bash "$source/Testing/Package/symbols_test.sh" "$scratch/all/libPlugin.so" PluginMakesCore
    "$scratch/all/UsesPlugin" "$scratch/all/libPlugin.so" "$scratch/torus.nrrd" "$scratch/plugin.vtp"
    cmp "$scratch/plugin.vtp" "$scratch/program.vtp"
    "$build/bin/voxelcore" phantom torus --size 40 -o "$scratch/scan.nii.gz" -q
    (cd "$scratch" && mine/build/mine && [ -s medial.vtp ]) || fail "the guide's example does not work"
    if [ -d "$scratch/itk" ]; then
      rm "$scratch/medial.vtp"
      (cd "$scratch" && itk/build/mine) || fail "the guide's program for ITK does not work"
      "$build/bin/voxelcore" verify "$scratch/scan.nii.gz" "$scratch/medial.vtp" >/dev/null ||
        fail "what the guide's program for ITK wrote is not verified"
    fi
    "$build/bin/voxelcore" phantom torus --size 40 -o "$scratch/torus.mha" -q
    "$scratch/all/UsesVTK" "$scratch/torus.mha" 2 1 "$scratch/vtk.vtp"
    if [ -x "$scratch/all/UsesITK" ]; then
      "$scratch/all/UsesITK" "$scratch/torus.nrrd" 1.5vox "$scratch/itk.vtp"
    fi
    # A version that is not this one, and a part there is not, are refused by name.
    for wrong in -DWANTED_VERSION=99.0 -DPARTS=Nonsense; do
      ! cmake -S "$source/Testing/Package/consumer" -B "$scratch/wrong" -G Ninja -DHOW=find_package -DPARTS=Core \
        "${options[@]}" "$wrong" >"$scratch/wrong.log" 2>&1 || fail "$wrong was accepted"
      grep -qE '99\.0|no component Nonsense' "$scratch/wrong.log" ||
        { cat "$scratch/wrong.log"; fail "refused, but why?"; }
      rm -rf "$scratch/wrong"
    done
    ;;
  add_subdirectory | FetchContent)
    configure "$scratch/build" -DPARTS="Core;Imaging;Models" "$@"
    # It takes over no choice of its host: no tests, no program's install rules.
    ! grep -q gtest "$scratch/build/build.ninja" || fail "VoxelCore's tests are part of the other project"
    cmake --build "$scratch/build" --target UsesCore UsesFiles
    "$scratch/build/UsesCore"
    scan_into "$scratch"
    "$scratch/build/UsesFiles" "$scratch/torus.nrrd" "$scratch/files.vtp"
    ;;
  *) fail "unknown test '$how'" ;;
esac
echo "$how: works"
