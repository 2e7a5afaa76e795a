#!/bin/bash
# The C files have the layout of .clang-format, and no line is longer than 120 characters, in tables either.
set -u
cd "$(dirname "$0")/.." || exit 1
passed=0 failed=0
judge() {
    if [ -z "$2" ]; then passed=$((passed + 1)); echo "ok - $1"
    else failed=$((failed + 1)); echo "not ok - $1"; sed 's/^/    /' <<<"$2"; fi
}
ours() { find . \( -name node_modules -o -name build -o -name out \) -prune -o -type f \( "$@" \) -print0; }

# The output of clang-format differs between versions; version 14 decides.
tool=$(command -v clang-format-14 || command -v clang-format)
case $("${tool:-false}" --version 2>/dev/null) in
*" 14."*)
    judge "clang-format has nothing to change (\`make format\` would)" "$(
        ours -name '*.[ch]' | xargs -0 "$tool" --dry-run 2>&1 | grep -E 'warning:' | head -n 20)" ;;
*)  echo "clang-format 14 is not here: the layout is not examined" ;;
esac
judge "no line is longer than 120 characters" "$(
    ours -name '*.[ch]' -o -name '*.def' | sort -z | while IFS= read -r -d '' file; do
        LC_ALL=C.UTF-8 grep -nE '^.{121,}' "$file" | sed "s|^|$file:|" | cut -c1-120; done)"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
