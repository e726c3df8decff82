#!/usr/bin/env bash
# Says the version, which stands in CMakeLists.txt, and that nothing else says another.
# usage: version.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
version=$(sed -nE 's/^project\(VoxelCore VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)
cited=$(sed -n 's/^version: //p' CITATION.cff)
described=$(sed -nE 's/^  "version": "(.*)",$/\1/p' Applications/release/codemeta.json)
newest=$(sed -nE 's/^## ([0-9]+\.[0-9]+\.[0-9]+).*/\1/p' Applications/manual/CHANGELOG.md | head -n 1)
if [ -z "$version" ] || [ "$cited $described $newest" != "$version $version $version" ]; then
  echo "version.sh: CMakeLists.txt says '$version', CITATION.cff '$cited'," \
    "codemeta.json '$described', CHANGELOG.md '$newest'" >&2
  exit 1
fi
echo "$version"
