#!/bin/bash
# Does the tasks of doc/cookbook.md in a folder: writes each model under the name in its first line, gives each command, and keeps what it
# prints, in N.out for the command of task N. Pictures are files beside them.
#
#   cmake/cookbook.sh FOLDER
set -u
text=$(realpath "$(dirname "$0")/../doc/cookbook.md")
motus=$(realpath "${MOTUS:-build/motus}")
cd "$1" || exit 2
awk '/^```/ { open = !open; inside = open && $0 == "```"; name = ""; next }
     inside && name == "" { name = $2; sub(/:$/, "", name) }
     inside { print >name }' "$text"
while read -r task command; do
    eval "set -- $command"
    "$motus" "$@" >"$task.out" 2>"$task.err"
    echo $? >"$task.status"
done < <(awk '/^## / { task = $2 + 0 } /^    motus / { sub(/^    motus /, ""); print task, $0 }' "$text")
