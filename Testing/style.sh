#!/usr/bin/env bash
# Holds the layout of the sources: clang-format 14 with .clang-format, and no line of C++, Python, shell or CMake over
# 120 columns. usage: style.sh [FOLDER]     exit 77: there is no clang-format 14
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

formatter=$(command -v clang-format-14 || command -v clang-format || true)
if [ -z "$formatter" ] || ! "$formatter" --version | grep -q 'version 14\.'; then
  echo "style.sh: no clang-format 14 here" >&2
  exit 77
fi
list=$(mktemp)
trap 'rm -f "$list"' EXIT
find Modules Applications Testing -name '*.h' -o -name '*.hxx' -o -name '*.cxx' >"$list"
[ "$(wc -l <"$list")" -gt 100 ] || { echo "style.sh: no sources here" >&2; exit 1; }
bad=0
xargs -P "$(nproc)" -n 40 "$formatter" --dry-run --Werror <"$list" || bad=1
# Mangled names are as long as they are.
long=$({ cat "$list"; find CMakeLists.txt Modules Applications Testing \( -name '*.py' -o -name '*.pyi' \
  -o -name '*.sh' -o -name CMakeLists.txt -o -name '*.cmake' -o -name '*.cmake.in' \) -not -path '*/__pycache__/*'; } |
  LC_ALL=C.UTF-8 xargs grep -nHE '^.{121,}' | grep -v ': *_Z' || true)
[ -z "$long" ] || { echo "$long" >&2; bad=1; }
[ "$bad" -eq 0 ] && echo "All sources are laid out as .clang-format says."
exit "$bad"
