#!/usr/bin/env bash
# Writes what formats_test.py reads, with a program of the version to be recorded. To be run once for each version that
# is released.
# usage: record.sh VOXELCORE
set -euo pipefail
program=$(realpath "$1")
version=$("$program" --version | sed -n '1s/^voxelcore //p')
cd "$(dirname "${BASH_SOURCE[0]}")/../../../Data"
folder=../Testing/Results/formats/$version
pruning=--tolerance
[[ $version != 0.1.* ]] || pruning=--bumps
mkdir -p "$folder"
run() { (exec -a voxelcore "$program" "$@"); } # reports name the command
run core box.nrrd --lambda 0 --keep-edges -o "$folder/whole.vtp" --report "$folder/whole.json" -q
run core rod-thick-slices.nii.gz --lambda 0.9mm -o "$folder/pruned.vtp" -q
run core capsule.mha $pruning 1.2diag -o "$folder/tolerance.vtp" -q
run core box.nrrd --lambda 1.5vox --refine labels -o "$folder/refined.vtp" -q
run skeleton capsule.mha -o "$folder/branches.vtp" -q
