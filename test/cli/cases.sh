#!/bin/bash
# What the tests of the program share: a folder for files, and functions for cases. To be sourced from the root of the source.
#
# Each case is one line `ok` or `not ok`. MOTUS is the program (build/motus).
set -u
motus=${MOTUS:-$PWD/build/motus}
root=$PWD
passed=0 failed=0
place=$(mktemp -d)
out=$place/out err=$place/err
# A signal may find a new process of this shell before that has let go of this trap.
trap '[ $BASHPID = $$ ] && { umount "$place/small" 2>/dev/null; rm -rf "$place"; }' EXIT
unset NO_COLOR
export LC_ALL=C.UTF-8 TERM=xterm

ok() { passed=$((passed + 1)); echo "ok - $1"; }
not_ok() {
    failed=$((failed + 1))
    echo "not ok - $1"
    shift
    for line in "$@"; do printf '    %s\n' "$line"; done | head -n 12 | cut -c 1-400 | tr -c '[:print:]\n' '?'
}
# name, condition ...: the condition is a command
that() {
    local name=$1
    shift
    if "$@" >"$place/said" 2>&1; then ok "$name"; else not_ok "$name" "$*" "$(cat "$place/said")"; fi
}
# name, exit status, command ...: leaves its output in $out and $err
gives() {
    local name=$1 want=$2 got
    shift 2
    "$@" >"$out" 2>"$err" </dev/null
    got=$?
    if [ $got = "$want" ]; then ok "$name"; else not_ok "$name" "exit status $got, not $want: $*" "$(head -c 600 "$out")" "$(cat "$err")"; fi
}
# name, exit status, words of the message, command ...: one message, nothing on standard output, and the same as JSON
refuses() {
    local name=$1 want=$2 words=$3 got
    shift 3
    "$@" >"$out" 2>"$err" </dev/null
    got=$?
    if [ $got != "$want" ]; then not_ok "$name" "exit status $got, not $want" "$(cat "$err")"; return; fi
    if [ -s "$out" ]; then not_ok "$name" "something is on standard output: $(head -c 300 "$out")"; return; fi
    if ! grep -qF -- "$words" "$err"; then not_ok "$name" "the message does not say '$words'" "$(cat "$err")"; return; fi
    if grep -qvE '^(motus: |[^ ].*:[0-9]+:[0-9]+: |    |  hint: )' "$err"; then not_ok "$name" "the message is out of shape" "$(cat "$err")"; return; fi
    ok "$name"
}
# Lines of prose may be wrapped within the words.
says() { grep -qF -- "$1" "${2:-$out}" || tr -s ' \n' ' ' <"${2:-$out}" | grep -qF -- "$1"; }
lacks() { ! grep -qF -- "$1" "${2:-$out}"; }
empty() { [ ! -s "$1" ]; }
absent() { [ ! -e "$1" ]; }
nothing_left() { [ -z "$(find "$1" -name '.motus-*')" ]; }

checker=$PWD/build/test/tool/json_check
if [ ! -x "$checker" ]; then
    checker=$place/json_check
    "${CC:-cc}" -std=c17 -O1 -o "$checker" test/cli/json_check.c || { echo "not ok - json_check is built"; echo "0 passed, 1 failed"; exit 1; }
fi
# Whether a file is one good JSON value on one line.
json() { "$checker" "$1" && [ "$(wc -l <"$1")" = 1 ]; }
# jq's result for $out is true
holds() { [ -s "${2:-$out}" ] && jq -e "$1" "${2:-$out}"; }
near() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(a ~ /[0-9]/ && d <= e) }'; }

# --- archives ---
python=/usr/bin/python3
[ -x $python ] || python=python3
sum() { sha256sum "$1" 2>/dev/null | cut -c 1-64; }
# How many blocks of an archive are there.
blocks() { $python -c "import h5py, sys; print(int((h5py.File(sys.argv[1])['blocks/done'][()] != 0).sum()))" "$1"; }
# A pendulum's motion to this time.
swing_until() { printf '%s\n' 'k = 1' "x'' = -k sin(x)  # rad/s²" 'x(0) = 1  # rad' "x'(0) = 0" "energy = x'^2/2 - k cos(x)  # per mass" 'method verlet' 'step 0.125' "until $1"; }
# --- tables ---
# The checks of a table that is whole, as a sweep leaves them which is killed after batches of one row each: TABLE, OUT, and of a .npy the
# bytes of a row.
row_checks() {
    $python - "$@" <<'P'
import struct, sys
table, out, width = sys.argv[1], sys.argv[2], int((sys.argv + [0])[3])
text, piece = open(table, 'rb').read(), 16384
first = 128 if width else 0
if width: ends = range(128 + width, len(text) + 1, width)
else: ends = [k + 1 for k, c in enumerate(text) if c == 10 and not text.rfind(b'\n', 0, k) + 1 == text.rfind(b'# end of')]
ends = sorted(set(ends if width else ends[3:]) | set(range(piece, len(text) + 1, piece)))
with open(out, 'w') as f:
    f.write(open(table + '.check').readline())
    for end in ends:
        begin = max(first, (end - 1)//piece*piece)
        hash = 0xCBF29CE484222325
        for c in struct.pack('<Q', begin) + text[begin:end]: hash = (hash ^ c)*0x100000001B3 & (1 << 64) - 1
        f.write('%020d %016x\n' % (end, hash))
P
}
