#!/usr/bin/env bash
# Every command of voxelcore that README.md and the guide show runs, page by page, on small inputs of the names it uses;
# all C++ of the guide is from an example that is built and run, CMake apart. What needs a cluster is run by the test in
# Testing/Cluster, the tutorial by tutorial_test.py.
# usage: guide_test.sh PROGRAM SOURCE_DIR
set -euo pipefail

program=$(realpath "$1")
source=$(realpath "$2")
guide=$source/Applications/manual/guide
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
ln -s "$program" "$folder/bin/voxelcore"
PATH=$folder/bin:$PATH
fail() { echo "guide_test.sh: $*" >&2; exit 1; }

# A ball of radius 7 with a soft rim, and a needle of two triangles a side, so that 1024 voxels along it are few.
make_inputs() {
  voxelcore phantom torus --size 40,40,24 --spacing 0.5,0.5,1 -o scan.nii.gz -q
  voxelcore phantom torus --size 40,40,24 -o torus.nii -q
  cp scan.nii.gz truth.nii.gz
  cp scan.nii.gz network.nii.gz
  tail -c $((40 * 40 * 24)) torus.nii >scan.raw
  rm torus.nii
  voxelcore phantom root --size 40 -o root.nii.gz -q
  for day in 0 7 14; do cp root.nii.gz day$day.nii.gz; done
  voxelcore phantom root --size 40 -o softmax.nrrd -q # a map that is sure of each voxel
  voxelcore phantom root --size 40 -o huge.nrrd -q
  voxelcore phantom rod --size 40 -o stem.nrrd -q
  voxelcore phantom shell --size 32 -o vesicle.nrrd -q
  voxelcore phantom thick-and-thin --size 32 -o atlas.nii.gz -q
  voxelcore phantom root --size 40 -o vessels.nrrd -q
  mv vessels.nrrd vessels.seg.nrrd
  printf 'id,scan,lambda\nsub1,scan.nii.gz,1vox\nsub2,root.nii.gz,\n' >cohort.csv
  mkdir bones
  voxelcore phantom porous --size 20 -o bones/femur.nrrd -q
  printf 'id,scan,stems\nmaize1,root.nii.gz,1\n' >season.csv
  printf 'id,scan,b\npatient1,truth.nii.gz,network.nii.gz\n' >pairs.csv
  awk 'BEGIN {
    print "NRRD0004\ntype: short\ndimension: 3\nsizes: 20 20 20\nspace: left-posterior-superior"
    print "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: ascii\n"
    for (k = 0; k < 20; ++k) for (j = 0; j < 20; ++j) for (i = 0; i < 20; ++i)
      print int(1000 - 100 * sqrt((i - 9.6) ^ 2 + (j - 9.4) ^ 2 + (k - 9.5) ^ 2))
  }' >ct.nrrd
  awk 'function corner(c) { printf "%g %g %g\n", 10 * (c % 2), 0.2 * (int(c / 2) % 2), 0.2 * int(c / 4) }
  function side(a, b, c, d) { print 3, a, b, c; print 3, a, c, d }
  BEGIN {
    print "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z"
    print "element face 12\nproperty list uchar int vertex_indices\nend_header"
    for (c = 0; c < 8; ++c) corner(c)
    side(0, 2, 3, 1); side(4, 5, 7, 6); side(0, 1, 5, 4); side(2, 6, 7, 3); side(0, 4, 6, 2); side(1, 3, 7, 5)
  }' >part.ply
  awk 'function corner(c) { printf " vertex %g %g %g\n", 10 * (c % 2), 0.2 * (int(c / 2) % 2), 0.2 * int(c / 4) }
  function triangle(a, b, c) {
    print "facet normal 0 0 0\nouter loop"; corner(a); corner(b); corner(c); print "endloop\nendfacet" }
  function side(a, b, c, d) { triangle(a, b, c); triangle(a, c, d) }
  BEGIN { print "solid part"; side(0, 2, 3, 1); side(4, 5, 7, 6); side(0, 1, 5, 4); side(2, 6, 7, 3); side(0, 4, 6, 2)
    side(1, 3, 7, 5); print "endsolid part" }' >part.stl
}

# Lines of C++ that a page says are from an example stand there, in the same order, comments apart; the example is built
# and run by a test of its own.
quoted=0
check_quotes() {
  local before='' at=0 code=()
  while IFS=$'\t' read -r from line; do
    [ "$from" != - ] || fail "$1 does not say which example this C++ is from: $line"
    if [ "$from" != "$before" ]; then
      mapfile -t code < <(sed -E 's/^ +//; s/ *(\/\/.*)?$//' "$source/$from")
      before=$from
      at=0
    fi
    while [ "$at" -lt "${#code[@]}" ] && [ "${code[at]}" != "$line" ]; do
      at=$((at + 1))
    done
    [ "$at" -lt "${#code[@]}" ] || fail "$1 has C++ that $from does not have: $line"
    at=$((at + 1))
    quoted=$((quoted + 1))
  done < <(awk '
    match($0, /[Ff]rom `Testing\/[^`]*\.cxx`/) { source = substr($0, RSTART + 6, RLENGTH - 7); next }
    source != "" && /^    / { sub(/^ +/, ""); sub(/ *(\/\/.*)?$/, ""); print source "\t" $0; inside = 1; next }
    source != "" && inside && /^[^ ]/ { source = ""; inside = 0 }
    /^    .*[;{}]$/ || /^    #include/ { print "-\t" $0 }' "$1")
}

count=0
for page in "$source/README.md" "$guide"/*.md; do
  name=$(basename "$page" .md)
  check_quotes "$page"
  [ "$name" != tutorial ] || continue
  # Indented lines, and the second column of tables that map a shape to its command.
  commands=$(sed -nE -e 's/^    ((voxelcore |for k in ).*)$/\1/p' \
    -e 's/^\| [^|`]+ \| `(voxelcore [^`]+ -o [^`]+)` \|$/\1/p' "$page")
  [ -n "$commands" ] || continue
  mkdir "$folder/$name"
  cd "$folder/$name"
  make_inputs
  while IFS= read -r line; do
    if [[ $line == voxelcore\ render* ]] && ! command -v Xvfb >/dev/null; then
      continue
    fi
    count=$((count + 1))
    echo "+ $name: $line"
    bash -euc "$line" </dev/null || fail "$name.md: a command failed: $line"
  done <<<"$commands"
done
[ "$count" -ge 20 ] || fail "only $count commands were found"
[ "$quoted" -ge 15 ] || fail "only $quoted lines of C++ were found"
