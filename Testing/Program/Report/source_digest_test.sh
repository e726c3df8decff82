#!/usr/bin/env bash
# The program names the sources it was built from: their digest is that of the files as they are, another one when a
# byte or a name is another, and the same wherever they lie.
# usage: source_digest_test.sh PROGRAM MODULES
set -euo pipefail

program=$1
modules=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
digest() {
  cmake -DMODULES="$1" -DOUT="$work/digest.h" -P "$modules/CMake/SourceDigest.cmake"
  sed -n 's/.*"\([0-9a-f]\{16\}\)"$/\1/p' "$work/digest.h"
}
fail() {
  echo "source_digest_test.sh: $1" >&2
  exit 1
}
now=$(digest "$modules")
[ -n "$now" ] || fail "no digest"
"$program" --version | grep -qx "sources: $now" || fail "the program is built from other sources than $now"
mkdir "$work/copy"
cp -r "$modules"/* "$work/copy"
[ "$(digest "$work/copy")" = "$now" ] || fail "the place matters"
echo >>"$work/copy/README.md"
[ "$(digest "$work/copy")" = "$now" ] || fail "what makes no results matters"
echo >>"$work/copy/Core/Lattice/src/Predicates.cxx"
[ "$(digest "$work/copy")" != "$now" ] || fail "another byte does not matter"
cp "$modules/Core/Lattice/src/Predicates.cxx" "$work/copy/Core/Lattice/src/"
[ "$(digest "$work/copy")" = "$now" ] || fail "the same files have another digest"
mv "$work/copy/Core/Lattice/src/Predicates.cxx" "$work/copy/Core/Lattice/src/Predicates2.cxx"
[ "$(digest "$work/copy")" != "$now" ] || fail "another name does not matter"
