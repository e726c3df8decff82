#!/usr/bin/env bash
# The reference is made without a warning, and its main page has the picture.
# usage: doxygen_test.sh DOXYFILE FOLDER      exit 77: doxygen or dot is not installed
set -euo pipefail

for tool in doxygen dot; do
  command -v "$tool" >/dev/null || { echo "doxygen_test.sh: $tool is not installed" >&2; exit 77; }
done
rm -rf "$2/html"
mkdir -p "$2"
said=$(doxygen "$1" 2>&1) || { echo "$said" >&2; exit 1; }
[ -z "$said" ] || { echo "$said" >&2; exit 1; }
grep -q 'dot_inline_dotgraph_1.svg' "$2/html/index.html"
grep -q 'the core and its pruning' "$2"/html/dot_inline_dotgraph_1.svg
[ -s "$2/html/LambdaPruning_8h.html" ]
