#!/usr/bin/env bash
# Holds the house together: each room includes only headers of the rooms it may use (Modules/README.md), streets use no
# other street, Core no other group; what is otherwise stands among the exceptions, each with its reason, and goes from
# there when it is needed no more. Only ITK and the helper program (ItkReader/itk) know ITK and GDCM, only Models, VTK
# and Display know VTK. No two headers define a type of one name: all share a namespace, so the linker would take the
# functions of one for those of both.
# usage: layers.sh [FOLDER WITH Modules/]
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

core="Base Lattice Complex Shape Delaunay VoxelCore Refinement Skeleton Verification Certified"
scans="Labels Masks Formats ItkReader Imaging ITK"
models="Models VTK Display"
program="Report Jobs Options"

# may_use ROOM PART: `src` of a street is its mathematics, and knows Core alone.
may_use() {
  local cells="Base Lattice Complex Shape Delaunay"
  case "$1" in
    Base) echo "" ;;
    Lattice) echo "Base" ;;
    Complex | Shape) echo "Base Lattice" ;;
    Delaunay) echo "Base Lattice Shape" ;;
    VoxelCore) echo "$cells" ;;
    Refinement | Skeleton) echo "$cells VoxelCore" ;;
    Verification) echo "Base Lattice Complex Shape" ;;
    Certified) echo "$cells VoxelCore Refinement Skeleton Verification" ;;
    Labels) echo "Base Lattice Shape" ;;
    Masks) echo "Base Lattice Shape Labels" ;;
    Formats) echo "Base Lattice Shape Labels" ;;
    ItkReader) echo "Base Lattice Shape Labels Formats" ;;
    Imaging) echo "Base Lattice Shape Labels Formats ItkReader" ;;
    ITK) echo "$core Labels Masks Formats Imaging" ;;
    Models) echo "$cells VoxelCore Refinement Skeleton" ;;
    VTK) echo "$core Labels Masks Models" ;;
    Display) echo "$cells VoxelCore Skeleton Certified Labels Models" ;;
    Report) echo "$core Labels Masks Formats Imaging Models" ;;
    Jobs) echo "$core Labels Masks Formats ItkReader Imaging Models Display Report" ;;
    Options) echo "$core Labels Masks Formats Imaging Models Report Jobs" ;;
    *)
      if [ ! -d "Modules/Uses/$1" ]; then
        echo "layers.sh: no rule for the room $1; add one" >&2
        return 1
      elif [ "$2" = src ] && [ "$1" != Cohort ]; then
        echo "$core"
      else
        echo "$core $scans $models $program"
      fi
      ;;
  esac
}

# Room, whose headers it includes against the rule, and why this is so today.
exceptions=$(cat <<'END'
Certified Thickness | one request asks for cores and thickness, and the certificate of both is one
Certified Sheets    | the same of sheets
Sheets Thickness    | sheets are cut by who owns a voxel among balls, which Thickness paints
Report Vessels      | the report's struct has lesions as a member
Jobs Vessels        | core and skeleton write sections, branches, centerlines and flow of what they have made
Jobs Blocks         | core makes blocks and joins them; core --join takes their cells in place of its own
Jobs Meshes         | a mesh may stand wherever a scan may
Phantom Roots       | the truth of a phantom with roots is written as Roots writes its tables
Follow Roots        | a day of a series is written as RSML as Roots writes it
END
)

bad=0
complain() { echo "$1" >&2; bad=1; }
declare -A excepted needed
while read -r room other rest; do
  excepted[$room $other]=${rest#| }
done <<<"$exceptions"

for folder in Modules/*/*/; do
  room=$(basename "$folder")
  [[ $folder != Modules/CMake/* ]] || continue
  may_use "$room" src >/dev/null || { bad=1; continue; }
  src=" $room $(may_use "$room" src) "
  all=" $room $(may_use "$room" all) "
  while IFS=: read -r file line included; do
    [[ $included =~ [\<\"]([^\>\"]+)[\>\"] ]] || continue
    name=${BASH_REMATCH[1]}
    if [[ $name =~ ^voxelcore/(.*)$ ]]; then
      owner=${BASH_REMATCH[1]%%/*}
      allowed=$all
      [[ $file != "$folder"src/* ]] || allowed=$src
      if [ "$owner" = "${BASH_REMATCH[1]}" ]; then
        complain "$file:$line: $name names no room"
      elif [[ $allowed != *" $owner "* ]]; then
        needed[$room $owner]=yes
        [ -n "${excepted[$room $owner]:-}" ] || complain "$file:$line: $room must not use $owner ($name)"
      fi
      if [[ $file = "$folder"include/* ]] && compgen -G "Modules/*/*/inner/$name" >/dev/null; then
        complain "$file:$line: a public header includes one that users do not have ($name)"
      fi
    fi
    case "$name" in
      itk* | gdcm*) [[ "$room" = ITK || "$file" = Modules/Scans/ItkReader/itk/* ]] ||
        complain "$file:$line: only ITK and Modules/Scans/ItkReader/itk know ITK ($name)" ;;
      voxelcore/Models/ModelPolyData.h | vtk*) [[ "$room" = Models || "$room" = VTK || "$room" = Display ]] ||
        complain "$file:$line: only Models, VTK and Display know VTK ($name)" ;;
      tetgen.h) [ "$file" = Modules/Core/Delaunay/src/TetGenEngine.cxx ] ||
        complain "$file:$line: TetGen belongs in one file" ;;
    esac
    if [[ "$name" = *.h && -e "Modules/Scans/ItkReader/itk/$name" && "$file" != Modules/Scans/ItkReader/itk/* ]]; then
      complain "$file:$line: what the helper program is made of is its own ($name)"
    fi
  done < <(grep -rnE '^ *# *include' "$folder" --include='*.h' --include='*.hxx' --include='*.cxx')
done
for pair in "${!excepted[@]}"; do
  [ -n "${needed[$pair]:-}" ] || complain "layers.sh: ${pair/ / no longer uses }; take the exception away"
done
while read -r name; do
  complain "$name is defined in two headers: $(grep -rlE "^(class|struct) $name( .*[^;])?\$" Modules --include='*.h' |
    tr '\n' ' ')"
done < <(grep -rhE '^(class|struct) [A-Z][A-Za-z0-9]*( .*[^;])?$' Modules --include='*.h' | awk '{print $2}' | sort |
  uniq -d)
[ "$bad" -eq 0 ] && echo "All includes point the right way; ${#excepted[@]} exceptions."
exit "$bad"
