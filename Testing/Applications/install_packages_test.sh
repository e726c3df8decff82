#!/usr/bin/env bash
# Holds what Applications/install-packages.sh promises, with stand-ins for dpkg-query, apt-get, id and sudo.
# usage: install_packages_test.sh SCRIPT
set -euo pipefail
script=$(realpath "$1")
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
tools=$room/tools
mkdir "$tools"
for tool in bash env; do
  ln -s "$(command -v $tool)" "$tools/$tool"
done

stand_in() { # NAME BODY
  printf '#!%s\n%s\n' "$tools/bash" "$2" >"$tools/$1"
  chmod +x "$tools/$1"
}
run() { # expected exit code, words...: all must occur in the output
  local expected=$1 code=0
  shift
  : >"$room/calls"
  env -i PATH="$tools" "$tools/bash" "$script" build demo test >"$room/output" 2>&1 </dev/null || code=$?
  if [ "$code" -ne "$expected" ]; then
    echo "$case: exit code $code instead of $expected"; cat "$room/output"; exit 1
  fi
  for word in "$@"; do
    if ! grep -q -- "$word" "$room/output" "$room/calls"; then
      echo "$case: '$word' does not occur"; cat "$room/output" "$room/calls"; exit 1
    fi
  done
}

nothing_installed='exit 1'
all_installed='printf installed'
all_but_one='case "$*" in *ninja-build*) exit 1 ;; *removed*) printf not-installed ;; *) printf installed ;; esac'

case="all there: no apt call at all"
stand_in dpkg-query "$all_installed"
stand_in apt-get "echo \"apt-get \$*\" >>$room/calls"
stand_in id 'echo 0'
run 0
[ ! -s "$room/calls" ] || { echo "$case"; cat "$room/calls"; exit 1; }

case="one missing, root: update once, install it alone, without recommends"
stand_in dpkg-query "$all_but_one"
run 0 "apt-get -y -q update" "apt-get -y -q install --no-install-recommends ninja-build$"
[ "$(grep -c update "$room/calls")" -eq 1 ]

case="nothing there: the packages of every group are asked for once"
stand_in dpkg-query "$nothing_installed"
run 0 libvtk9-dev mricron-data libgtest-dev

case="no apt-get: says what is missing and stops"
mv "$tools/apt-get" "$room/apt-get"
run 1 "Cannot install" libvtk9-dev ninja-build mricron-data
mv "$room/apt-get" "$tools/apt-get"

case="neither root nor sudo: says what is missing and stops"
stand_in id 'echo 1000'
stand_in dpkg-query "$all_but_one"
run 1 "neither root nor sudo" "are missing: ninja-build$"
[ ! -s "$room/calls" ]

case="sudo that asks for a password nobody can type: stops"
stand_in sudo "echo \"sudo \$*\" >>$room/calls; exit 1"
run 1 "sudo refused" "missing: ninja-build" "sudo -n true"

case="sudo: apt runs through it"
stand_in sudo "echo \"sudo \$*\" >>$room/calls; shift; \"\$@\""
stand_in true ''
run 0 "sudo -n env DEBIAN_FRONTEND=noninteractive apt-get -y -q install"

case="apt-get fails: says so and stops"
stand_in id 'echo 0'
stand_in apt-get 'exit 100'
run 1 "update' failed" "missing: ninja-build"

case="unknown group"
code=0
bash "$script" nonsense >/dev/null 2>&1 || code=$?
[ "$code" -ne 0 ]
echo "install-packages.sh holds what it promises"
