#!/usr/bin/env bash
# The Debian packages in a Debian 12 that has nothing else (debootstrap): installed with what they ask for, the program
# runs the JHU atlas and gives the bits it gives here; libraries and headers are enough to build a project; the Python
# module works. Every group of install-packages.sh can be installed there.
# usage: bare_debian_test.sh BUILD_DIR PACKAGES    PACKAGES: folder of .deb, made by deb_test.sh
# exit 77: it cannot be done here, with the reason. VOXELCORE_DEBIAN_MIRROR: another mirror
set -euo pipefail

build=$(realpath "$1")
packages=$2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/debian
root=$scratch/root
mirror=${VOXELCORE_DEBIAN_MIRROR:-http://deb.debian.org/debian}
atlas=/usr/share/mricron/templates/JHU-WhiteMatter-labels-2mm.nii.gz
fail() {
  echo "bare_debian_test.sh: $1" >&2
  exit 1
}
skip() {
  echo "bare_debian_test.sh: $1" >&2
  exit 77
}
[ "$(id -u)" = 0 ] || skip "only root can make another root"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"
ls "$packages"/voxelcore*.deb >/dev/null 2>&1 || fail "there are no packages in $packages"

# What is mounted there must not be removed.
leave() {
  ! mountpoint -q "$root/proc" || umount "$root/proc" || return
  rm -rf --one-file-system "$root"
}
trap leave EXIT
leave
rm -rf --one-file-system "$scratch"
mkdir -p "$scratch"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$scratch/debootstrap.log" 2>&1 ||
  skip "debootstrap has no Debian: $(tail -n 1 "$scratch/debootstrap.log")"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mount -t proc proc "$root/proc" || skip "cannot mount /proc in another root"
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"
}
install() {
  inside apt-get -y -q --no-install-recommends install "$@" >"$scratch/install.log" 2>&1 ||
    { tail -n 20 "$scratch/install.log" >&2; fail "cannot install $*"; }
}
inside apt-get -q update >"$scratch/update.log" 2>&1 || skip "no lists of packages: $(tail -n 1 "$scratch/update.log")"

mkdir "$root/given"
cp -r "$packages" "$root/given/packages"
cp -r "$source/Testing" "$root/given"
cp "$source/Applications/install-packages.sh" "$root/given"
groups=$(sed -n '/^packages_of/,/^}/s/^    \([a-z]*\)).*/\1/p' "$source/Applications/install-packages.sh")
[ "$(wc -w <<<"$groups")" -ge 10 ] || fail "which groups has install-packages.sh? $groups"
for group in $groups; do
  # As it stands, but that apt-get only says what it would do.
  mkdir -p "$root/given/only-says"
  printf '#!/bin/sh\n[ "$3" = update ] || exec /usr/bin/apt-get --simulate "$@"\n' >"$root/given/only-says/apt-get"
  chmod +x "$root/given/only-says/apt-get"
  inside env PATH=/given/only-says:/usr/sbin:/usr/bin:/sbin:/bin bash /given/install-packages.sh "$group" \
    >"$scratch/$group.log" 2>&1 || { tail "$scratch/$group.log" >&2; fail "group $group cannot be installed"; }
  grep -q '^Inst ' "$scratch/$group.log" || fail "group $group would install nothing"
done

in_packages() { (cd "$root" && ls given/packages/"$1"*.deb | sed 's|^|/|'); }
install "$(in_packages voxelcore)" mricron-data
inside voxelcore --version
inside sh -c "cd /given && voxelcore core $atlas -o jhu.vtp --report jhu.json -q && voxelcore verify $atlas jhu.vtp -q"
"$build/bin/voxelcore" core "$root$atlas" -o "$scratch/jhu.vtp" -q --force
cmp "$root/given/jhu.vtp" "$scratch/jhu.vtp" || fail "the bits are others there"
inside sh -c "cd /given && voxelcore skeleton $atlas -o skeleton.vtp -q &&
  voxelcore core $atlas -o page.vtp --html page.html -q"
# What it takes for pictures is said.
! inside voxelcore render /given/jhu.vtp -o /given/jhu.png 2>"$scratch/render.log" || fail "it draws without Xvfb?"
grep -q 'apt-get install xvfb' "$scratch/render.log" ||
  { cat "$scratch/render.log" >&2; fail "render does not say what it lacks"; }

install "$(in_packages python3-voxelcore)"
inside python3 -c "
import numpy, voxelcore
assert voxelcore.core(numpy.ones((9, 9, 3), bool)).topology == {'euler': 1, 'betti': (1, 0, 0)}"

install "$(in_packages libvoxelcore-dev)" g++ cmake ninja-build
inside sh -euc 'cd /given
  cmake -S Testing/Package/consumer -B consumer-build -G Ninja -DCMAKE_BUILD_TYPE=Release -DHOW=find_package \
    -DPARTS="Core;Imaging;Models;Jobs;VTK" -DVOXELCORE_SOURCE=/given
  cmake --build consumer-build
  voxelcore phantom torus --size 40 -o torus.nrrd -q
  consumer-build/UsesCore
  consumer-build/UsesFiles torus.nrrd files.vtp
  consumer-build/UsesJobs torus.nrrd jobs.vtp
  voxelcore core torus.nrrd --lambda 1.5vox -o program.vtp -q
  cmp jobs.vtp program.vtp' >"$scratch/consumer.log" 2>&1 ||
    { tail -n 30 "$scratch/consumer.log" >&2; fail "no project can be built"; }
echo "bare Debian: works"
