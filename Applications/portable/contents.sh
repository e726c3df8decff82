#!/usr/bin/env bash
# Says in a package what is in it: licences/NAME.txt of each part, and SOURCES, a line with its version.
# usage: contents.sh FOLDER LIBRARIES PACKAGE...     LIBRARIES: what libraries.sh made; PACKAGE: of Debian, besides
set -euo pipefail
folder=$1
libraries=$2
shift 2
mkdir -p "$folder/licences"
cp "$libraries/licences/"*.txt "$folder/licences/"
cp "$libraries/sources" "$folder/SOURCES"
for package in libboost-dev libcli11-dev nlohmann-json3-dev "$@"; do
  cp "/usr/share/doc/$package/copyright" "$folder/licences/$package.txt"
  dpkg-query -W -f='${Package} ${Version}\n' "$package" | head -n 1 >>"$folder/SOURCES"
done
