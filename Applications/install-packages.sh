#!/usr/bin/env bash
# The Debian packages VoxelCore needs, in one place. Installs those that are missing; does nothing when none is.
# usage: install-packages.sh GROUP...     groups: build, python (the module), wheel (the same for pip), demo
# (a real scan), picture (to render where there is no screen), guide (to build the guide's site), test, package (to make
# and test packages and the reference), debian (to build by Applications/debian), sanitizer (what the tests under
# ThreadSanitizer need besides), analysis (what reads the sources, and valgrind), browser (tests of pages), cluster
# (workflows, and the tests on a cluster), container (to test the image), reproduction
# (the paper's figures, Testing/Reproduction), bench (Testing/Performance), web (WebAssembly), portable (the program for
# other systems, and to test it)
set -euo pipefail

packages_of() {
  case "$1" in
    build) echo g++ cmake ninja-build ccache libvtk9-dev libtet1.5-dev libtiff-dev libpng-dev zlib1g-dev libbz2-dev \
                 libblosc-dev libzstd-dev libexpat1-dev libjpeg-dev libinsighttoolkit5-dev libhdf5-dev libx11-dev \
                 libzip-dev libmeshoptimizer-dev libssl-dev libjs-three libboost-dev libcli11-dev nlohmann-json3-dev ;;
    python) echo pybind11-dev python3-dev python3-numpy python3-vtk9 ;;
    wheel) echo g++ cmake ninja-build ccache libpng-dev zlib1g-dev libbz2-dev libblosc-dev libzstd-dev libexpat1-dev \
                libssl-dev libboost-dev libcli11-dev nlohmann-json3-dev pybind11-dev python3-dev \
                python3-numpy python3-pip python3-venv patchelf ;;
    demo) echo mricron-data ;;
    picture) echo xvfb xauth ;;
    guide) echo mkdocs ;;
    test) echo clang-format xvfb libgtest-dev libgmock-dev mypy python3-nibabel python3-networkx python3-numpy \
               python3-pandas python3-pytest python3-xarray python3-pydicom python3-mrcfile python3-h5py minc-tools \
               python3-tifffile python3-pil python3-zarr python3-matplotlib python3-pyqt5 python3-cheetah xauth \
               mricron-data ;;
    package) echo dpkg-dev file debootstrap doxygen graphviz groff mkdocs mricron-data ;;
    debian) echo debhelper dh-python dpkg-dev lintian libinsighttoolkit5-dev ;;
    sanitizer) echo clang libomp-dev ;;
    analysis) echo clang clang-tidy cppcheck valgrind ;;
    browser) echo chromium chromium-headless-shell python3 ;;
    container) echo buildah podman runc debootstrap mricron-data ;;
    cluster) echo snakemake slurm-wlm munge python3 ;;
    reproduction) echo python3 python3-numpy python3-scipy python3-matplotlib python3-vtk9 libcgal-demo ;;
    web) echo emscripten node-acorn cmake ninja-build ccache dpkg-dev libboost-dev libcli11-dev nlohmann-json3-dev \
              libjs-three ;;
    portable) echo g++ g++-aarch64-linux-gnu g++-mingw-w64-x86-64-posix cmake ninja-build ccache dpkg-dev libboost-dev \
                   libcli11-dev nlohmann-json3-dev zip debootstrap qemu-user wine wine64 ;;
    paraview) echo paraview xvfb xauth mricron-data ;;
    bench) echo libbenchmark-dev libcgal-dev libtbb-dev python3-matplotlib python3-skimage python3-scipy \
                python3-nibabel ;;
    *) echo "install-packages.sh: unknown group '$1'; there are build, python, wheel, demo, picture, guide, test," \
            "package, debian, sanitizer, analysis, browser, cluster, container, reproduction, bench, web, portable" \
            "and paraview" >&2
       return 2 ;;
  esac
}

missing=()
for group in "$@"; do
  names=$(packages_of "$group")
  for name in $names; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null || true)" != installed ]; then
      missing+=("$name")
    fi
  done
done
[ ${#missing[@]} -gt 0 ] || exit 0

stop() {
  echo "Cannot install packages here: $1." >&2
  echo "These Debian 12 packages are missing: ${missing[*]}" >&2
  exit 1
}

command -v apt-get >/dev/null || stop "there is no apt-get"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || stop "neither root nor sudo"
  as_root=(sudo)
  # Without a terminal nobody can type a password.
  [ -t 0 ] || as_root=(sudo -n)
  "${as_root[@]}" true || stop "sudo refused"
fi
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@" </dev/null
}

echo "Installing ${missing[*]}"
apt update || stop "'apt-get update' failed"
apt install --no-install-recommends "${missing[@]}" || stop "'apt-get install' failed"
