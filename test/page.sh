#!/bin/bash
# Builds the page as `make lab` does and tests it: the module against the program, byte for byte, and the page in a browser (test/lab/*.mjs).
#
# Each test prints what failed and, last, `N passed, N failed`; so does this script, for all of them. Screenshots are left in build/lab/shots/.
# CHROMIUM and FIREFOX name the browsers, MOTUS the program (build/motus). `test/page.sh share green` runs these two, `test/page.sh browsers`
# those beside which others may run, `test/page.sh played` those that play a motion by the clock, `test/page.sh parts` those without a browser.
cd "$(dirname "$0")/.." || exit 1
export MOTUS=${MOTUS:-$PWD/build/motus}
logs=build/lab/test
mkdir -p $logs
began=$SECONDS

if ! cmake/lab.sh "$([ "$*" = parts ] && echo core)" >$logs/build.log 2>&1; then
    cat $logs/build.log
    echo "not ok - the page is built"
    echo "0 passed, 1 failed"
    exit 1
fi
(cd lab && node_modules/.bin/esbuild core.ts --bundle --format=esm --target=es2022 --outfile=../$logs/core.mjs --log-level=warning) || echo "not ok - the core's calls are bundled"

# name, seconds, command ...: its output goes to a log, its count to the sum.
start() {
    local name=$1 limit=$2
    local since=$SECONDS
    shift 2
    # In the foreground, so that a signal to this script ends them as well.
    timeout --foreground --kill-after=5 "$limit" "$@" >"$logs/$name.log" 2>&1 </dev/null
    echo "$? $((SECONDS - since))" >"$logs/$name.status"
}
bits() { start bits 600 node test/lab/bits.mjs $logs/core.mjs build/lab/motus.wasm "$MOTUS" models test/bits; }
# Tests without a browser, by node's test runner, whose output differs.
parts() {
    start parts 900 node --test --test-reporter=tap test/lab/*.test.mjs
    echo "$(sed -n 's/^# pass //p' $logs/parts.log) passed, $(sed -n 's/^# fail //p' $logs/parts.log) failed" >>$logs/parts.log
}
page() { start "$1" 900 node "test/lab/$1.mjs"; }

# As many at a time, the longest first, so that all end together.
together() {
    local most=$1 name
    shift
    for name; do
        while [ "$(jobs -rp | wc -l)" -ge "$most" ]; do wait -n; done
        case $name in bits | parts) $name ;; *) page "$name" ;; esac &
    done
    wait
}
names=("$@")
browsers=(presets panels share controls people stage studies gallery opened accuracy away lessons sizes own firefox events start bars green bits)
without=(parts)
by_clock=(lecture speed clock newcomer films)
case "$*" in browsers) names=("${browsers[@]}") ;; played) names=("${by_clock[@]}") ;; parts) names=("${without[@]}") ;; '') names=("${browsers[@]}" "${by_clock[@]}" "${without[@]}") ;; esac
rm -f $logs/*.status
# Most of them wait as long as they compute: three at a time fill two cores. Those that play a motion by the clock run two at a time, and a film,
# which is encoded while it runs, alone.
many=() played=() alone=()
for name in "${names[@]}"; do
    case $name in films) alone+=("$name") ;; speed | clock | newcomer | lecture) played+=("$name") ;; *) many+=("$name") ;; esac
done
together "${JOBS:-3}" "${many[@]}"
together "${JOBS:-2}" "${played[@]}"
together 1 "${alone[@]}"

passed=0 failed=0
for name in "${names[@]}"; do
    closing=$(grep -aE '^[0-9]+ passed, [0-9]+ failed$' "$logs/$name.log" | tail -n 1)
    read -r status took <"$logs/$name.status"
    good=${closing%% *} bad=${closing#*, }
    bad=${bad%% *}
    if [ -z "$closing" ] || [ "$((good + bad))" = 0 ]; then good=0 bad=1; echo "not ok - $name broke off (exit status $status)"; fi
    grep -aE '^(not ok|#  *[a-z0-9].*(ms|s|Hz|dropped))' "$logs/$name.log" | cut -c 1-400
    [ -n "$closing" ] || tail -n 5 "$logs/$name.log" | cut -c 1-400
    echo "$name: $good passed, $bad failed in $took s"
    passed=$((passed + good)) failed=$((failed + bad))
done
echo "in $((SECONDS - began)) s; logs in $logs, screenshots in build/lab/shots"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
