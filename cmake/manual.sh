#!/bin/sh
# Writes what the program says of itself between its markers: the methods, verbs and options in doc/manual.md, verbs and options in
# doc/motus.1; and the pictures of the cookbook. The texts alone into another folder: cmake/manual.sh FOLDER
set -eu
cd "$(dirname "$0")/.."
motus=${MOTUS:-build/motus}
out=${1:-doc}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
# Standard input goes between the markers $3 and $4 of file $1, which becomes $2.
put() {
    cat >"$place/part"
    awk -v part="$place/part" -v begin="$3" -v end="$4" '
        index($0, end) { inside = 0 }
        !inside { print }
        index($0, begin) { inside = 1; while ((getline line < part) > 0) print line }' "$1" >"$place/new"
    cp "$place/new" "$2"
}
"$motus" --options >"$place/table"
"$motus" methods --markdown | put doc/manual.md "$out/manual.md" '<!-- methods -->' '<!-- /methods -->'
awk -F'\t' '$1 == "verb" { printf "    motus %-8s %-32s  %s\n", $2, $3, $4 }' "$place/table" | put "$out/manual.md" "$out/manual.md" '<!-- verbs -->' '<!-- /verbs -->'
awk -F'\t' '
    BEGIN { print "| option | of | meaning |"; print "|---|---|---|" }
    $1 == "verb" { all = all (all ? "," : "") $2 }
    $1 == "option" {
        gsub(/\|/, "\\|")
        verbs = $5 == all ? "all" : $5
        gsub(/,/, ", ", verbs)
        print "| " ($3 == "-" ? "" : "`" $3 "`, ") "`" $2 ($4 == "-" ? "" : " " $4) "` | " verbs " | " $8 ($9 ? ". " $9 : "") " |"
    }' "$place/table" | put "$out/manual.md" "$out/manual.md" '<!-- options -->' '<!-- /options -->'
# To roff: no code quotes and links, and what roff reads otherwise is escaped.
plain='s/\[\([^]]*\)\](#[^)]*)/\1/g; s/`//g; s/\\/\\e/g; s/-/\\-/g; s/'\''/\\(aq/g; s/…/.../g'
sed "$plain" "$place/table" | awk -F'\t' '$1 == "verb" { print "\\fBmotus " $2 "\\fR " $3 " [options]\n.br" }' |
    put doc/motus.1 "$out/motus.1" '" synopsis' '" /synopsis'
cut -f 2 "$place/table" | sed -n '/^[a-z]/p' | while read -r verb; do
    printf '.TP\n.B %s\n' "$verb"
    "$motus" "$verb" --help | awk '/^options:/ { exit } NR > 2 && $0' | sed "$plain"
done | put "$out/motus.1" "$out/motus.1" '" verbs' '" /verbs'
sed "$plain" "$place/table" | awk -F'\t' '$1 == "option" {
    gsub(/,/, ", ", $5)
    print ".TP\n" ($3 == "\\-" ? "" : "\\fB" $3 "\\fR, ") "\\fB" $2 "\\fR" ($4 == "\\-" ? "" : " \\fI" $4 "\\fR")
    print "(" $5 ") " $8 ($9 ? ". " $9 : "") "."
}' | put "$out/motus.1" "$out/motus.1" '" options' '" /options'
[ $# = 0 ] || exit 0
mkdir "$place/tasks"
MOTUS=$motus cmake/cookbook.sh "$place/tasks"
mv "$place/tasks"/*.png doc/cookbook/
