#!/usr/bin/env bash
# Looks for names that two sources define differently: two structs, or two functions, of one name and namespace. The
# linker takes one of them, another one in another build. First that a seeded clash of each kind is found; then that
# none is in the modules and the program. The objects are those of the Debug build (debug.sh), which both kinds of check
# need.
# usage: odr.sh BUILD_DIR
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mkdir -p "$1/odr"
build=$(cd "$1" && pwd)
seed=$build/odr

compile=(-std=gnu++20 -O0 -g1 -flto -ffat-lto-objects)

# where FOLDER OBJECTS...: names of functions that stand at two places of a folder's sources, each with its places.
# Finds those of equal size, too, which gold passes over.
where() {
  local object folder=$1
  for object in "${@:2}"; do
    objcopy -w -R '.gnu.lto_*' -R '.gnu.debuglto_*' "$object" "$seed/plain.o" # nm would look at these alone
    nm -l --defined-only "$seed/plain.o"
  done | awk -F '\t' -v folder="$folder" 'NF == 2 && index($2, folder) {
      split($1, part, " ")
      # What the compiler makes itself, constructors say, bears the line of its class and the name of any source. Only
      # another line is another definition.
      line = $2
      sub(/.*:/, "", line)
      if (part[2] ~ /^[TW]$/ && !seen[part[3], line]++ && seen[part[3]]++) { twice[part[3]] }
      if (part[2] ~ /^[TW]$/) { places[part[3]] = places[part[3]] " " $2 }
    }
    END { for (name in twice) { n = split(places[name], all, " "); line = name ":"
            for (i = 1; i <= n; ++i) { if (!shown[name, all[i]]++) { line = line " " all[i] } }
            print line " defined in two ways" } }' | c++filt
}

# check FOLDER LOG OBJECTS AND LIBRARIES...: links them twice; GCC compares types, gold the sizes of functions and,
# where these differ, their places. `where` compares all places.
check() {
  local folder=$1 log=$2
  shift 2
  : >"$log"
  g++ -O0 -flto=auto -Wodr -Wlto-type-mismatch "$@" -o "$log.lto" >>"$log" 2>&1 || { cat "$log" >&2; exit 1; }
  g++ -fno-lto -fuse-ld=gold -Wl,--detect-odr-violations "$@" -o "$log.gold" >>"$log" 2>&1 ||
    { cat "$log" >&2; exit 1; }
  rm -f "$log.lto" "$log.gold"
  local word objects=()
  for word in "$@"; do
    [[ $word != *.o ]] || objects+=("$word")
  done
  where "$folder" "${objects[@]}" >>"$log"
  ! grep -qE 'Wodr|Wlto-type-mismatch|possible ODR violation|defined in two ways' "$log"
}

# must_find KIND WORDS: the clash of two sources is found, by the check that says so.
must_find() {
  if check "$seed" "$seed/$1.log" "$seed/$1-a.o" "$seed/$1-b.o" || ! grep -q "$2" "$seed/$1.log"; then
    echo "odr.sh: a seeded clash of $1 was not found" >&2
    exit 1
  fi
}

cat >"$seed/types-a.cxx" <<'END'
namespace seeded { struct File { int a; }; int Use(File & file) { return file.a; } }
END
cat >"$seed/types-b.cxx" <<'END'
namespace seeded { struct File { double b; char c; }; int Use(File & file); }
int main() { seeded::File file{}; return seeded::Use(file); }
END
cat >"$seed/functions-a.cxx" <<'END'
namespace seeded {
inline int Parse(int a)
{
  return a + 1;
} }
int Other() { return seeded::Parse(1); }
END
cat >"$seed/functions-b.cxx" <<'END'
namespace seeded {

inline int Parse(int a)
{
  return a * a * a * a;
} }
int Other();
int main() { return seeded::Parse(1) + Other(); }
END
cp "$seed/functions-a.cxx" "$seed/equal-a.cxx"
sed 's/a \* a \* a \* a/a - 1/' "$seed/functions-b.cxx" >"$seed/equal-b.cxx"
cp "$seed/functions-a.cxx" "$seed/strong-a.cxx"
sed 's/inline //; s/a \* a \* a \* a/a - 1/' "$seed/functions-b.cxx" >"$seed/strong-b.cxx"
declare -A words=([types]=Wodr [functions]='possible ODR violation' [equal]='two ways' [strong]='two ways')
for kind in "${!words[@]}"; do
  for part in a b; do
    g++ "${compile[@]}" -c "$seed/$kind-$part.cxx" -o "$seed/$kind-$part.o"
  done
  must_find "$kind" "${words[$kind]}"
done

bash "$source/Testing/debug.sh" "$build" voxelcore
ninja -C "$build" -t cleandead >/dev/null # objects of sources that are gone

# check_program TARGET OBJECTS...: with what the program is linked with apart from our own objects and archives.
check_program() {
  local word libraries=()
  for word in $(ninja -C "$build" -t commands "$1" | tail -1); do
    case "$word" in
      Modules/*) ;;
      *.so | *.so.* | -l* | /*.a) libraries+=("$word") ;;
    esac
  done
  if ! check /Modules/ "$seed/$1.log" "${@:2}" "${libraries[@]}"; then
    cat "$seed/$1.log" >&2
    exit 1
  fi
  echo "$1: $(($# - 1)) objects, no name defined in two ways."
}

# objects_in FOLDER...: of these folders of the build; the helper program, with a main of its own, apart.
objects_in() { find "${@/#/$build/}" -path '*.dir/*' -name '*.cxx.o' "${filter[@]}" | sort; }
filter=(-not -path '*itk_reader*')
# A build that went on may hold modules that the program does not.
mapfile -t modules < <(ninja -C "$build" -t commands voxelcore | tail -1 |
  grep -oE '\bModules/[A-Za-z]+/[A-Za-z]+' | sort -u)
mapfile -t objects < <(objects_in "${modules[@]}" Applications/voxelcore)
check_program voxelcore "${objects[@]}"
if [ -e "$build/Modules/Scans/ItkReader/CMakeFiles/voxelcore_itk_reader.dir" ]; then
  mapfile -t objects < <(objects_in Modules/Core/Base Modules/Core/Lattice Modules/Core/Shape Modules/Scans/Labels)
  filter=(-path '*itk_reader*')
  mapfile -t -O "${#objects[@]}" objects < <(objects_in Modules/Scans/ItkReader)
  check_program voxelcore_itk_reader "${objects[@]}"
fi
