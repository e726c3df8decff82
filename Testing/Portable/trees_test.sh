#!/usr/bin/env bash
# The program for any Linux, in Debian 11, 12 and unstable that have nothing else (debootstrap): cores, skeletons, roots
# and thickness of scans have the bits that the program has here.
# usage: trees_test.sh PORTABLE PROGRAM DATA FOLDER    DATA: the folder with the test scans; FOLDER: to work in
# exit 77: it cannot be done here, with the reason. VOXELCORE_DEBIAN_MIRROR: another mirror
set -euo pipefail

portable=$(realpath "$1")
program=$(realpath "$2")
data=$(realpath "$3")
mkdir -p "$4"
folder=$(realpath "$4")
mirror=${VOXELCORE_DEBIAN_MIRROR:-http://deb.debian.org/debian}
fail() {
  echo "trees_test.sh: $1" >&2
  exit 1
}
skip() {
  echo "trees_test.sh: $1" >&2
  exit 77
}
[ "$(id -u)" = 0 ] || skip "only root can make another root"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"

# What is mounted there must not be removed.
leave() {
  for suite in bullseye bookworm sid; do
    ! mountpoint -q "$folder/$suite/proc" || umount "$folder/$suite/proc"
  done
}
trap leave EXIT
leave

# In a folder of its own, which is left to be compared; $1: the program.
runs='set -eu
"$1" core "$2/gyroid.nrrd" -o core.vtp -q
"$1" verify "$2/gyroid.nrrd" core.vtp -q
"$1" skeleton "$2/tanglecube.tif" -o skeleton.vtp --also csv,swc -q
"$1" thickness "$2/ball-40.nii.gz" -o thickness.nrrd -q
"$1" roots "$2/root.nrrd" -o roots --no-pictures -q
"$1" batch "$2/box.nrrd" -o batch -q'

rm -rf "$folder/here"
mkdir "$folder/here"
(cd "$folder/here" && sh -c "$runs" runs "$program" "$data")
for suite in bullseye bookworm sid; do
  root=$folder/$suite
  if [ ! -e "$root/etc/os-release" ]; then
    rm -rf --one-file-system "$root"
    debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$folder/$suite.log" 2>&1 ||
      skip "debootstrap has no $suite: $(tail -n 1 "$folder/$suite.log")"
  fi
  rm -rf "$root/given" "$root/there"
  mkdir "$root/given" "$root/there"
  cp "$portable" "$root/given/voxelcore"
  cp -r "$data" "$root/given/data"
  mount -t proc proc "$root/proc" || skip "cannot mount /proc in another root"
  chroot "$root" env -i PATH=/usr/bin:/bin sh -c "cd /there && $runs" runs /given/voxelcore /given/data
  umount "$root/proc"
  # What a report says of the run itself, such as its time, is another there.
  diff -r --exclude='*.json' --exclude='*.rsml' --exclude=cases.csv --exclude='*.jsonl' "$folder/here" \
    "$root/there" >"$folder/$suite.diff" ||
    { head "$folder/$suite.diff" >&2; fail "$suite: the bits are others there"; }
done
echo "bullseye, bookworm and sid: the program runs, and its bits are the same"
