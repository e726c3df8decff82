#!/usr/bin/env bash
# Runs the commands README.md shows, one after the other as a reader would, on a small scan called scan.nii.gz, and
# a cohort of it.
# usage: readme_test.sh PROGRAM
set -euo pipefail

program=$(realpath "$1")
readme=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../README.md")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program" phantom torus --size 40,40,24 --spacing 0.5,0.5,1 -o scan.nii.gz -q
printf 'id,scan,lambda\nsub1,scan.nii.gz,1vox\nsub2,scan.nii.gz,\n' >cohort.csv
mkdir -p build/release/bin scans
cp scan.nii.gz scans/
ln -s "$program" build/release/bin/voxelcore

count=0
while IFS= read -r line; do
  count=$((count + 1))
  echo "+ $line"
  bash -euc "$line" </dev/null || { echo "readme_test.sh: README.md's command failed: $line" >&2; exit 1; }
done < <(sed -n 's/^    \(build\/release\/bin\/voxelcore .*\)$/\1/p' "$readme")
[ "$count" -ge 4 ] || { echo "readme_test.sh: README.md has only $count commands" >&2; exit 1; }
for file in medial.vtp medial.json root.vtp root_branches.csv root.swc both_skeleton.vtp; do
  [ -s "$file" ] || { echo "readme_test.sh: README.md's commands left no $file" >&2; exit 1; }
done
