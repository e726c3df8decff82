#!/usr/bin/env bash
# Makes the pictures of README.md: surface, medial surface and curve skeleton of a root phantom and of a label of a real
# atlas, each by one `render`; what pruning does to thick and thin parts; a whole atlas; what the Slicer module computes;
# and, without a folder, that module's icon. The last two go to where they belong. Needs the packages of groups demo
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

# What the Slicer module gives of a segment, drawn by this program: its models, the slider at a greater tolerance.
"$voxelcore" core "$atlas" --labels Precuneus_L --tolerance 1.2diag,3diag -o p.vtp -q
"$voxelcore" skeleton "$atlas" --labels Precuneus_L -o p_skeleton.vtp -q
"$voxelcore" thickness "$atlas" --labels Precuneus_L -o p.nrrd --medial p_thickness.vtp -q
tiles=()
for shown in "p_tolerance-1.2diag=medial surface, by radius" "p_tolerance-3diag=slider at 3 voxel diagonals" \
  "p_thickness=by thickness" "p_skeleton=curve skeleton"; do
  by=Radius
  [ "${shown%%=*}" != p_thickness ] || by=Thickness
  "$voxelcore" render "${shown%%=*}.vtp" --color $by --view iso --size 525x375 -o "${shown%%=*}.png" -q
  tiles+=("${shown%%=*}.png" "${shown#*=}")
done
/usr/bin/python3 "$here/tile.py" slicer.png 2 "${tiles[@]}"
if [ $# -lt 2 ]; then to=$here/../../Applications/manual/guide; fi
cp slicer.png "$to/"

# The medial surface of a box.
if [ $# -lt 2 ]; then
  head -c $((72 * 56 * 60)) /dev/zero | tr '\0' '\1' >box.raw
  "$voxelcore" core box.raw --raw 72,56,60,uint8 --spacing 1,1,1 --lambda 2.5vox -o box.vtp -q
  "$voxelcore" render box.vtp --view iso --size 900x720 -o box.png -q
  /usr/bin/python3 "$here/icon.py" box.png "$here/../../Applications/slicer/VoxelCore/Resources/Icons/VoxelCore.png" \
    20 0 720
fi
