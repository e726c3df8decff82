#!/usr/bin/env bash
# Makes the pictures of README.md: surface, medial surface and curve skeleton of a root phantom and of a label of a real
# atlas, each by one `render`; what pruning does to thick and thin parts; a whole atlas. Needs the packages of groups demo
# and python, and Xvfb.
# usage: make.sh VOXELCORE [FOLDER]      FOLDER: where they go, else beside this file
set -euo pipefail
voxelcore=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
to=$(realpath "${2:-$here}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
atlas=/usr/share/mricron/templates/aal.nii.gz

"$voxelcore" phantom root --size 192,192,288 --seed 7 -o root.nrrd -q
"$voxelcore" core root.nrrd -o root.vtp --with-skeleton -q
"$voxelcore" render root.vtp root_skeleton.vtp --scan root.nrrd --panels --size 1050x590 -o "$to/root.png" --force -q

"$voxelcore" core "$atlas" --labels Hippocampus_L -o part.vtp --with-skeleton -q
"$voxelcore" render part.vtp part_skeleton.vtp --scan "$atlas" --panels --size 1050x500 -o "$to/hippocampus.png" --force -q

"$voxelcore" phantom thick-and-thin --size 96 -o t.nrrd -q
"$voxelcore" core t.nrrd --lambda 0,1.5vox,2.5vox -o t.vtp -q
"$voxelcore" core t.nrrd -o t_tolerance-1.2diag.vtp -q
tiles=()
for shown in "t_lambda-0=whole core" "t_lambda-1.5vox=--lambda 1.5vox" "t_lambda-2.5vox=--lambda 2.5vox" \
  "t_tolerance-1.2diag=--tolerance 1.2diag, the default"; do
  "$voxelcore" render "${shown%%=*}.vtp" --scan t.nrrd --view iso --range 1:15 --size 525x375 -o "${shown%%=*}.png" -q
  tiles+=("${shown%%=*}.png" "${shown#*=}")
done
/usr/bin/python3 "$here/tile.py" "$to/pruning.png" 2 "${tiles[@]}"

"$voxelcore" core "$atlas" -o aal.vtp -q
"$voxelcore" render aal.vtp --color Label --view iso --size 800x650 -o "$to/atlas.png" --force -q
