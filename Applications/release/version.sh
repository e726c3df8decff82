#!/usr/bin/env bash
# Says the version, which stands in CMakeLists.txt, and that nothing else says another.
# usage: version.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
version=$(sed -nE 's/^project\(VoxelCore VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)
cited=$(sed -n 's/^version: //p' CITATION.cff)
described=$(sed -nE 's/^  "version": "(.*)",$/\1/p' Applications/release/codemeta.json)
newest=$(sed -nE 's/^## ([0-9]+\.[0-9]+\.[0-9]+).*/\1/p' Applications/manual/CHANGELOG.md | head -n 1)
packaged=$(sed -nE '1s/^voxelcore \(([0-9.]+)-[0-9]+\) .*/\1/p' Applications/debian/changelog)
if [ -z "$version" ] || [ "$cited $described $newest $packaged" != "$version $version $version $version" ]; then
  echo "version.sh: CMakeLists.txt says '$version', CITATION.cff '$cited'," \
    "codemeta.json '$described', CHANGELOG.md '$newest', debian/changelog '$packaged'" >&2
  exit 1
fi
echo "$version"
