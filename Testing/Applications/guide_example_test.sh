#!/usr/bin/env bash
# A program that the guide's page on C++ shows makes the file that `voxelcore core` makes.
# usage: guide_example_test.sh PROGRAM EXAMPLE [OPTION...]    options: those that the program needs to do the same
set -euo pipefail

program=$(realpath "$1")
example=$(realpath "$2")
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program" phantom torus --size 40,40,24 --spacing 0.5,0.5,1 -o scan.nii.gz -q
"$example"
"$program" core scan.nii.gz "$@" -o program.vtp -q
for file in medial program; do
  sed -n '/<Piece/p' "$file.vtp" | head -n 1 >"$file.piece"
done
cmp medial.piece program.piece || { echo "guide_example_test.sh: other cells than the program's" >&2; exit 1; }
[ "$(grep -c 'NumberOfPoints="[1-9]' medial.piece)" = 1 ] || { echo "guide_example_test.sh: no points" >&2; exit 1; }
