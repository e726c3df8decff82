#!/usr/bin/env bash
# What C++20 has and WebAssembly's library lacks comes from voxelcore/Base/Library.h alone: no other source names it,
# and of each room of mathematics one source is compiled by that header's own part.
# usage: plain_library.sh COMPILER
set -euo pipefail
compiler=$1
cd "$(dirname "${BASH_SOURCE[0]}")/../../Modules"

bad=0
complain() { echo "$1" >&2; bad=1; }
# Left out: what is not part of the program as WebAssembly.
names='std::(ranges|views)::|std::(bit_cast|atomic_ref|make_unique_for_overwrite|jthread|stop_token|source_location)\b'
names+='|std::(from_chars|to_chars|format)\('
found=$(grep -rnE "$names" . ../Applications/voxelcore --include='*.h' --include='*.cxx' |
  grep -vE '^\./(Models/(Display|VTK)|Scans/(ITK|ItkReader/itk))/|/Base/Library\.h:' || true)
[ -z "$found" ] || complain "$found
these are to be taken from voxelcore/Base/Library.h"

includes=()
for folder in */*/include */*/inner; do
  includes+=(-I "$folder")
done
compiled=0
used='ranges::|bit_cast|atomic_ref|make_unique_for_overwrite|(from|to)_chars'
for src in Core/*/src Scans/{Labels,Masks}/src Uses/{Blocks,Meshes,Phantom,Roots,Sheets,Thickness,Vessels}/src; do
  source=$(grep -lE "$used" "$src"/*.cxx | head -n 1 || true)
  [ -n "$source" ] || continue
  compiled=$((compiled + 1))
  "$compiler" -std=gnu++20 -fsyntax-only -fopenmp -DVOXELCORE_PLAIN_LIBRARY "${includes[@]}" "$source" ||
    complain "$source: does not compile by the part of Library.h for libraries that lack it"
done
[ "$compiled" -ge 12 ] || complain "plain_library.sh: only $compiled rooms use it"
[ "$bad" -eq 0 ] && echo "One source of each of $compiled rooms compiles without all of the library."
exit "$bad"
