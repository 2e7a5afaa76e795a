#!/bin/sh
# Writes the table of methods, from `motus methods --markdown`, between its markers in doc/manual.md; and the pictures of the cookbook.
set -eu
cd "$(dirname "$0")/.."
table=$(mktemp)
trap 'rm -f "$table" doc/manual.md.new' EXIT
"${MOTUS:-build/motus}" methods --markdown >"$table"
awk -v table="$table" '
    /<!-- \/methods -->/ { inside = 0 }
    !inside { print }
    /<!-- methods -->/ { inside = 1; while ((getline line < table) > 0) print line }
' doc/manual.md >doc/manual.md.new
mv doc/manual.md.new doc/manual.md
tasks=$(mktemp -d)
MOTUS=${MOTUS:-build/motus} cmake/cookbook.sh "$tasks"
mv "$tasks"/*.png doc/cookbook/
rm -r "$tasks"
