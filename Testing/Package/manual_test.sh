#!/usr/bin/env bash
# Manual pages are clean roff and name every option of --help; completion offers what there is.
# usage: manual_test.sh PROGRAM FOLDER      FOLDER: where voxelcore_manual wrote
set -euo pipefail

program=$1
folder=$2
fail() {
  echo "manual_test.sh: $1" >&2
  exit 1
}

commands=$("$program" --help | sed -n '/^Commands:/,/^$/p' | awk '/^  [a-z]/ {print $1}')
[ "$(wc -w <<<"$commands")" -ge 7 ] || fail "which commands are there? $commands"
for page in voxelcore $(sed 's/^/voxelcore-/' <<<"$commands"); do
  [ -s "$folder/$page.1" ] || fail "no page $page.1"
  if command -v groff >/dev/null; then
    complaints=$(groff -man -Tutf8 -ww -z "$folder/$page.1" 2>&1)
    [ -z "$complaints" ] || fail "$page.1: $complaints"
    groff -man -Tascii -P-c "$folder/$page.1" | col -bx >"$folder/$page.txt"
  fi
done
for command in $commands; do
  offered=$(bash -c '
    source "$1"; COMP_WORDS=(voxelcore "$2" -); COMP_CWORD=2; _voxelcore; printf "%s\n" "${COMPREPLY[@]}"
  ' bash "$folder/voxelcore.bash" "$command")
  page=$(sed 's/\\-/-/g' "$folder/voxelcore-$command.1")
  # Lines of options begin with them, in two columns.
  options=$("$program" "$command" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+')
  [ "$(wc -w <<<"$options")" -ge 3 ] || fail "which options has $command? $options"
  for option in $options; do
    grep -qxF -- "$option" <<<"$offered" || fail "$command: completion lacks $option"
    [ "$option" = --help ] || grep -qF -- "$option" <<<"$page" || fail "voxelcore-$command.1 lacks $option"
  done
done
first=$(bash -c 'source "$1"; COMP_WORDS=(voxelcore sk); COMP_CWORD=1; _voxelcore; echo "${COMPREPLY[*]}"' bash \
  "$folder/voxelcore.bash")
[ "$first" = skeleton ] || fail "'sk' is completed to '$first'"
engines=$(bash -c 'source "$1"; COMP_WORDS=(voxelcore core --engine ""); COMP_CWORD=3; _voxelcore
  echo "${COMPREPLY[*]}"' \
  bash "$folder/voxelcore.bash")
[ "$engines" = "auto lattice tetgen" ] || fail "engines are '$engines'"
if command -v zsh >/dev/null; then
  zsh -n "$folder/_voxelcore"
fi
