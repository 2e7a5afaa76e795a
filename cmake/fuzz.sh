#!/bin/sh
# Runs every fuzzer of build/asan/test for FUZZ_SECONDS over test/corpus. New inputs go to build/fuzz, so that the committed corpus
# changes only by hand. After a crash the input is there too, and the script prints the command that repeats it.
set -u
cd "$(dirname "$0")/.."
seconds=${FUZZ_SECONDS:-60}
passed=0 failed=0
mkdir -p build/fuzz
for fuzzer in build/asan/test/fuzz_*; do
    [ -x "$fuzzer" ] || continue
    name=$(basename "$fuzzer")
    mkdir -p "build/fuzz/corpus/$name"
    log=build/fuzz/$name.log
    corpus=
    [ -d test/corpus ] && corpus=test/corpus
    dictionary=
    [ -f "test/$name.dict" ] && dictionary="-dict=test/$name.dict"
    # shellcheck disable=SC2086
    if "$fuzzer" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 $dictionary \
        -artifact_prefix="build/fuzz/$name-" "build/fuzz/corpus/$name" $corpus >"$log" 2>&1; then
        passed=$((passed + 1))
        echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s, no fault"
    else
        failed=$((failed + 1))
        tail -n 40 "$log"
        echo "$name: a fault; repeat it with: $fuzzer $(ls -t "build/fuzz/$name-"* 2>/dev/null | head -n 1)"
    fi
done
if [ $((passed + failed)) = 0 ]; then echo "no fuzzer was built"; failed=1; fi
echo "$passed passed, $failed failed"
[ $failed = 0 ]
