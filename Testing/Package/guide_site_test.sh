#!/usr/bin/env bash
# The guide builds as a site that opens from disk, is searchable, and asks nothing of a network.
# usage: guide_site_test.sh SOURCE_DIR      exit 77: mkdocs is missing
set -euo pipefail

command -v mkdocs >/dev/null || { echo "guide_site_test.sh: mkdocs is not installed" >&2; exit 77; }
site=$(mktemp -d)
trap 'rm -rf "$site"' EXIT
mkdocs build --quiet --strict --config-file "$1/Applications/manual/mkdocs.yml" --site-dir "$site"
for page in "$1"/Applications/manual/guide/*.md; do
  [ -s "$site/$(basename "$page" .md).html" ] || { echo "guide_site_test.sh: $page is not in the site" >&2; exit 1; }
done
grep -q '"Choosing the pruning' "$site/search/search_index.json" ||
  { echo "guide_site_test.sh: no search" >&2; exit 1; }
if grep -rnE '<(script|link|img)[^>]*(src|href)="(https?:)?//' "$site" --include='*.html'; then
  echo "guide_site_test.sh: the site needs a network" >&2
  exit 1
fi
