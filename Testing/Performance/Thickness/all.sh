#!/usr/bin/env bash
# All tables of this folder, and the whole job beside the core's on a trabecular phantom.
# usage: all.sh PROGRAM [TURNS [SIDE]]   (bash Applications/install-packages.sh bench)
set -euo pipefail
program=$(realpath "$1")
turns=${2:-24}
side=${3:-512}
cd "$(dirname "${BASH_SOURCE[0]}")"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

python3 bias.py "$program" "$turns"
python3 sheets.py "$program" "$turns"
python3 peers.py "$program" 256 1
python3 peers.py "$program" 256 2.5

# Smooth noise above a threshold, a fifth of it solid: struts and plates 4 to 12 voxels thick (9 in 10 voxels).
"$program" phantom porous --size "$side" --density 0.2 --period 12 -o "$folder/bone.nrrd" -q
for command in "core $folder/bone.nrrd -o $folder/core.vtp" \
               "core $folder/bone.nrrd --refine off -o $folder/exact.vtp" \
               "thickness $folder/bone.nrrd -o $folder/map.nrrd" \
               "thickness $folder/bone.nrrd --refine off -o $folder/lower.nrrd"; do
  echo "$command" | sed "s,$folder/,,g"
  # shellcheck disable=SC2086
  "$program" $command --force 2>&1 | tail -2
done
