#!/usr/bin/env bash
# Makes the pictures of README.md: surface, medial surface and curve skeleton of a root phantom and of a label of a real
# atlas. Needs the packages of group demo, and Xvfb.
# usage: make.sh VOXELCORE
set -euo pipefail
voxelcore=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
atlas=/usr/share/mricron/templates/aal.nii.gz

"$voxelcore" phantom root --size 128,128,192 --seed 7 -o "$work/root.nrrd" -q
"$voxelcore" core "$work/root.nrrd" --lambda 1vox -o "$work/root.vtp" --with-skeleton -q
"$voxelcore" render "$work/root.vtp" "$work/root_skeleton.vtp" --scan "$work/root.nrrd" --panels --color ErosionThickness \
  --size 1050x700 -o "$here/root.png" --force -q

"$voxelcore" core "$atlas" --labels Hippocampus_L --bumps 0.6diag -o "$work/part.vtp" --with-skeleton -q
"$voxelcore" render "$work/part.vtp" "$work/part_skeleton.vtp" --scan "$atlas" --panels --size 1050x500 \
  -o "$here/hippocampus.png" --force -q
