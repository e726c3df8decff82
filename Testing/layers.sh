#!/usr/bin/env bash
# Holds the house together: each module includes only headers of the modules it may use (Modules/README.md), and only
# module ITK and the helper program (Modules/ItkReader/itk) know ITK and GDCM, only Models and Display know VTK, only
# Display its rendering. No two headers define a type of one name: all share a namespace, so the linker
# would take the functions of one for those of both.
# usage: layers.sh [FOLDER WITH Modules/]
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

may_use() {
  local mathematics="Lattice Shape Complex Delaunay VoxelCore Refinement Skeleton Vessels Thickness Verification"
  mathematics="$mathematics Certified"
  case "$1" in
    Lattice) echo "" ;;
    Shape | Complex) echo "Lattice" ;;
    Blocks) echo "Lattice Shape Delaunay" ;;
    Delaunay | Voxelization | Phantom) echo "Lattice Shape" ;;
    Thickness) echo "Lattice Shape Complex Delaunay VoxelCore Refinement" ;;
    VoxelCore) echo "Lattice Shape Complex Delaunay" ;;
    Refinement | Skeleton) echo "Lattice Shape Complex Delaunay VoxelCore" ;;
    Vessels) echo "Lattice Shape Complex Delaunay VoxelCore Refinement Skeleton" ;;
    Verification) echo "Lattice Shape Complex" ;;
    Certified) echo "Lattice Shape Complex Delaunay VoxelCore Refinement Skeleton Thickness Verification" ;;
    Formats) echo "Lattice Shape" ;;
    ItkReader) echo "Lattice Shape Formats" ;;
    Imaging) echo "Lattice Shape Formats ItkReader" ;;
    ITK) echo "$mathematics Formats Imaging" ;;
    Models) echo "$mathematics Voxelization" ;;
    Display) echo "Lattice Shape Complex Delaunay VoxelCore Skeleton Vessels Models Certified" ;;
    Report) echo "$mathematics Formats Imaging Models" ;;
    Jobs) echo "$mathematics Blocks Voxelization Phantom Formats ItkReader Imaging Models Display Report" ;;
    Options) echo "Lattice Shape VoxelCore Skeleton Vessels Certified Formats Imaging Models Report Jobs" ;;
    Cohort) echo "Lattice Shape Complex Delaunay VoxelCore Refinement Skeleton Vessels Certified Formats Imaging" \
                 "Models Report Jobs Options" ;;
    *) echo "layers.sh: no rule for module $1; add one" >&2; return 1 ;;
  esac
}

declare -A home
for header in Modules/*/include/voxelcore/*.h; do
  module=${header#Modules/}
  home[voxelcore/${header##*/}]=${module%%/*}
done

bad=0
complain() { echo "$1" >&2; bad=1; }
for folder in Modules/*/; do
  module=$(basename "$folder")
  [ "$module" != CMake ] || continue
  allowed=" $module $(may_use "$module") "
  while IFS=: read -r file line included; do
    [[ $included =~ [\<\"]([^\>\"]+)[\>\"] ]] || continue
    name=${BASH_REMATCH[1]}
    owner=${home[$name]:-}
    if [ -n "$owner" ] && [[ $allowed != *" $owner "* ]]; then
      complain "$file:$line: $module must not use $owner ($name)"
    fi
    case "$name" in
      itk* | gdcm*) [[ "$module" = ITK || "$file" = Modules/ItkReader/itk/* ]] ||
        complain "$file:$line: only module ITK and Modules/ItkReader/itk know ITK ($name)" ;;
      voxelcore/ModelPolyData.h) [[ "$module" = Models || "$module" = Display ]] ||
        complain "$file:$line: only Models and Display know VTK ($name)" ;;
      vtk*) [[ "$module" = Models || "$module" = Display ]] ||
        complain "$file:$line: only Models and Display know VTK ($name)" ;;
      tetgen.h) [ "$file" = Modules/Delaunay/src/TetGenEngine.cxx ] ||
        complain "$file:$line: TetGen belongs in one file" ;;
    esac
    if [[ "$name" = *.h && -e "Modules/ItkReader/itk/$name" && "$file" != Modules/ItkReader/itk/* ]]; then
      complain "$file:$line: what the helper program is made of is its own ($name)"
    fi
  done < <(grep -rnE '^ *# *include' "$folder" --include='*.h' --include='*.hxx' --include='*.cxx')
done
while read -r name; do
  complain "$name is defined in two headers: $(grep -rlE "^(class|struct) $name( .*[^;])?\$" Modules --include='*.h' |
    tr '\n' ' ')"
done < <(grep -rhE '^(class|struct) [A-Z][A-Za-z0-9]*( .*[^;])?$' Modules --include='*.h' | awk '{print $2}' | sort |
  uniq -d)
[ "$bad" -eq 0 ] && echo "All includes point the right way."
exit "$bad"
