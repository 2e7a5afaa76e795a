#!/bin/bash
# The architecture: which folder may use which (the tables in HOUSE.md), by includes and by symbols; the names of symbols; and that the
# shared library exports exactly what motus.h declares.
set -u
cd "$(dirname "$0")/.." || exit 1
export LC_ALL=C
build=${BUILD:-build}
passed=0 failed=0
ok() { passed=$((passed + 1)); echo "ok - $1"; }
not_ok() { failed=$((failed + 1)); echo "not ok - $1"; shift; [ $# -gt 0 ] && printf '    %s\n' "$@"; }
# name, complaints (one a line; none: the case passes)
judge() { if [ -z "$2" ]; then ok "$1"; else not_ok "$1"; sed 's/^/    /' <<<"$2"; fi; }

# --- the tables of HOUSE.md ---------------------------------------------------------------------------------------
# Rows: | `core/` | what it is | `step/`, `motus.h` |. A row needs a grant or the word "nothing", else it is ignored. Folders are ranked
# in the order of their rows, a sub-folder within its folder.
declare -A grants rank
folders=()
while IFS='|' read -r _ folder _ may _; do
    [[ $folder =~ ^\ *\`([a-z/]+)/\`\ *$ ]] || continue
    name=${BASH_REMATCH[1]}
    case $may in *nothing*|*\`*) ;; *) continue ;; esac
    [ "$name" = lab ] && name=lab/core       # the rest of lab/ is not C
    folders+=("$name")
    grants[$name]=$(grep -o '`[^`]*`' <<<"$may" | tr -d '`' | tr '\n' ' ')
    above=${rank[${name%/*}]-}
    rank[$name]=$((above ? above + ${#folders[@]} : 100 * ${#folders[@]}))
done <HOUSE.md
# Sets `of` to the folder of the tables in which a file lies: the nearest one above it with a row.
find_folder() {
    of=${1%/*}
    while [ -z "${rank[$of]-}" ] && [[ $of == */* ]]; do of=${of%/*}; done
}
# A sub-folder may use what its folder may, and what its own row adds. (Unquoted, since a grant may have a *.)
granted() { echo ${grants[$1]} ${grants[${1%/*}]-}; }

judge "HOUSE.md says what every folder may use" "$(
    find * -name node_modules -prune -o -name '*.[ch]' -printf '%h\n' | sort -u |
        grep -vE '^(build|out|include|test|bench)(/|$)' |
        while read -r folder; do
            find_folder "$folder/"
            # If one sub-folder has a row, every one needs its own.
            [ "$of" = "$folder" ] || { [ -n "${rank[$of]-}" ] && [[ " ${folders[*]}" != *" $of/"* ]]; } || echo "$folder/ has no row"
        done)"
judge "HOUSE.md grants each folder only what stands above it" "$(
    for folder in "${folders[@]}"; do
        for grant in ${grants[$folder]}; do
            [[ $grant != */* ]] && continue
            find_folder "$grant"
            [ "${rank[$of]-999999}" -lt "${rank[$folder]}" ] || echo "$folder/: $grant"
        done
    done)"

# --- includes -------------------------------------------------------------------------------------------------------------
for folder in "${folders[@]}"; do
    complaints=
    may=$(granted "$folder")
    for file in $(find "$folder" -name '*.[ch]' -o -name '*.def'); do
        find_folder "$file"
        [ "$of" = "$folder" ] || continue
        while IFS=: read -r line text; do
            if [[ $text =~ \"([^\"]+)\" ]]; then
                target=${BASH_REMATCH[1]}
                # A name without a folder is motus.h or a neighbour.
                [[ $target == */* || $target == motus.h || $target == motus-archive.h ]] || target=$folder/$target
                good=no
                [[ $target == "$folder"/* && $folder != step ]] && good=yes
                # The list of the families is the only text of step/ that includes others: the families.
                [[ $file == step/families.def && $target == step/* ]] && good=yes
                # Every folder may include motus.h, except step/, which includes nothing.
                [[ $target == motus.h && $folder != step ]] && good=yes
                [[ $target == motus-archive.h && $folder == archive ]] && good=yes
                for grant in $may; do
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
# The macros of the header, beyond those of the two it includes, have its prefix, and it undefines none of the user's.
macros() { cc -std=c17 -Iinclude -E -dM "$@" -x c - | sed -E 's/^#define ([A-Za-z_0-9]+).*/\1/' | sort -u; }
plain=$(printf '#include <stddef.h>\n#include <stdint.h>\n' | macros)
judge "every macro of motus.h begins with MOTUS_" "$(echo '#include "motus.h"' | macros | comm -13 <(echo "$plain") - | grep -v '^MOTUS_')"
# Enumerations as the compiler sees them, one a line: "motus_trace_kind MOTUS_TRACE_START MOTUS_TRACE_KICK …". A status is MOTUS_ and one word.
enumerations=$(echo '#include "motus.h"' | cc -std=c17 -Iinclude -E -P -x c - | tr '\n' ' ' | grep -oE 'typedef enum motus_[a-z_]+ \{[^}]*\}' |
    sed -E 's/typedef enum (motus_[a-z_]+) \{/\1 /; s/[},]/ /g; s/  +/ /g')
judge "every enumeration of motus.h has a word of its own" "$(
    [ "$(wc -l <<<"$enumerations")" -ge 7 ] || echo "only these are seen: $enumerations"
    while read -r name list; do
        word=$(tr ' ' '\n' <<<"$list" | head -n 1 | grep -oE '^MOTUS_[A-Z]+_') || word='MOTUS_'
        for one in $list; do
            if [ "$name" = motus_status ]; then [[ $one =~ ^MOTUS_[A-Z]+$ || $one = MOTUS_STATUS_COUNT ]] || echo "$name: $one"
            else [[ $word != MOTUS_ && $one == "$word"* ]] || echo "$name: $one"; fi
        done
        [ "$name" = motus_status ] || echo "$word"
    done <<<"$enumerations" | sort | awk '/:/ || seen[$0]++')"
judge "motus.h leaves the user's macros alone" "$(echo '#include "motus.h"' | cc -std=c17 -Werror -Iinclude -DX=7 -Dname=8 -DERROR=9 -DOK=10 -E -dM -x c - 2>&1 |
    grep -cE '^#define (X 7|name 8|ERROR 9|OK 10)$' | grep -vx 4)"
judge "motus.h compiles beside macros of common names" "$(echo '#include "motus.h"' |
    cc -std=c17 -Wall -Wextra -Wpedantic -Werror -Iinclude -DX=7 -DERROR=9 -DOK=10 -DFILE=11 -fsyntax-only -x c - 2>&1)"
judge "motus.h is C++ too" "$(printf '#include "motus.h"\nint main() { motus_column c = motus_default_column(); return motus_column_at(nullptr, 0, &c) == MOTUS_OK; }\n' |
    c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -Iinclude -fsyntax-only -x c++ - 2>&1)"
judge "include/motus.h includes nothing of ours" "$(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' include/motus.h)"

# --- symbols --------------------------------------------------------------------------------------------------------------
# A symbol that other files use starts with its file's name, up to the first underscore or dot. Exceptions:
declare -A also=(
    [base/error.c]='fail hint'
    [base/memory.c]='take take_more give'
    [machine/interpreter.c]='machine_'                  # machine/machine.h declares the machines, each in its file
    [machine/callback.c]='machine_'
    [machine/compiled.c]='machine_'
    [machine/nowhere.c]='compiled_ machine_'            # replaces machine/compiled.c in the page's module
    [api/system/columns.c]='system_'                       # parts of api/system/system.h
)
archive=$build/libmotus.a
program=$build/CMakeFiles/motus_cli.dir
if [ ! -f "$archive" ] || [ ! -d "$program/cli" ]; then
    not_ok "symbols: $archive and the program's objects are not built"
else
    scratch=$(mktemp -d)
    trap 'rm -rf "$scratch"' EXIT
    # The build writes texts.c, which machine/texts.h declares.
    sources=$(
        for folder in "${folders[@]}"; do
            [[ $folder == cli* || $folder == mpi || $folder == lab/core ]] || ls "$folder"/*.c 2>/dev/null
        done
        echo machine/texts.c)
    # nm prints the member (graph.c.o); the folder follows from the file's name, so these names must be unique.
    judge "no two files of the library have the same name" "$(sed 's:.*/::' <<<"$sources" | sort | uniq -d)"
    # The page's module is built for WebAssembly; its files are compiled natively here for their symbols. Those that need WASI use no
    # symbols of the library.
    mkdir -p "$scratch/lab/core"
    unread=$(for file in lab/core/*.c; do
        grep -q '#include <wasi/' "$file" ||
            cc -std=c17 -w -D_GNU_SOURCE -I. -Iinclude -c "$file" -o "$scratch/$file.o" 2>&1
    done)
    judge "lab/core/ is compiled for its symbols" "$unread"
    # file, symbol, D (defines) or U (uses); of the program's objects those whose source is still there.
    {
        nm -A "$archive" "$build/libmotus-archive.a" 2>/dev/null | sed 's/^[^:]*://; /^$/d'
        for file in cli/*/*.c tell/*.c lab/core/*.c; do
            object=$scratch/$file.o
            [[ $file == lab/* ]] || object=$program/$file.o
            [ $file != cli/verbs/main.c ] || object=$build/CMakeFiles/motus_program.dir/$file.o
            [ -f "$object" ] && nm -A "$object" | sed "s:^[^ ]*\.o:$file.o:"
        done
    } | awk -v sources="$sources" '
        BEGIN {
            for (k = split(sources, path, "\n"); k > 0; k--) { file = path[k]; sub(/.*\//, "", file); of[file] = path[k] }
        }
        { file = $1; sub(/\.o:.*/, "", file); type = $(NF - 1) }
        type ~ /^[A-Z]$/ { print (file in of ? of[file] : file), $NF, type == "U" ? "U" : "D" }' |
        sort -u >"$scratch/symbols"

    judge "every symbol starts with its file's name" "$(
        while read -r path symbol kind; do
            [[ $kind == D && $path != cli/* && $path != lab/* ]] || continue
            file=${path##*/} prefix=${path##*/}
            prefix=${prefix%%[_.]*}
            case $symbol in
            motus_*|"$prefix"|"${prefix}"_*) continue ;;
            esac
            good=no
            for word in ${also[$path]-}; do
                [[ $symbol == "$word" || ( $word == *_ && $symbol == "$word"* ) ]] && good=yes
            done
            [ $good = yes ] || echo "$path defines $symbol, which should start with ${prefix}_"
        done <"$scratch/symbols")"

    # Uses: user, symbol, file that defines it. A program's own symbol comes before one of the library.
    awk '$3 == "D" { if ($1 ~ /^(cli|lab)\//) own[substr($1, 1, 3) $2] = $1; else from[$2] = $1 }
        $3 == "U" { use[++n] = $1; symbol[n] = $2 }
        END {
            for (; n > 0; n--) {
                mine = substr(use[n], 1, 3) symbol[n]
                if (mine in own) print use[n], symbol[n], own[mine]
                else if (symbol[n] in from) print use[n], symbol[n], from[symbol[n]]
            }
        }' \
        "$scratch/symbols" | sort >"$scratch/uses"
    # A grant of a folder covers all its symbols; of a header, those that it declares. Both are defined above.
    declared() { tr '\n' ' ' <"$1" | sed -E 's:/\*([^*]|\*+[^*/])*\*+/: :g' | grep -oE '[A-Za-z_]\w*' | sort -u; }
    declare -A may_use names complaint
    for folder in "${folders[@]}"; do
        complaint[$folder]=
        may_use[$folder]=$(granted "$folder")
        for grant in ${may_use[$folder]}; do
            case $grant in motus.h | motus-archive.h) header=include/$grant ;; *.h) header=$grant ;; *) continue ;; esac
            for name in $(declared "$header"); do names["$folder $name"]=1; done
        done
    done
    while read -r user symbol path; do
        find_folder "$user" && folder=$of
        find_folder "$path"
        [ "$of" = "$folder" ] && continue
        good=${names["$folder $symbol"]-no}
        for grant in ${may_use[$folder]-}; do [[ $grant == */ && $path == "$grant"* ]] && good=1; done
        [ "${rank[$of]-999999}" -lt "${rank[$folder]-0}" ] || good=no
        [ "$good" = no ] && complaint[$folder]+="$user uses $symbol of $path"$'\n'
    done <"$scratch/uses"
    for folder in "${folders[@]}"; do
        [ "$folder" = step ] && continue        # texts without objects
        judge "$folder/ uses only the symbols that HOUSE.md grants it" "${complaint[$folder]%$'\n'}"
    done

    # A file stands above those that it uses, within a folder too.
    judge "no circle of files within a folder" "$(
        while read -r user symbol path; do
            find_folder "$user" && folder=$of
            find_folder "$path"
            [ "$of" = "$folder" ] && [ "$user" != "$path" ] && echo "$user $path"
        done <"$scratch/uses" | sort -u | tsort 2>&1 >/dev/null | sed 's/^tsort: //')"

    # Constants and functions only: threads would share a writable global. .data.rel.ro is constant once loaded.
    judge "no globals that change" "$(
        objdump -t "$archive" | awk '
            / file format / { file = $1; sub(/:$/, "", file) }
            NF >= 5 && $(NF-2) ~ /^\.(data|bss)(\.|$)/ && $(NF-2) !~ /^\.data\.rel\.ro/ && / O / {
                print file " " $NF }' | sort -u)"
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
        # a child process that cannot become the compiler calls _exit; the environment names the compiler and the cache
        nm -uA "$archive" | sed 's/@.*//' | grep -vE ':(platform\.c\.o: +U _exit|(compiler|build|cache)\.c\.o: +U getenv)$' | awk '$(NF-1) == "U" { print $NF }' | sort -u |
            grep -xE '(__)?(printf|fprintf|vprintf|vfprintf|puts|fputs|putchar|fputc|fwrite|perror|exit|_exit|abort|longjmp|setjmp|_setjmp|__assert_fail|stdout|stderr|system|popen|getenv|setlocale)(_chk)?')"
fi

# The page: each file by its path without .ts or /index.ts, and those that it imports, types too.
judge "no circle of files in lab/" "$(
    grep -rE "(from|import) '\.[^']*'" lab --include='*.ts' --exclude-dir=node_modules | awk -F: '
        {
            user = $1; sub(/(\/index)?\.ts$/, "", user)
            match($0, /(from|import) \047[^\047]*\047/)
            count = split($1, part, "/") - 1
            n = split(substr($0, RSTART, RLENGTH), word, "\047"); n = split(word[2], step, "/")
            for (k = 1; k <= n; k++)
                if (step[k] == "..") count--
                else if (step[k] != ".") part[++count] = step[k]
            path = part[1]
            for (k = 2; k <= count; k++) path = path "/" part[k]
            if (user != path) print user, path
        }' | sort -u | tsort 2>&1 >/dev/null | sed 's/^tsort: //')"

# The library's callers are C programs and the page too; the program puts its options for the members (cli/words/complain.c).
judge "no text of the library names an option of the program" "$(
    grep -nE '"([^"]*[ `(])?--[a-z]' -r base core lang machine api study tell --include='*.[ch]' | grep -v -e '-Wl,')"

# --- files ----------------------------------------------------------------------------------------------------------------
ours() {
    find include $(printf '%s\n' "${folders[@]%%/*}" | grep -vx lab | sort -u) test ! -path 'test/corpus/*' \
        \( -name '*.[ch]' -o -name '*.def' -o -name '*.sh' \) -type f 2>/dev/null | sort
}
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
# A port to another system is another base/platform.c. _XOPEN_SOURCE=700 of cmake/flags.cmake lets the compiler refuse in all other files what POSIX
# does not declare; here are the ways round it.
judge "only base/platform.c knows Linux" "$(
    grep -q '_XOPEN_SOURCE=700' cmake/flags.cmake || echo "cmake/flags.cmake does not ask for POSIX alone"
    grep -nE '_(GNU|DEFAULT|BSD|XOPEN|POSIX_C)_SOURCE' CMakeLists.txt cmake/library.cmake cmake/archive.cmake cmake/mpi.cmake
    grep -rnE '_(GNU|DEFAULT|BSD|XOPEN|POSIX_C)_SOURCE|__(gnu_)?(linux|GLIBC|MUSL|APPLE|FreeBSD)__|"/(proc|sys)/|<(linux/|sched\.h|sys/(syscall|sendfile|prctl|file|epoll|eventfd|inotify|sysinfo|auxv|personality|random)\.h)|\<syscall *\(' \
        --include='*.[ch]' base core step lang machine api study archive tell cli mpi | grep -v '^base/platform\.c:')"
judge "base/platform.c is complete with POSIX alone" "$(
    cc -std=c17 -Wall -Wextra -Wpedantic -Werror -U__linux__ -D_XOPEN_SOURCE=700 -I. -fsyntax-only base/platform.c 2>&1)"
judge "python/ knows motus by its public headers" "$(
    grep -rnE --include='*.py' '"[a-z/-]+\.h"|<[a-z/-]+\.h>|CDLL|LoadLibrary' python | grep -vE 'HEADERS = \("motus\.h",\)|^python/test/')"
judge "no pragma lets the compiler change results" "$(
    grep -nE '^[[:space:]]*#[[:space:]]*pragma.*(FP_CONTRACT +ON|GCC optimize|float_control|clang fp)' $(ours))"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
