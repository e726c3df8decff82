#!/usr/bin/env bash
# Holds the mirror: every public header Modules/<Group>/<Room>/include/voxelcore/<Room>/<File>.h has its tests in
# Testing/<Group>/<Room>/<File>GTest.cxx, and these are built; tests named after an inner header are built, too. Public
# headers are few, as whoever uses the library must find a way through them: what only our own rooms and programs use
# belongs into inner. usage: mirrors.sh [FOLDER WITH Modules/ AND Testing/]
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

most=130
headers=0
bad=0
complain() { echo "$1" >&2; bad=1; }
for header in Modules/*/*/{include,inner}/voxelcore/*/*.h; do
  module=${header#Modules/}
  module=${module%%/in*/voxelcore/*}
  [[ $header = Modules/$module/in*/voxelcore/${module#*/}/* ]] || complain "$header: lies in another room's folder"
  test=$(basename "$header" .h)GTest.cxx
  if [[ $header = Modules/$module/include/* ]]; then
    headers=$((headers + 1))
    [ -e "Testing/$module/$test" ] || complain "$header: lacks its tests, Testing/$module/$test"
  fi
  if [ -e "Testing/$module/$test" ] && ! grep -qw "$test" "Testing/$module/CMakeLists.txt"; then
    complain "Testing/$module/$test: is not in Testing/$module/CMakeLists.txt"
  fi
done
[ "$headers" -gt 100 ] || complain "mirrors.sh: no headers here"
[ "$headers" -le "$most" ] || complain "mirrors.sh: $headers public headers, at most $most; move some to inner"
[ "$bad" -eq 0 ] && echo "Every public header has its tests."
exit "$bad"
