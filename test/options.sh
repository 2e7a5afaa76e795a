#!/bin/bash
# The table of options (cli/words/options.def): a setting of the motion changes the fingerprint of every file of rows, all others change none; whatever
# the options, files of one fingerprint have the same numbers; the completions of every shell have every option.
set -u
motus=$(realpath "${MOTUS:-build/motus}")
root=$(cd "$(dirname "$0")/.." && pwd)
export LC_ALL=C.UTF-8
passed=0 failed=0
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
judge() {
    if [ -z "$2" ]; then passed=$((passed + 1)); echo "ok - $1"
    else failed=$((failed + 1)); echo "not ok - $1"; sed 's/^/    /' <<<"$2"; fi
}
"$motus" --options >table
options_of() { "$motus" "$1" --help | sed '/^examples:/,$d' | grep -oE '^  (-[a-z], )?--[a-z-]+' | grep -oE -- '--[a-z-]+' | sort -u; }
judge "the table has options" "$([ "$(grep -c '^option' table)" -gt 50 ] || wc -l table)"
judge "every verb has its page" "$(cut -f 1,2 table | sed -n 's/^verb\t//p' | while read -r verb; do
    "$motus" --help | grep -q "motus $verb" || echo "--help: no $verb"
    "$motus" "$verb" --help | grep -q '^examples:' || echo "$verb"; done)"

# --- the fingerprint --------------------------------------------------------------------------------------------------------------
cat >prints.motus <<'M'
w = 1
x'' = -w sign(x) + 0.1 cos(t)
x(0) = 1
x'(0) = 0
M
# option | what it needs besides | values. What is not here gets its words, 3 for a number N, or nothing where it takes no value.
cat >samples <<'S'
--vary||"x'(0)=0,0.1,0.2" "x'(0)=0,0.1"
--random|--random "x(0)=0:1" --count 3|"x'(0)=0:1" "x'(0)=normal:0:1"
--zip|--vary "x'(0)=0,0.1,0.2"|
--count|--random "x'(0)=0:1" --count 3|4
--seed|--random "x'(0)=0:1" --count 3|7
--set||"x(0)=0.9"
--when||"x = 0 falling: x' = -0.9 x'" "x = 0 falling: stop"
--section||"x = 0 falling"
--skip|--section "x = 0 falling" --points 1|1
--points|--section "x = 0 falling"|1 2
--record||final "max(x)" ended,final
--errors||
--error|--errors|full none
--method||tsit5 verlet
--step||0.02
--tolerance||1e-7 "1e-7 absolute"
--accuracy||1e-5
--shortest-step||0.05
--longest-step||0.01
--most-steps||9
--until||2
--every||"7 steps"
--columns||x
--shard||2/2
--lanes||1 2
--events||events.csv
--plot|--section "x = 0 falling"|figure.svg
--plot-of|--section "x = 0 falling" --plot figure.svg|"x',x"
--save-state||end.state
--checkpoint||"10 steps"
S
# The fingerprint of the file p.$1 that the other words make, and a hash of its numbers; nothing: they are refused.
print() {
    local ending=$1
    shift
    rm -f p.* events.csv figure.svg end.state
    "$motus" "$@" -o p.$ending -q >/dev/null 2>&1 </dev/null || return
    case $ending in
    npy) echo "$(jq -r .fingerprint p.npy.json) $( (cat p.npy; jq -c .columns p.npy.json) | md5sum)"; return ;;
    h5) "$motus" archive p.h5 -o p.csv -q --force || return ;;
    esac
    echo "$(sed -n 2p p.csv | grep -oE 'fingerprint [0-9a-f]+' | cut -d' ' -f2) $(sed 1,2d p.csv | md5sum)"
}
"$motus" run prints.motus --until 1 -o p.h5 -q >/dev/null 2>&1 && archive=h5 || archive= # without HDF5 none
# One line for each sample: verb, option, setting, ending, base, and whether it changes the fingerprint, keeps it, or is refused.
: >found
: >prints
sample() { # verb, option, setting, argument, words
    local verb=$1 option=$2 setting=$3 needs values value ending base plain with
    [[ " --output --help --plan --emit-c --share --restart " == *" $option "* ]] && return # no file of rows comes of them
    if grep -q -- "^$option|" samples; then
        eval "needs=($(grep -- "^$option|" samples | cut -d'|' -f2))"
        eval "values=($(grep -- "^$option|" samples | cut -d'|' -f3))"
    else
        needs=() values=($( [ "$5" != - ] && echo "$5" || { [ "$4" = N ] && echo 3; }))
    fi
    [[ $4 != - && ${#values[@]} = 0 ]] && echo "$option of $verb has no sample" >>missing
    [ $verb = sweep ] && local what=(--vary w=1:2:3 --record "final,mean(x)") endings="csv npy $archive" || local what=() endings=$archive
    [ $verb = run ] && [ "$option" = --error ] && needs=()
    for base in "--method rk4 --step 0.01" "--method dop853"; do
        for ending in $endings; do
            plain=$(print $ending $verb prints.motus $base --until 3 "${what[@]}" "${needs[@]}")
            for value in "${values[@]:--}"; do
                with=("$option" "$value")
                [ "$4" = - ] && with=("$option")
                with=$(print $ending $verb prints.motus $base --until 3 "${what[@]}" "${needs[@]}" "${with[@]}")
                [ -z "$with" ] || echo "$verb $ending ${with/ / $([ "$option" = --shard ] && echo shard) }" >>prints
                echo "$verb $option $setting $ending $([ -z "$with" ] && echo refused ||
                    { [ "${plain%% *}" = "${with%% *}" ] && echo keeps || echo changes; }) ${base:9:3}" >>found
            done
        done
    done
}
: >missing
while IFS=$'\t' read -r kind option _ argument verbs setting words _; do
    [ "$kind" = option ] || continue
    for verb in sweep run; do [[ ,$verbs, == *,$verb,* ]] && sample $verb $option $setting "$argument" "$words"; done
done <table
judge "every option that takes a value has a sample" "$(cat missing)"
judge "samples were computed" "$([ "$(grep -cv refused found)" -gt 150 ] || wc -l found)"
# Of a setting of the motion some sample changes the fingerprint, with every base and ending with which one is accepted.
judge "a setting of the motion changes the fingerprint" "$(awk '$3 == "motion" { key = $1 " " $2 " " $4 " " $6; if ($5 != "refused") some[key] = 1
    if ($5 == "changes") changes[key] = 1 } END { for (key in some) if (!changes[key]) print key }' found)"
judge "... each is accepted with fixed or adaptive steps" "$(awk '$3 == "motion" { key = $1 " " $2; all[key] = 1; if ($5 != "refused") some[key] = 1 }
    END { for (key in all) if (!some[key]) print key }' found)"
judge "no other setting changes it" "$(awk '$3 != "motion" && $5 == "changes"' found)"
judge "files of one fingerprint have the same numbers" "$(sort -u prints | sed 's/ [0-9a-f]*  -$//' | uniq -d)"

# --- files that exist -------------------------------------------------------------------------------------------------------------
printf "x'' = -x\nx(0) = 1\nx'(0) = 0\nuntil 1\n" >write.motus
vary=(--vary "x(0)=1:2:3" --method rk4 --step 0.1)
"$motus" sweep write.motus "${vary[@]}" --shard 1/2 -o shard%K.csv -q && "$motus" sweep write.motus "${vary[@]}" --shard 2/2 -o shard%K.csv -q
[ -n "$archive" ] && "$motus" run write.motus --method rk4 --step 0.1 -o written.h5 -q
printf '<meta name="motus-start" content="">\n' >page.html
over() { # verb, option: it is refused where its file exists, and writes over it with --force
    local verb=$1 option=$2 words file=there.csv more=()
    case $verb in
    merge) words=(merge shard1.csv shard2.csv) ;;
    archive) [ -n "$archive" ] || return; words=(archive written.h5) ;;
    sweep) words=(sweep write.motus "${vary[@]}" --when "x = 0: record") ;;
    lab) words=(lab write.motus --no-open); export MOTUS_LAB_PAGE=$place/page.html ;;
    converge) words=(converge write.motus --methods verlet) ;;
    compare) words=(compare write.motus --methods verlet) ;;
    *) words=("$verb" write.motus --step 0.1) ;;
    esac
    [ "$option" = --plot ] && file=there.svg
    [ $verb$option = sweep--output ] || more=(-q)
    echo precious >$file
    "$motus" "${words[@]}" "${more[@]}" $option $file >out 2>&1
    [ $? = 2 ] && grep -q "^motus: $file exists$" out && grep -q -- '--force replaces it' out && [ "$(cat $file)" = precious ] || { echo "$verb $option"; cat out; }
    "$motus" "${words[@]}" $option $file --force >out 2>&1 && [ -s $file ] && ! grep -q precious $file || { echo "$verb $option --force"; cat out; }
    : >$file
    "$motus" "${words[@]}" $option $file >out 2>&1 && [ -s $file ] || { echo "$verb $option: an empty file"; cat out; }
}
judge "no verb writes over a file without --force" "$(while IFS=$'\t' read -r kind option _ argument verbs setting _; do
    [ "$kind" = option ] && [ "$setting" = files ] && [[ $argument = FILE || $argument = FIG ]] || continue
    for verb in ${verbs//,/ }; do over $verb $option </dev/null; done; done <table)"
judge "... and the table has such options" "$([ "$(grep -cE $'^option\t[^\t]*\t[^\t]*\tFI(LE|G)\t.*\tfiles\t' table)" -ge 4 ] || echo few)"
"$motus" run write.motus --step 0.1 --until 0.5 --save-state on.state -q
judge "a restart state may be replaced by the next one" "$("$motus" run write.motus --step 0.1 --restart on.state --save-state on.state -q 2>&1)"

# --- what goes together -----------------------------------------------------------------------------------------------------------
refused() { # words: they are refused as a request, with a hint
    "$motus" "$@" >out 2>&1 </dev/null
    [ $? = 2 ] && grep -q '^  hint: ' out && ! grep -q null out || { echo "$@"; cat out; }
}
judge "options that mean nothing are refused" "$(
    for words in "--skip 1" "--points 1" "--plot-of t,x" "--columns x" "--every 0.1" "--errors" "--force" "--emit-c -o x.csv" "--emit-c --restart x.state" "--emit-c --plot x.svg" \
        "--section x=0 --skip 1" "--share -o x.csv"; do refused run write.motus $words; done
    for words in "--step 0.1" "--evaluations 100" "--machine compiled" "--force"; do refused converge write.motus $words; done
    for words in "--evaluations 100 --step 0.1" "--accuracies 1e-3 --step 0.1" "--accuracies 1e-3 --evaluations 100" "--machine compiled" "--all --methods rk4" "--force"; do
        refused compare write.motus $words; done
    for words in "--every 0.5" "--every 0.5 --record final" "--fast --machine interpreter" "--force" "--force --resume -o x.csv"; do refused sweep write.motus --vary "x(0)=1,2" $words; done
    for words in "--threads 2" "--machine compiled" "--force"; do refused archive x.h5 $words; done
    refused lab write.motus --no-open --force)"

# --- completions ------------------------------------------------------------------------------------------------------------------
export PATH=$(dirname "$motus"):$PATH
bash_completes() { # words; the last one is completed
    bash -c 'source "$0"; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _motus 2>/dev/null; printf "%s\n" "${COMPREPLY[@]}"' "$root/doc/completions/motus.bash" "$@"
}
fish_completes() { fish --no-config -c "source $root/doc/completions/motus.fish; complete -C '$*'" | cut -f 1; }
zsh_completes() {
    zsh -fc '_arguments() { print -rl -- "$@" }; _describe() { print -rl -- ${(P)2} }; _files() { }
        words=("${@[2,-1]}"); CURRENT=$#words; source "$1"' - "$root/doc/completions/_motus" "$@" | sed -E 's/^\*?(--?[a-z-]+)\[.*/\1/; s/^([a-z]+):.*/\1/'
}
verbs=$(sed -n 's/^verb\t//p' table | cut -f 1)
for shell in bash zsh fish; do
    command -v $shell >/dev/null || continue
    judge "$shell completes every option of every verb" "$(for verb in $verbs; do
        diff <(options_of $verb) <(${shell}_completes motus $verb -- | grep -E '^--[a-z]' | sort -u) >differs || { echo "$verb:"; cat differs; }; done)"
    judge "$shell completes verbs" "$(${shell}_completes motus conv | grep -qx converge || echo none)"
done
judge "bash completes an option" "$([ "$(bash_completes motus run --sa)" = --save-state ] || echo no)"
judge "... its words" "$([ "$(bash_completes motus compare --machine '' | tr '\n' ' ')" = "auto interpreter compiled " ] || echo no)"
judge "... methods" "$([ "$(bash_completes motus methods pef)" = pefrl ] || echo no)"
judge "... a list of methods" "$([ "$(bash_completes motus compare --methods verlet,pef)" = verlet,pefrl ] || echo no)"
command -v fish >/dev/null && judge "fish completes the machines of compare" "$(fish_completes 'motus compare --machine ' | grep -qx compiled || echo no)"

# --- numbers ----------------------------------------------------------------------------------------------------------------------
printf "x'' = -x\nx(0) = 1\nx'(0) = 0\n" >osc.motus
same() { # what, an option as an expression, and as a number
    local one other
    one=$("$motus" run osc.motus "${@:4}" "$2" -q -o - 2>&1 | sed 1,2d)
    other=$("$motus" run osc.motus "${@:4}" "$3" -q -o - 2>&1 | sed 1,2d)
    judge "$1" "$([ "$(wc -l <<<"$one")" -gt 2 ] && [ "$one" = "$other" ] || printf '%s\n' "${one::300}" "${other::300}")"
}
same "--until takes a constant expression" "--until=3*17" "--until=51" --step 0.1
same "--step" "--step=sqrt(1/64)/4" "--step=0.03125" --until 2
same "... a decimal with a bare point" "--step=.5" "--step=0.5" --until 2
same "--tolerance" "--tolerance=1e-3^2" "--tolerance=1e-6" --until 2 --method dop853
same "... an absolute one" "--tolerance=10/1e7 absolute" "--tolerance=1e-6 absolute" --until 2 --method dop853
same "--longest-step" "--longest-step=1/2^4" "--longest-step=0.0625" --until 2 --method dop853
same "--most-steps" "--most-steps=2*500" "--most-steps=1000" --until 2 --method dop853
same "--every" "--every=2*5 steps" "--every=10 steps" --until 10 --step 0.1
for bad in x "3*" 1,2 nan 1/0 "sqrt(-1)" $'1\nuntil 2' "(1, 2)"; do
    judge "--until '$bad' is no number" "$("$motus" run osc.motus --until "$bad" >out 2>&1; [ $? = 2 ] && grep -q 'this is not a number' out || cat out)"
done
judge "a count is whole" "$("$motus" run osc.motus --until 2 --method dop853 --most-steps 5/2 >out 2>&1; [ $? = 2 ] && grep -q 'not an integer above 0' out || cat out)"
judge "an archive that is not there decides nothing" "$("$motus" run missing.h5 --method rk4 >out 2>&1; [ $? = 1 ] && ! grep -q decides out || cat out)"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
