#!/usr/bin/env bash
# Runs the commands README.md shows, one after the other as a reader would, on a small scan called scan.nii.gz, a cohort of
# it, a `ct.nrrd` of grey values, a mesh `part.stl`, and a `huge.nrrd` that is not. Those that need a cluster are run by the test in Testing/Cluster.
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
PATH=$PWD/build/release/bin:$PATH
"$program" phantom root --size 40 -o huge.nrrd -q
# A ball of radius 7 with a soft rim, and a box of two triangles a side.
awk 'BEGIN {
  print "NRRD0004\ntype: short\ndimension: 3\nsizes: 20 20 20\nspace: left-posterior-superior"
  print "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: ascii\n"
  for (k = 0; k < 20; ++k) for (j = 0; j < 20; ++j) for (i = 0; i < 20; ++i)
    print int(1000 - 100 * sqrt((i - 9.6) ^ 2 + (j - 9.4) ^ 2 + (k - 9.5) ^ 2))
}' >ct.nrrd
awk 'function corner(c) { printf " vertex %g %g %g\n", 10 * (c % 2), 6 * (int(c / 2) % 2), 4 * int(c / 4) }
function triangle(a, b, c) { print "facet normal 0 0 0\nouter loop"; corner(a); corner(b); corner(c); print "endloop\nendfacet" }
function side(a, b, c, d) { triangle(a, b, c); triangle(a, c, d) }
BEGIN { print "solid part"; side(0, 2, 3, 1); side(4, 5, 7, 6); side(0, 1, 5, 4); side(2, 6, 7, 3); side(0, 4, 6, 2); side(1, 3, 7, 5); print "endsolid part" }' >part.stl

count=0
while IFS= read -r line; do
  if [[ $line == voxelcore\ render* ]] && ! command -v Xvfb >/dev/null; then
    continue
  fi
  count=$((count + 1))
  echo "+ $line"
  bash -euc "$line" </dev/null || { echo "readme_test.sh: README.md's command failed: $line" >&2; exit 1; }
done < <(sed -nE 's/^    (((build\/release\/bin\/)?voxelcore |for k in ).*)$/\1/p' "$readme")
[ "$count" -ge 14 ] || { echo "readme_test.sh: README.md has only $count commands" >&2; exit 1; }
for file in medial.vtp medial.json root.vtp root_branches.csv root.swc both_skeleton.vtp t_bumps-1.2diag.vtp huge.vtp results/index.html; do
  [ -s "$file" ] || { echo "readme_test.sh: README.md's commands left no $file" >&2; exit 1; }
done

# Lines of C++ said to be from an example stand there, in the same order, comments apart; the example is built and run by its own test.
quoted=0
while IFS=$'\t' read -r source line; do
  if [ "$source" != "${before:-}" ]; then
    mapfile -t code < <(sed -E 's/^ +//; s/ *(\/\/.*)?$//' "$(dirname "$readme")/$source")
    before=$source
    at=0
  fi
  while [ "$at" -lt "${#code[@]}" ] && [ "${code[at]}" != "$line" ]; do
    at=$((at + 1))
  done
  [ "$at" -lt "${#code[@]}" ] || { echo "readme_test.sh: README.md quotes what $source has not: $line" >&2; exit 1; }
  at=$((at + 1))
  quoted=$((quoted + 1))
done < <(awk '
  match($0, /[Ff]rom `Testing\/[^`]*\.cxx`/) { source = substr($0, RSTART + 6, RLENGTH - 7); next }
  source != "" && /^    / { sub(/^ +/, ""); sub(/ *(\/\/.*)?$/, ""); print source "\t" $0; inside = 1; next }
  source != "" && inside && /^$/ { source = ""; inside = 0 }' "$readme")
[ "$quoted" -ge 20 ] || { echo "readme_test.sh: only $quoted lines of C++ were found in README.md" >&2; exit 1; }
