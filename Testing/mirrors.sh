#!/usr/bin/env bash
# Holds the mirror: every public header Modules/<Group>/<Room>/include/voxelcore/<Room>/<File>.h has its tests
# in Testing/<Group>/<Room>/<File>GTest.cxx, and these are built. usage: mirrors.sh [FOLDER WITH Modules/ AND Testing/]
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

headers=0
bad=0
complain() { echo "$1" >&2; bad=1; }
for header in Modules/*/*/include/voxelcore/*/*.h; do
  headers=$((headers + 1))
  module=${header#Modules/}
  module=${module%%/include/*}
  [[ $header = Modules/$module/include/voxelcore/${module#*/}/* ]] || complain "$header: lies in another room's folder"
  test=$(basename "$header" .h)GTest.cxx
  if [ ! -e "Testing/$module/$test" ]; then
    complain "$header: lacks its tests, Testing/$module/$test"
  elif ! grep -qw "$test" "Testing/$module/CMakeLists.txt"; then
    complain "Testing/$module/$test: is not in Testing/$module/CMakeLists.txt"
  fi
done
[ "$headers" -gt 100 ] || complain "mirrors.sh: no headers here"
[ "$bad" -eq 0 ] && echo "Every public header has its tests."
exit "$bad"
