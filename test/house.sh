#!/bin/bash
# The order of the house, kept: who includes whom (the table in HOUSE.md is the law and is read from there), whose symbols are whose,
# and that the shared library shows exactly what motus.h declares.
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
build=${BUILD:-build}
passed=0 failed=0
ok() { passed=$((passed + 1)); echo "ok - $1"; }
not_ok() { failed=$((failed + 1)); echo "not ok - $1"; shift; [ $# -gt 0 ] && printf '    %s\n' "$@"; }
# name, complaints (one a line; none: the case passes)
judge() { if [ -z "$2" ]; then ok "$1"; else not_ok "$1"; sed 's/^/    /' <<<"$2"; fi; }

# --- includes -------------------------------------------------------------------------------------------------------------
# Rows of the table: | `core/` | what it is | `step/`, `motus.h` |. A row that grants nothing and does not say so is not a law.
declare -A grants
while IFS='|' read -r _ folder _ may _; do
    [[ $folder =~ ^\ *\`([a-z]+)/\`\ *$ ]] || continue
    name=${BASH_REMATCH[1]}
    case $may in *nothing*|*\`*) grants[$name]=$(grep -o '`[^`]*`' <<<"$may" | tr -d '`' | tr '\n' ' ') ;; esac
done <HOUSE.md

grants[lab/core]=${grants[lab]-}
for folder in base step core lang run api study tell cli lab/core; do
    if [ -z "${grants[$folder]+x}" ]; then not_ok "HOUSE.md says who $folder/ may include"; continue; fi
    complaints=
    for file in "$folder"/*.[ch] "$folder"/*.def; do
        [ -f "$file" ] || continue
        while IFS=: read -r line text; do
            if [[ $text =~ \"([^\"]+)\" ]]; then
                target=${BASH_REMATCH[1]}
                # A name without a folder is motus.h or a neighbour.
                [[ $target == */* || $target == motus.h ]] || target=$folder/$target
                good=no
                [[ $target == "$folder"/* && $folder != step ]] && good=yes
                # motus.h is the vocabulary of the whole house but of step/, which knows nothing.
                [[ $target == motus.h && $folder != step ]] && good=yes
                for grant in ${grants[$folder]}; do
                    [[ $target == "$grant" || ( $grant == */ && $target == "$grant"* ) ]] && good=yes
                done
                [ $good = yes ] || complaints+="$file:$line includes $target"$'\n'
            elif [ "$folder" = step ]; then
                complaints+="$file:$line: the texts of step/ include nothing: $text"$'\n'
            fi
        done < <(grep -nE '^[[:space:]]*#[[:space:]]*include' "$file")
    done
    judge "$folder/ includes only what HOUSE.md grants it" "${complaints%$'\n'}"
done
judge "include/motus.h includes nothing of ours" "$(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' include/motus.h)"

# --- symbols --------------------------------------------------------------------------------------------------------------
# A symbol that other files use starts with its file's name, up to the first underscore or dot. These files' symbols have another
# word, because it is the word of the house for the thing:
declare -A also=(
    [base/error.c]='fail hint'
    [base/memory.c]='take take_more give'
    [lang/derivative.c]='graph_'                    # a part of lang/graph.h
    [lang/words.c]='parse_'                         # the words that lang/tree.h asks for
    [run/interpreter.c]='machine_'                  # a machine is a file; run/run.h names them
    [run/callback.c]='machine_'
    [run/compiled.c]='machine_'
    [run/nowhere.c]='compiled_ machine_'            # stands in for run/compiled.c
    [api/columns.c]='system_'                       # parts of api/system.h
    [api/explain.c]='system_'
    [lang/tape_regions.c]='plan_'                   # the plan of a tape, lang/tape_regions.h
)
archive=$build/libmotus.a
if [ ! -f "$archive" ]; then
    not_ok "symbols: $archive is not built"
else
    # nm names the member (graph.c.o); the folder is found again by the file's name, so these must not repeat themselves.
    judge "no two files of the library have the same name" \
        "$(for f in base core lang run api study; do ls $f/*.c 2>/dev/null; done | sed 's:.*/::' | sort | uniq -d)"
    complaints=
    while read -r member symbol; do
        file=${member%.o}
        path=$(ls {base,core,lang,run,api,study}/"$file" 2>/dev/null | head -n 1)
        prefix=${file%%[_.]*}
        case $symbol in
        motus_*|"$prefix"|"${prefix}"_*) continue ;;
        esac
        good=no
        for word in ${also[$path]-}; do
            [[ $symbol == "$word" || ( $word == *_ && $symbol == "$word"* ) ]] && good=yes
        done
        [ $good = yes ] || complaints+="$path defines $symbol, which should start with ${prefix}_"$'\n'
    done < <(nm -A --defined-only -g "$archive" 2>/dev/null | awk '{ sub(/:$/, "", $1); n = split($1, p, ":"); print p[2], $NF }')
    judge "every symbol starts with its file's name" "${complaints%$'\n'}"

    # Constants and functions only: a writable global is state that two threads would share. .data.rel.ro is constant once loaded.
    judge "no globals that change" "$(
        for object in $(find "$build/CMakeFiles" -name '*.o' -path '*/CMakeFiles/*' ! -path '*/motus_program.dir/*' \
                \( -path '*/base/*' -o -path '*/core/*' -o -path '*/lang/*' -o -path '*/run/*' -o -path '*/api/*' -o -path '*/study/*' \)); do
            objdump -t "$object" | awk -v file="${object##*.dir/}" '
                NF >= 5 && $(NF-2) ~ /^\.(data|bss)(\.|$)/ && $(NF-2) !~ /^\.data\.rel\.ro/ && / O / { print file ": " $NF }'
        done | sort -u)"
fi

shared=$build/libmotus.so
if [ ! -e "$shared" ]; then
    not_ok "symbols: $shared is not built"
else
    shown=$(nm -D --defined-only "$shared" | awk '{ print $NF }' | sed 's/@.*//' | sort -u)
    declared=$(tr '\n' ' ' <include/motus.h | grep -oE 'MOTUS_API[^;(]*\(' | grep -oE 'motus_[a-z0-9_]+ *\($' | tr -d ' (' | sort -u)
    judge "the shared library shows nothing but motus_*" "$(grep -v '^motus_' <<<"$shown")"
    judge "what motus.h declares is there" "$(comm -13 <(echo "$shown") <(echo "$declared"))"
    judge "what is there, motus.h declares" "$(comm -23 <(echo "$shown") <(echo "$declared"))"
    # The library prints nothing and never exits.
    judge "the library calls nothing that prints, exits or jumps" "$(
        # the child that becomes the compiler leaves with _exit, and where compiler and cache are is said by the environment
        nm -uA "$archive" | sed 's/@.*//' | grep -vE ':(compiler|cache)\.c\.o: +U (_exit|getenv)$' | awk '$(NF-1) == "U" { print $NF }' | sort -u |
            grep -xE '(__)?(printf|fprintf|vprintf|vfprintf|puts|fputs|putchar|fputc|fwrite|perror|exit|_exit|abort|longjmp|setjmp|_setjmp|__assert_fail|stdout|stderr|system|popen|getenv|setlocale)(_chk)?')"
fi

# --- files ----------------------------------------------------------------------------------------------------------------
ours() { find include base step core lang run api study tell cli test ! -path 'test/corpus/*' \( -name '*.[ch]' -o -name '*.def' -o -name '*.sh' \) -type f 2>/dev/null | sort; }
judge "every file opens with a comment that says what it is" "$(
    for file in $(ours); do
        case $file in
        *.sh) sed -n '2p' "$file" | grep -q '^# ' || echo "$file" ;;
        *) head -n 1 "$file" | grep -qE '^(/\*|//)' || echo "$file" ;;
        esac
    done)"
judge "no flag lets the compiler change results" "$(
    grep -nE -- '-(ffast-math|fassociative-math|funsafe-math-optimizations|freciprocal-math|ffinite-math-only|Ofast)|ffp-contract=(on|fast)' \
        CMakeLists.txt CMakePresets.json cmake/*.cmake Makefile)"
judge "no pragma lets the compiler change results" "$(
    grep -nE '^[[:space:]]*#[[:space:]]*pragma.*(FP_CONTRACT +ON|GCC optimize|float_control|clang fp)' -r include base step core lang run api study tell cli)"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
