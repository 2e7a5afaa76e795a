#!/bin/bash
# The documents are correct: they have the methods, verbs and options of the program, links have targets,
# the models and the C program in them work as printed.
set -u
motus=${MOTUS:+$(realpath "$MOTUS")}
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C.UTF-8
build=${BUILD:-build}
motus=${motus:-$PWD/build/motus}
passed=0 failed=0
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
judge() {
    if [ -z "$2" ]; then passed=$((passed + 1)); echo "ok - $1"
    else failed=$((failed + 1)); echo "not ok - $1"; sed 's/^/    /' <<<"$2"; fi
}
# Code block number $2 among those of file $1 that open with ```$3
block() {
    awk -v want="$2" -v open="\`\`\`$3" '
        /^```/ && inside { inside = 0; next }
        /^```/ { inside = 1; mine = $0 == open; n += mine; next }
        inside && mine && n == want' "$1"
}

# --- what the program says of itself ---------------------------------------------------------------------------------------------------------
mkdir "$place/doc"
MOTUS=$motus sh cmake/manual.sh "$place/doc" 2>&1
for file in manual.md motus.1; do
    judge "doc/$file has the methods, verbs and options of the program (make manual writes them)" "$(diff doc/$file "$place/doc/$file" 2>&1 | head -n 20)"
done
judge "every method's citation is in doc/references.bib" "$(
    "$motus" methods --json | jq -r '.methods[].cite | split(", ")[] | split(" ")[0]' | grep -xE '[A-Za-z]+[0-9]{2,4}[a-z]?' | sort -u |
        while read -r key; do grep -q "{$key," doc/references.bib || echo "$key"; done)"

judge "the manual page has the version" "$(grep -q "motus $(sed -n 's/^#define MOTUS_VERSION "\(.*\)"/\1/p' include/motus.h)" doc/motus.1 || echo 'another version')"

# --- functions, JSON keys -------------------------------------------------------------------------------------------------------------
judge "every function of the language is in the manual" "$(grep -oE '\{"[a-z0-9]+", (OP|CALL)_' lang/text/words.c | grep -oE '"[a-z0-9]+"' | tr -d '"' |
    while read -r f; do sed -n '/^\*\*Functions\*\*/,/^$/p;/^\*\*Choice\*\*/,/^$/p' doc/manual.md |
        grep -qE "(^|[ \`])$f([ (\`]|$)" || echo "$f"; done)"
judge "run --json has the documented keys" "$("$motus" run models/spring.motus --json >"$place/run.json" 2>&1
    grep -E '^\| run \| `model' doc/manual.md | sed -E 's/\[?\{[^}]*\}\]?//g' | grep -oE '[a-z_]+' | grep -vx run |
        while read -r key; do jq -e "has(\"$key\")" "$place/run.json" >/dev/null 2>&1 || echo "$key"; done)"
judge "check --json has the documented keys" "$("$motus" check models/spring.motus --json >"$place/check.json" 2>&1
    for key in equations variables velocity_dependent linear_in_velocity time_dependent affine methods; do
        jq -e "has(\"$key\")" "$place/check.json" >/dev/null 2>&1 || echo "$key"; done)"

# --- links ------------------------------------------------------------------------------------------------------------------------------
judge "links lead somewhere" "$(for file in README.md CONTRIBUTING.md HOUSE.md doc/*.md; do
    grep -oE '\]\([^)#]+\)' "$file" | sed 's/^](//; s/)$//' | while read -r link; do
        # x[i](0) is not a link
        [[ $link == http* || $link != *[./]* ]] || [ -e "$(dirname "$file")/$link" ] || echo "$file: $link"; done; done)"
judge "anchors exist" "$(for file in doc/manual.md doc/cookbook.md; do
    grep -oE '\]\(#[^)]+\)' $file | sed 's/^](#//; s/)$//' | while read -r anchor; do
        grep -E '^#+ ' $file | sed -E 's/^#+ //' | tr 'A-Z ' 'a-z-' | tr -d '.,?' | grep -qx -- "$anchor" || echo "$file: $anchor"; done; done)"

# --- twelve tasks -------------------------------------------------------------------------------------------------------------------
mkdir "$place/tasks"
MOTUS=$motus cmake/cookbook.sh "$place/tasks"
judge "the cookbook has twelve tasks, and each ends as it says" "$(for task in $(seq 12); do
    [ "$(cat "$place/tasks/$task.status" 2>&1)" = "$([ "$task" = 10 ] && echo 1 || echo 0)" ] || { echo "$task:"; cat "$place/tasks/$task.err"; }; done)"
judge "a model of the cookbook has at most ten lines" "$(wc -l "$place"/tasks/*.motus | awk '$2 != "total" && $1 > 10')"
judge "the tasks print what the cookbook shows" "$(awk '/^## / { task = $2 + 0 } /^```/ { shown = $0 == "```text"; next } shown { print task " " $0 }' doc/cookbook.md |
    while IFS= read -r line; do grep -qxF -- "${line#* }" "$place/tasks/${line%% *}.out" || echo "$line"; done)"
judge "... and draw the pictures that it has (make manual writes them)" "$(for picture in $(grep -oE '\(cookbook/[a-z]+\.png' doc/cookbook.md | cut -d/ -f2); do
    head -c 8 "$place/tasks/$picture" 2>&1 | grep -qa PNG || echo "$picture"; [ -s "doc/cookbook/$picture" ] || echo "doc/cookbook/$picture"; done)"

# --- printed examples ------------------------------------------------------------------------------------------------------------
block doc/manual.md 1 "" >"$place/spring.motus"
judge "the manual's first model runs" "$("$motus" run "$place/spring.motus" 2>&1 >"$place/log" || echo failed)"
block README.md 1 "" >"$place/readme.motus"
judge "the README's model is models/driven-oscillator.motus" "$(diff <("$motus" run "$place/readme.motus" --json | jq -c .state) \
    <("$motus" run models/driven-oscillator.motus --json | jq -c .state) 2>&1)"
block README.md 1 c >"$place/readme.c"
judge "the README's C program compiles" "$(cc -std=c17 -Wall -Wextra -Wpedantic -Werror -Iinclude "$place/readme.c" "$build/libmotus.a" -lm -ldl -pthread -o "$place/readme" 2>&1)"
judge "the README's C program gives x(100)" "$(out=$("$place/readme" 2>&1); grep -q '^x(100) = 0\.04778239807187' <<<"$out" || echo "$out")"
# The programs at the head of motus.h, each with what it prints; and what the head speaks of.
part() {
    awk -v head=" * $1" 'index($0, head) == 1 { on = 1; next } !on { next } / \*     / { print substr($0, 8); next } $0 != " *" { exit } { print "" }' include/motus.h
}
judge "motus.h begins with three programs" "$(n=$(grep -cE '^ \* [a-z]+\.c: ' include/motus.h); [ "$n" = 3 ] || echo "$n")"
for name in $(sed -nE 's/^ \* ([a-z]+\.c): .*/\1/p' include/motus.h); do
    part "$name:" >"$place/$name"
    part "$name prints" >"$place/$name.due"
    judge "$name of motus.h compiles" "$(cc -std=c17 -Wall -Wextra -Wpedantic -Werror -Iinclude "$place/$name" "$build/libmotus.a" -lm -ldl -pthread -o "$place/$name.program" 2>&1)"
    judge "... and prints what it says" "$("$place/$name.program" >"$place/$name.out" 2>&1 || echo "status $?"; grep -q . "$place/$name.due" || echo nothing
        diff -B "$place/$name.due" "$place/$name.out")"
done
judge "the index of motus.h names what there is" "$(sed -n '1,/^ \*\/$/p' include/motus.h | grep -oE 'motus_[a-z_]+[a-z]' | sort -u |
    while read -r name; do sed '1,/^ \*\/$/d' include/motus.h | grep -qwE "$name|MOTUS_DEFAULT_FUNCTION\(${name#motus_default_}" || echo "$name"; done)"
# The manual prints the error as the program does.
printf "k = 2\nm = 1\nx'' = -1/2x\nx(0) = 1\nx'(0) = 0\n" >"$place/wrong.motus"
(cd "$place" && mv wrong.motus spring.motus && NO_COLOR=1 "$motus" check spring.motus 2>&1) | sed 's/[ ]*$//' | grep -v '^$' >"$place/said"
sed -n '/^spring\.motus:3:/,/^```/p' doc/manual.md | sed '$d' >"$place/told"
judge "the error that the manual shows is the program's" "$(diff "$place/told" "$place/said")"
# The three lines, and the answer below them.
sed -n "/^### Accuracy and tolerance/,/^\*\*/{/^x''/,/^until/p}" doc/manual.md >"$place/three.motus"
judge "the manual's three lines give the answer that it shows" "$(out=$("$motus" run "$place/three.motus" 2>&1)
    sed -n '/^### Accuracy and tolerance/,/^\*\*/{/ ± /p;/^accuracy 1e/p;/^auto:/p}' doc/manual.md |
        while IFS= read -r line; do grep -qxF -- "$line" <<<"$out" || echo "$line"; done)"
judge "... and the README's" "$(line=$(grep -oE 'prints `x [0-9.]+ ± [0-9e-]+`' README.md | sed 's/prints `x //; s/`//')
    [ -n "$line" ] && "$motus" run "$place/three.motus" 2>&1 | grep -qF -- "$line" || echo "README: $line")"

# Work for an accuracy: the evaluations are the same on every machine.
command=$(sed -n 's/^    motus \(compare .*--accuracies .*\)$/\1/p' doc/manual.md | head -n 1)
sed -n '/^Evaluations of the force/,/^```/p' doc/manual.md | sed '$d' >"$place/told"
judge "the work that the manual shows is the program's" "$([ "$(wc -l <"$place/told")" -gt 5 ] || echo "the manual shows none"
    NO_COLOR=1 "$motus" $command 2>/dev/null | sed -n '/^Evaluations of the force/,/^Time for it/p' | sed '$d' | sed '$d' | diff "$place/told" -)"

# Certificates of adaptive rows.
command=$(sed -n 's/^    motus \(converge .*henon.*\)$/\1/p' doc/manual.md | head -n 1)
sed -n '/^### converge/,/^### sweep/{/^  method  /,/^```/p}' doc/manual.md | sed '$d; /^$/d' >"$place/told"
judge "the certificates that the manual shows are the program's" "$([ "$(wc -l <"$place/told")" -gt 5 ] || echo "the manual shows none"
    NO_COLOR=1 "$motus" $command 2>/dev/null | sed -n '/^  method  /,/^$/p' | sed 's/ *$//; /^$/d' | diff "$place/told" -)"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
