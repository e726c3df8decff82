#!/usr/bin/env bash
# A program or plugin that links VoxelCore exports what is meant, and nothing of VoxelCore or of the libraries it uses.
# What the compiler makes of templates of namespace std is always exported.
# usage: symbols_test.sh FILE [MEANT...]      FILE: a program or shared library; MEANT: names of symbols
set -euo pipefail

file=$1
shift
exported=$(nm -D --defined-only "$file" | awk '{print $NF}' | c++filt | sed -E 's/@.*//')
left=$(grep -vE \
  -e '^((typeinfo( name)?|vtable|VTT|guard variable|construction vtable) for |[a-z ]+ )?(std|__gnu_cxx)::' \
  -e '^_(init|fini|IO_stdin_used)$|^__(bss_start|libc_single_threaded)$|^_(edata|end)$|^std[a-z]+$' \
  <<<"$exported" | sort -u || true)
wanted=$(printf '%s\n' "$@" | sort -u)
if [ "$left" != "$wanted" ]; then
  echo "symbols_test.sh: $file exports" >&2
  diff <(echo "$wanted") <(echo "$left") | head -30 >&2
  exit 1
fi
