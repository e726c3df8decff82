#!/bin/bash
# Makes the volumes in this folder again: bash Data/make.sh [path of the program voxelcore]
set -eu
voxelcore=$(realpath "$(command -v "${1:-voxelcore}")")
cd "$(dirname "$0")"
phantom() {
  "$voxelcore" phantom "$@" --force --quiet
}
phantom ellipsoid --size 64 -o ellipsoid-64.nrrd
phantom ball --size 40 --spacing 0.5,0.5,0.5 -o ball-40.nii.gz
phantom capsule --size 60,24,24 -o capsule.mha
phantom box --size 20,15,10 -o box.nrrd
phantom plate --size 48,48,31 --thickness 3 -o plate-3.nrrd
phantom rod --size 32,32,40 --spacing 0.5,0.5,2 -o rod-thick-slices.nii.gz
phantom torus --size 40 -o torus.nrrd
phantom shell --size 40 -o shell.mha
phantom tanglecube --size 50 -o tanglecube.tif
phantom gyroid --size 48 -o gyroid.nrrd
phantom porous --size 32 --density 0.4 --seed 3 -o porous.nrrd
phantom noise --size 12 --density 0.5 --seed 3 -o noise.nrrd
phantom root --size 96,96,128 --spacing 0.25,0.25,0.25 --seed 1 -o root.nrrd
