#!/usr/bin/env bash
# The steps of an image with Debian 12 in it, for Containerfile and voxelcore.def alike.
# usage: build.sh prepare                install what building needs, by install-packages.sh beside this folder
#        build.sh packages SOURCE OUT [OPTION...]    build VoxelCore in SOURCE/build, with CMake's options; leave its
#                                        Debian packages in OUT
#        build.sh install OUT            install the program and the Python module from there, and a user to run them
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive

case "${1:-}" in
  prepare)
    # Packages of Java, which VTK's brings along, put a link here; small Debians have no such folder.
    mkdir -p /usr/share/man/man1
    bash "$(dirname "$(realpath "$0")")/../install-packages.sh" build python
    apt-get install -y -q --no-install-recommends dpkg-dev file # cpack asks file which libraries a package needs
    ;;
  packages)
    source=$(realpath "$2")
    out=$3
    shift 3
    # Without TetGen the image is under the Apache licence as a whole; the results are the same.
    cmake -S "$source" -B "$source/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
      -DVOXELCORE_TETGEN=OFF "$@"
    cmake --build "$source/build"
    mkdir -p "$out"
    (cd "$source/build" && cpack -B "$out" >"$out/cpack.log") || { cat "$out/cpack.log" >&2; exit 1; }
    rm -rf "$out/_CPack_Packages" "$out"/libvoxelcore-dev*
    ;;
  install)
    # What nobody here reads: maps of the earth, descriptions for compilers, other people's tests.
    printf 'path-exclude %s\n' '/usr/share/proj/*' '/usr/lib/*/vtk/hierarchy/*' '/usr/share/doc/*' \
      >/etc/dpkg/dpkg.cfg.d/voxelcore
    printf 'path-include /usr/share/doc/*/copyright\n' >>/etc/dpkg/dpkg.cfg.d/voxelcore
    apt-get update -q
    # Xvfb draws the pictures of `voxelcore render`.
    apt-get install -y -q --no-install-recommends "$2"/voxelcore_*.deb "$2"/python3-voxelcore_*.deb procps xvfb xauth
    apt-get clean
    rm -rf /usr/lib/python3/dist-packages/numpy/*/tests # not before: they are compiled when they are installed
    rm -rf "$2" /var/lib/apt/lists/* /var/cache/apt/*.bin /var/log/apt /var/log/dpkg.log
    id voxelcore >/dev/null 2>&1 || useradd --create-home --uid 1000 voxelcore
    mkdir -p /data
    chown voxelcore /data
    voxelcore --version
    ;;
  *) echo "build.sh: expected prepare, packages or install" >&2; exit 2 ;;
esac
